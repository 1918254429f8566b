/** Select: hover, take hold of a handle, pick, move, pan. */
import { type Doc, entityOf, isHeld, moved, type Point, withEntity, withHandle, withPoint } from "../model/document.ts";
import { nearestSample } from "../view/nearest.ts";
import type { Gesture, Pointer, Table } from "./gesture.ts";
import { DraggingJoint, jointAt } from "./joint.ts";
import { entityAt, handleAt, hoverAt } from "./pick.ts";

const kWipe = 6; // pixels about the line between before and after
const kStill = 4; // pixels a press may wander and still be a click

export class Idle implements Gesture {
  readonly cursor: string;
  readonly hint = "Drag a handle, click a curve, drag the ground to pan, wheel to zoom";

  constructor(private readonly table: Table, over: "handle" | "curve" | "nothing" = "nothing") {
    this.cursor = over === "handle" ? "grab" : over === "curve" ? "pointer" : "default";
  }

  move(p: Pointer): Gesture {
    const { store } = this.table;
    const handle = handleAt(this.table, p.at) ?? jointAt(this.table, p.at);
    const over = handle ? null : hoverAt(this.table, p.at);
    const hover = over && { entity: over.entity, sample: over.sample };
    const same = hover?.entity === store.state.hover?.entity && hover?.sample === store.state.hover?.sample;
    if (!same) store.set({ hover });
    return new Idle(this.table, handle ? "handle" : over && over.distance < kStill * 2 ? "curve" : "nothing");
  }

  down(p: Pointer): Gesture {
    if (p.button !== 0) return new Panning(this.table, p.at);
    const { wipe } = this.table.store.state.looks;
    if (wipe !== null && Math.abs(p.at[0] - wipe * this.table.view.width) < kWipe) return new Wiping(this.table);
    const handle = handleAt(this.table, p.at, p.coarse);
    if (handle) return new DraggingHandle(this.table, handle.entity, handle.handle);
    const joined = jointAt(this.table, p.at, p.coarse);
    if (joined) return new DraggingJoint(this.table, joined.id);
    const entity = entityAt(this.table, p.at, p.coarse);
    if (entity !== null) return new Pressed(this.table, entity, p);
    return new PressedGround(this.table, p);
  }

  doubled(p: Pointer): Gesture {
    if (handleAt(this.table, p.at, p.coarse)) return this;
    const entity = entityAt(this.table, p.at);
    if (entity !== null && this.inserted(entity, p)) return this;
    if (entity !== null) this.table.store.set({ selection: [entity] });
    return this;
  }

  /** A chosen spline passes the place from now on, between the points it lies between. */
  private inserted(entity: number, p: Pointer): boolean {
    const { store, live, view } = this.table;
    const e = entityOf(store.doc, entity);
    const comb = live.of(entity)?.comb;
    if (e?.kind !== "spline" || !comb || isHeld(store.doc, e) || !store.state.selection.includes(entity)) return false;
    const sampleAt = (at: Point) => nearestSample(view, comb, at)?.sample ?? 0;
    const here = sampleAt(p.at);
    const places = e.points.map((point) => sampleAt(view.toScreen(point)));
    if (e.closed) places[0] = 0; // the start is the end, too
    const index = places.filter((place) => place <= here).length;
    store.commit("Add a point", withEntity(store.doc, withPoint(e, index, p.place)));
    return true;
  }
}

export class Panning implements Gesture {
  readonly cursor = "grabbing";
  constructor(private readonly table: Table, private last: Point) {}

  move(p: Pointer): Gesture {
    this.table.view.panBy(p.at[0] - this.last[0], p.at[1] - this.last[1]);
    this.last = p.at;
    this.table.paint();
    return this;
  }
  up(): Gesture {
    return new Idle(this.table);
  }
  cancel(): Gesture {
    return new Idle(this.table);
  }
}

class PressedGround implements Gesture {
  constructor(private readonly table: Table, private readonly from: Pointer) {}

  move(p: Pointer): Gesture {
    const far = Math.hypot(p.at[0] - this.from.at[0], p.at[1] - this.from.at[1]) > kStill;
    return far ? new Panning(this.table, this.from.at).move(p) : this;
  }
  up(): Gesture {
    if (!this.from.shift) this.table.store.set({ selection: [], hover: null });
    return new Idle(this.table);
  }
  cancel(): Gesture {
    return new Idle(this.table);
  }
}

class Pressed implements Gesture {
  constructor(private readonly table: Table, private readonly entity: number, private readonly from: Pointer) {}

  move(p: Pointer): Gesture {
    const far = Math.hypot(p.at[0] - this.from.at[0], p.at[1] - this.from.at[1]) > kStill;
    if (!far) return this;
    const { store } = this.table;
    const e = entityOf(store.doc, this.entity);
    if (!e || isHeld(store.doc, e) || !store.state.selection.includes(this.entity))
      return new Panning(this.table, this.from.at).move(p);
    return new Moving(this.table, store.state.history.now, this.from.place).move(p);
  }
  up(): Gesture {
    const { store } = this.table;
    const { selection } = store.state;
    const others = selection.filter((id) => id !== this.entity);
    const next = !this.from.shift ? [this.entity]
      : others.length < selection.length ? others : [...selection, this.entity];
    store.set({ selection: next });
    return new Idle(this.table, "curve");
  }
  cancel(): Gesture {
    return new Idle(this.table);
  }
}

/** All that is selected moves with the hand. */
class Moving implements Gesture {
  readonly cursor = "move";
  constructor(private readonly table: Table, private readonly doc: Doc, private readonly from: Point) {}

  move(p: Pointer): Gesture {
    const by: Point = [p.place[0] - this.from[0], p.place[1] - this.from[1]];
    const { store } = this.table;
    store.draft({
      ...this.doc,
      entities: this.doc.entities.map((e) =>
        store.state.selection.includes(e.id) && !isHeld(this.doc, e) ? moved(e, by) : e),
    });
    return this;
  }
  up(): Gesture {
    const { store } = this.table;
    store.commit("Move", store.doc);
    return new Idle(this.table);
  }
  cancel(): Gesture {
    this.table.store.set({ draft: null });
    return new Idle(this.table);
  }
}

/** The line between before and after goes with the hand. */
class Wiping implements Gesture {
  readonly cursor = "ew-resize";
  constructor(private readonly table: Table) {}

  move(p: Pointer): Gesture {
    this.table.store.look({ wipe: Math.min(1, Math.max(0, p.at[0] / this.table.view.width)) });
    return this;
  }
  up(): Gesture {
    return new Idle(this.table);
  }
  cancel(): Gesture {
    return new Idle(this.table);
  }
}

export class DraggingHandle implements Gesture {
  readonly cursor = "grabbing";
  readonly hint = "The curve follows; Escape puts the handle back";
  constructor(private readonly table: Table, readonly entity: number, readonly handle: number) {}

  move(p: Pointer): Gesture {
    const { store } = this.table;
    const e = entityOf(store.doc, this.entity);
    if (!e) return this;
    store.set({
      draft: withEntity(store.doc, withHandle(e, this.handle, p.place)),
      dragged: { entity: this.entity, handle: this.handle },
    });
    return this;
  }
  up(): Gesture {
    const { store } = this.table;
    if (store.state.draft) store.commit("Move handle", store.state.draft, { dragged: null });
    return new Idle(this.table, "handle");
  }
  cancel(): Gesture {
    this.table.store.set({ draft: null, dragged: null });
    return new Idle(this.table);
  }
}
