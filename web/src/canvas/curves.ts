/** A curve, its comb and what belongs to it: painting of sampled places, nothing more. */
import type { DeviationTold } from "../model/deviation.ts";
import type { Comb, Point } from "../model/document.ts";
import type { Viewport } from "../view/viewport.ts";
import type { Palette } from "./palette.ts";

type Pen = CanvasRenderingContext2D;

function path(g: Pen, view: Viewport, points: Iterable<Point>): void {
  let first = true;
  g.beginPath();
  for (const p of points) {
    const [x, y] = view.toScreen(p);
    if (first) g.moveTo(x, y);
    else g.lineTo(x, y);
    first = false;
  }
}

export function paintCurve(g: Pen, view: Viewport, comb: Comb, color: string, width: number): void {
  path(g, view, comb.points as Point[]);
  g.strokeStyle = color;
  g.lineWidth = width;
  g.lineJoin = "round";
  g.stroke();
}

/** The end of the tooth at a sample: on the outer side, as long as the curvature is large. */
export function tip(comb: Comb, i: number, scale: number): Point {
  const [x, y] = comb.points[i] as Point;
  const [nx, ny] = comb.normals[i] as Point;
  const tooth = -(comb.curvature[i] ?? 0) * scale;
  return [x + nx * tooth, y + ny * tooth];
}

export interface CombLook {
  scale: number;
  density: number;
  line: string;
  fill: string;
  faint: boolean;
}

export function paintComb(g: Pen, view: Viewport, comb: Comb, look: CombLook): void {
  const tips = comb.points.map((_, i) => tip(comb, i, look.scale));
  const all = [...tips, ...([...comb.points].reverse() as Point[])];
  path(g, view, all);
  g.fillStyle = look.fill;
  g.fill("evenodd");
  g.strokeStyle = look.line;
  g.globalAlpha = look.faint ? 0.28 : 0.5;
  g.lineWidth = 1;
  g.beginPath();
  const joints = new Set(comb.joints);
  for (let i = 0; i < tips.length; ++i) {
    const edge = i === 0 || i === tips.length - 1 || joints.has(i);
    if (!edge && i % look.density !== 0) continue;
    const from = view.toScreen(comb.points[i] as Point);
    const to = view.toScreen(tips[i] as Point);
    g.moveTo(...from);
    g.lineTo(...to);
  }
  g.stroke();
  g.globalAlpha = look.faint ? 0.7 : 1;
  g.lineWidth = look.faint ? 1 : 1.5;
  path(g, view, tips);
  g.stroke();
  g.globalAlpha = 1;
}

export function paintEvolute(g: Pen, view: Viewport, comb: Comb, color: string): void {
  if (!comb.graphs) return;
  const samples = comb.graphs.samples ?? [];
  const centers = (comb.graphs.centers ?? []) as Point[];
  g.strokeStyle = color;
  g.lineWidth = 1.25;
  g.setLineDash([5, 3]);
  g.beginPath();
  for (let i = 0; i < centers.length; ++i) {
    const to = view.toScreen(centers[i] as Point);
    const follows = i > 0 && samples[i] === (samples[i - 1] ?? 0) + 1;
    const far = Math.abs(to[0]) > 1e5 || Math.abs(to[1]) > 1e5;
    if (follows && !far) g.lineTo(...to);
    else if (!far) g.moveTo(...to);
  }
  g.stroke();
  g.setLineDash([]);
}

/** Triangles where curvature is extreme, a crossed ring where it changes sign, a square at corners. */
export function paintEvents(g: Pen, view: Viewport, comb: Comb, colors: Palette): void {
  for (const event of comb.graphs?.events ?? []) {
    const [x, y] = view.toScreen(event.point as Point);
    const extreme = event.kind === "maximum" || event.kind === "minimum";
    g.fillStyle = extreme ? colors.maximum : event.kind === "corner" ? colors.bad : colors.inflection;
    g.strokeStyle = colors.ground;
    g.lineWidth = 1.5;
    g.beginPath();
    if (extreme) {
      const up = event.kind === "maximum" ? -1 : 1;
      g.moveTo(x, y + 5.5 * up);
      g.lineTo(x - 5, y - 3.5 * up);
      g.lineTo(x + 5, y - 3.5 * up);
      g.closePath();
    } else if (event.kind === "corner") {
      g.rect(x - 4, y - 4, 8, 8);
    } else {
      g.arc(x, y, 4, 0, 2 * Math.PI);
    }
    g.fill();
    g.stroke();
  }
}

