/** Which sample is meant by a place on the screen: comparisons of drawn points. */
import type { Comb, Pixel, Point } from "../model/document.ts";
import type { Viewport } from "./viewport.ts";

/** Index of the value nearest to v in a list that does not fall. */
export function nearestIndex(list: readonly number[], v: number): number {
  let low = 0;
  let high = list.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if ((list[middle] as number) <= v) low = middle;
    else high = middle;
  }
  return Math.abs((list[low] as number) - v) <= Math.abs((list[high] as number) - v) ? low : high;
}

export interface Near {
  sample: number;
  distance: number;
}

/** The sample nearest to the screen point; its distance is to the drawn line, in pixels. */
export function nearestSample(view: Viewport, comb: Comb, at: Pixel): Near | null {
  let best: Near | null = null;
  let before: Pixel | null = null;
  comb.points.forEach((p, i) => {
    const q = view.toScreen(p as Point);
    const toPoint = Math.hypot(q[0] - at[0], q[1] - at[1]);
    const distance = before ? Math.min(toPoint, toEdge(before, q, at)) : toPoint;
    if (!best || distance < best.distance) {
      const last = before && Math.hypot(before[0] - at[0], before[1] - at[1]) < toPoint ? i - 1 : i;
      best = { sample: last, distance };
    }
    before = q;
  });
  return best;
}

function toEdge(a: Pixel, b: Pixel, p: Pixel): number {
  const along: Pixel = [b[0] - a[0], b[1] - a[1]];
  const length = along[0] ** 2 + along[1] ** 2;
  if (length === 0) return Infinity;
  const t = ((p[0] - a[0]) * along[0] + (p[1] - a[1]) * along[1]) / length;
  if (t < 0 || t > 1) return Infinity;
  return Math.hypot(a[0] + t * along[0] - p[0], a[1] + t * along[1] - p[1]);
}
