/** The joint of a compound rhythm as a handle: it slides along the curve, and the share of the turning follows. */
import { type Compound, type Entity, entityOf, isHeld, isShown, type Pixel, type Point, withEntity } from "../model/document.ts";
import { nearestSample } from "../view/nearest.ts";
import type { Gesture, Pointer, Table } from "./gesture.ts";
import { Idle } from "./select.ts";

const kReach = 11; // pixels
const kFinger = 26;
const kLeast = 0.02; // of the turning, on either side

/** Where the operation says that the pieces meet. */
export function jointOf(table: Pick<Table, "live">, e: Entity): Point | null {
  const joint = e.kind === "compound" ? table.live.of(e.id)?.result["joint"] : undefined;
  return Array.isArray(joint) ? (joint as Point) : null;
}

export function jointAt(table: Table, at: Pixel, coarse = false): Compound | null {
  const { store, view } = table;
  for (const id of store.state.selection) {
    const e = entityOf(store.doc, id);
    const joint = e && isShown(store.doc, e) && !isHeld(store.doc, e) ? jointOf(table, e) : null;
    if (!joint || e?.kind !== "compound") continue;
    const [x, y] = view.toScreen(joint);
    if (Math.hypot(x - at[0], y - at[1]) <= (coarse ? kFinger : kReach)) return e;
  }
  return null;
}

/** How much of the whole turning lies before each drawn place, by the normals drawn there. */
function turningShare(normals: readonly Point[], sample: number): number {
  let turned = 0;
  let until = 0;
  for (let i = 1; i < normals.length; ++i) {
    const [a, b] = [normals[i - 1] as Point, normals[i] as Point];
    turned += Math.atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
    if (i === sample) until = turned;
  }
  return turned === 0 ? 0.5 : until / turned;
}

export class DraggingJoint implements Gesture {
  readonly cursor = "grabbing";
  readonly hint = "The joint slides along the curve; Escape puts it back";

  constructor(private readonly table: Table, private readonly entity: number) {}

  move(p: Pointer): Gesture {
    const { store, live, view } = this.table;
    const e = entityOf(store.doc, this.entity);
    const shown = live.of(this.entity);
    const near = shown && nearestSample(view, shown.comb, p.at);
    if (e?.kind !== "compound" || !shown || !near) return this;
    const share = turningShare(shown.comb.normals as Point[], near.sample);
    const counted = shown.result["reversed"] === true ? 1 - share : share; // from the end of smaller radius
    store.draft(withEntity(store.doc, { ...e, ratio: Math.min(1 - kLeast, Math.max(kLeast, counted)) }));
    return this;
  }
  up(): Gesture {
    const { store } = this.table;
    if (store.state.draft) store.commit("Move joint", store.state.draft);
    return new Idle(this.table);
  }
  cancel(): Gesture {
    this.table.store.set({ draft: null });
    return new Idle(this.table);
  }
}