/** A short stroke across the curve wherever a piece begins. */
export function paintJoints(g: Pen, view: Viewport, comb: Comb, color: string): void {
  g.strokeStyle = color;
  g.lineWidth = 1.25;
  g.beginPath();
  for (const i of comb.joints) {
    const [x, y] = view.toScreen(comb.points[i] as Point);
    const [nx, ny] = comb.normals[i] as Point;
    g.moveTo(x - 6 * nx, y + 6 * ny);
    g.lineTo(x + 6 * nx, y - 6 * ny);
  }
  g.stroke();
}

/** A part of the curve that is pointed at, by its lengths. */
export function paintStretch(g: Pen, view: Viewport, comb: Comb, { from, to }: { from: number; to: number }, color: string): void {
  path(g, view, (comb.points as Point[]).filter((_, i) => {
    const s = comb.arc_length[i] ?? 0;
    return s >= from && s <= to;
  }));
  g.strokeStyle = color;
  g.lineWidth = 5;
  g.globalAlpha = 0.75;
  g.lineCap = "round";
  g.stroke();
  g.lineCap = "butt";
  g.globalAlpha = 1;
}

const kLongestHair = 46; // pixels of a deviation as large as the tolerance

/** Hairs from the curve to where the points lie, as much longer as makes them visible. */
export function paintDeviation(g: Pen, view: Viewport, { places, tolerance }: DeviationTold, colors: Palette): void {
  const feet = (places.feet ?? []) as Point[];
  const distances = places.distance ?? [];
  const ends = feet.map((foot, i): Point => {
    const distance = distances[i] ?? 0;
    const long = (kLongestHair * distance) / Math.max(tolerance, places.max ?? 0, 1e-300) / view.scale;
    const angle = places.direction?.[i] ?? 0;
    return [foot[0] - long * Math.sin(angle), foot[1] + long * Math.cos(angle)];
  });
  for (const beyond of [false, true]) {
    g.beginPath();
    feet.forEach((foot, i) => {
      if (Math.abs(distances[i] ?? 0) > tolerance !== beyond) return;
      g.moveTo(...view.toScreen(foot));
      g.lineTo(...view.toScreen(ends[i] as Point));
    });
    g.strokeStyle = beyond ? colors.bad : colors.before;
    g.lineWidth = 1;
    g.globalAlpha = beyond ? 1 : 0.75;
    g.stroke();
    g.globalAlpha = 1;
  }
}

export function paintPoints(g: Pen, view: Viewport, points: readonly Point[], color: string): void {
  g.fillStyle = color;
  const r = points.length > 400 ? 1.4 : 2;
  g.beginPath();
  for (const p of points) {
    const [x, y] = view.toScreen(p);
    g.moveTo(x + r, y);
    g.arc(x, y, r, 0, 2 * Math.PI);
  }
  g.fill();
}

/** Crosses: points that were left out. */
export function paintStrays(g: Pen, view: Viewport, points: readonly Point[], color: string): void {
  g.strokeStyle = color;
  g.lineWidth = 1.5;
  g.beginPath();
  for (const p of points) {
    const [x, y] = view.toScreen(p);
    g.moveTo(x - 4, y - 4);
    g.lineTo(x + 4, y + 4);
    g.moveTo(x - 4, y + 4);
    g.lineTo(x + 4, y - 4);
  }
  g.stroke();
}

/** The place that is hovered, with its tooth. */
export function paintMark(g: Pen, view: Viewport, comb: Comb, sample: number, scale: number, colors: Palette): void {
  const p = comb.points[sample] as Point | undefined;
  if (!p) return;
  const [x, y] = view.toScreen(p);
  if (scale > 0) {
    g.strokeStyle = colors.mark;
    g.lineWidth = 1.5;
    g.beginPath();
    g.moveTo(x, y);
    g.lineTo(...view.toScreen(tip(comb, sample, scale)));
    g.stroke();
  }
  g.fillStyle = colors.mark;
  g.strokeStyle = colors.ground;
  g.lineWidth = 2;
  g.beginPath();
  g.arc(x, y, 4.5, 0, 2 * Math.PI);
  g.fill();
  g.stroke();
}
