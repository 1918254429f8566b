/** Where a hand means to be: an end, a handle or a joint of what is drawn, else a crossing of the grid. */
import { gridStep } from "../canvas/grid.ts";
import { handlesOf, isShown, type Pixel, type Point } from "../model/document.ts";
import type { Table } from "./gesture.ts";

const kReach = 9; // pixels

export interface Snapped {
  place: Point;
  /** what it is, for the eye; "": a crossing of the grid */
  to: string;
}

function* targets(table: Table, except: readonly number[]): Generator<{ place: Point; to: string }> {
  const { store, live } = table;
  const { dragged } = store.state;
  const doc = store.state.history.now; // what is being drawn or dragged is no target of itself
  for (const e of doc.entities) {
    if (!isShown(doc, e) || e.id === dragged?.entity || except.includes(e.id)) continue;
    const comb = live.of(e.id)?.comb;
    const ends = comb ? [comb.points[0], comb.points.at(-1)] : [];
    for (const p of ends) if (p) yield { place: p as Point, to: `end of ${e.name}` };
    for (const p of handlesOf(e)) yield { place: p, to: `handle of ${e.name}` };
    for (const i of comb?.joints ?? []) yield { place: comb?.points[i] as Point, to: `joint of ${e.name}` };
  }
}

function nearestTarget(table: Table, at: Pixel, except: readonly number[]): (Snapped & { distance: number }) | null {
  let best: (Snapped & { distance: number }) | null = null;
  for (const { place, to } of targets(table, except)) {
    const [x, y] = table.view.toScreen(place);
    const distance = Math.hypot(x - at[0], y - at[1]);
    if (distance <= kReach && (!best || distance < best.distance)) best = { place, to, distance };
  }
  return best;
}

function onGrid(table: Table, [x, y]: Point): Point {
  const step = gridStep(table.view);
  return [Math.round(x / step) * step, Math.round(y / step) * step];
}

export function snapped(table: Table, at: Pixel): Snapped {
  const best = nearestTarget(table, at, []);
  return best ? { place: best.place, to: best.to } : { place: onGrid(table, table.view.toModel(at)), to: "" };
}

/**
 * A shift of things that are held at some points, so that one of these comes to lie on a target; else so
 * that the one nearest to the hand comes onto the grid.
 */
export function snappedShift(table: Table, holds: readonly Point[], hand: Point, shift: Point, ids: readonly number[]): Snapped {
  const at = (p: Point): Point => [p[0] + shift[0], p[1] + shift[1]];
  let best: (Snapped & { distance: number }) | null = null;
  for (const hold of holds) {
    const found = nearestTarget(table, table.view.toScreen(at(hold)), ids);
    if (found && (!best || found.distance < best.distance))
      best = { ...found, place: [found.place[0] - hold[0], found.place[1] - hold[1]] };
  }
  if (best) return { place: best.place, to: best.to };
  const far = (p: Point) => Math.hypot(p[0] - hand[0], p[1] - hand[1]);
  const held = holds.reduce<Point | null>((near, p) => (near && far(near) <= far(p) ? near : p), null) ?? hand;
  const to = onGrid(table, at(held));
  return { place: [to[0] - held[0], to[1] - held[1]], to: "" };
}
