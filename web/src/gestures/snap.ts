/** Where a hand means to be: an end, a handle or a joint of what is drawn, else a crossing of the grid. */
import { gridStep } from "../canvas/grid.ts";
import { handlesOf, isShown, type Point } from "../model/document.ts";
import type { Table } from "./gesture.ts";

const kReach = 9; // pixels

export interface Snapped {
  place: Point;
  /** what it is, for the eye; "": a crossing of the grid */
  to: string;
}

function* targets(table: Table): Generator<{ place: Point; to: string }> {
  const { store, live } = table;
  const { dragged } = store.state;
  const doc = store.state.history.now; // what is being drawn or dragged is no target of itself
  for (const e of doc.entities) {
    if (!isShown(doc, e) || e.id === dragged?.entity) continue;
    const comb = live.of(e.id)?.comb;
    const ends = comb ? [comb.points[0], comb.points.at(-1)] : [];
    for (const p of ends) if (p) yield { place: p as Point, to: `end of ${e.name}` };
    for (const p of handlesOf(e)) yield { place: p, to: `handle of ${e.name}` };
    for (const i of comb?.joints ?? []) yield { place: comb?.points[i] as Point, to: `joint of ${e.name}` };
  }
}

export function snapped(table: Table, at: Point): Snapped {
  let best: (Snapped & { distance: number }) | null = null;
  for (const { place, to } of targets(table)) {
    const [x, y] = table.view.toScreen(place);
    const distance = Math.hypot(x - at[0], y - at[1]);
    if (distance <= kReach && (!best || distance < best.distance)) best = { place, to, distance };
  }
  if (best) return { place: best.place, to: best.to };
  const step = gridStep(table.view);
  const [x, y] = table.view.toModel(at);
  return { place: [Math.round(x / step) * step, Math.round(y / step) * step], to: "" };
}
