/** What lies under the pointer. */
import { type Comb, type Entity, handlesOf, isHeld, isShown, type Pixel, type Point } from "../model/document.ts";
import { nearestSample } from "../view/nearest.ts";
import { type BoxPart, boxPartAt, turnBox } from "./box.ts";
import type { Table } from "./gesture.ts";

const kHandle = 11; // pixels
const kFinger = 26; // about a handle, for a finger
const kCurve = 8;
const kHover = 26;

export interface HandleHit {
  entity: number;
  handle: number;
}

export function handleAt(table: Table, at: Pixel, coarse = false): HandleHit | null {
  const reach = coarse ? kFinger : kHandle;
  const { store, view } = table;
  const doc = store.doc;
  let best: (HandleHit & { distance: number }) | null = null;
  for (const e of doc.entities) {
    if (!store.state.selection.includes(e.id) || isHeld(doc, e) || !isShown(doc, e)) continue;
    handlesOf(e).forEach((p, handle) => {
      const [x, y] = view.toScreen(p);
      const distance = Math.hypot(x - at[0], y - at[1]);
      if (distance <= reach && (!best || distance < best.distance)) best = { entity: e.id, handle, distance };
    });
  }
  return best;
}

/** Of the box about what is chosen. */
export function partAt(table: Table, at: Pixel, coarse = false): BoxPart | null {
  const box = turnBox(table);
  return box && boxPartAt(table.view, box, at, coarse ? kFinger : kHandle);
}

export interface CurveHit {
  entity: number;
  sample: number;
  distance: number;
}

function nearestOf(table: Table, entities: readonly Entity[], at: Pixel, within: number): CurveHit | null {
  let best: CurveHit | null = null;
  for (const e of entities) {
    const comb: Comb | undefined = table.live.of(e.id)?.comb;
    const near = comb && nearestSample(table.view, comb, at);
    if (near && near.distance <= within && (!best || near.distance < best.distance))
      best = { entity: e.id, ...near };
  }
  return best;
}

export function entityAt(table: Table, at: Pixel, coarse = false): number | null {
  const reach = coarse ? kFinger : kCurve;
  const doc = table.store.doc;
  const visible = doc.entities.filter((e) => isShown(doc, e));
  const curve = nearestOf(table, visible, at, reach);
  if (curve) return curve.entity;
  for (const e of visible) {
    if (e.kind !== "scan") continue;
    for (const p of e.line.points as Point[]) {
      const [x, y] = table.view.toScreen(p);
      if (Math.hypot(x - at[0], y - at[1]) <= reach) return e.id;
    }
  }
  return null;
}

/** The place on a selected curve (else on any) that is near enough to be read. */
export function hoverAt(table: Table, at: Pixel): CurveHit | null {
  const doc = table.store.doc;
  const visible = doc.entities.filter((e) => isShown(doc, e));
  const chosen = visible.filter((e) => table.store.state.selection.includes(e.id));
  return nearestOf(table, chosen, at, kHover) ?? nearestOf(table, visible, at, kCurve);
}
