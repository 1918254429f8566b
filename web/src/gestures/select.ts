/** Select: hover, take hold of a handle or of the box, pick, draw a band, pan. */
import { entityOf, isHeld, isMovable, type Pixel, withEntity, withHandle, withPoint } from "../model/document.ts";
import { controlsOf } from "../model/controls.ts";
import { nearestSample } from "../view/nearest.ts";
import type { Gesture, Pointer, Table } from "./gesture.ts";
import { Banding } from "./band.ts";
import type { BoxPart } from "./box.ts";
import { Moving, MovingPivot, Scaling, Turning } from "./carry.ts";
import { DraggingJoint, jointAt } from "./joint.ts";
import { entityAt, handleAt, hoverAt, partAt } from "./pick.ts";

const kWipe = 6; // pixels about the line between before and after
const kStill = 4; // pixels a press may wander and still be a click

type Over = "handle" | "curve" | "nothing" | BoxPart;

const cursorOver = (over: Over): string => {
  if (typeof over === "number") return over % 2 === 0 ? "nesw-resize" : "nwse-resize";
  return { handle: "grab", turn: "grab", pivot: "move", curve: "pointer", nothing: "default" }[over];
};

export class Idle implements Gesture {
  readonly cursor: string;
  readonly hint: string;

  constructor(private readonly table: Table, over: Over = "nothing") {
    this.cursor = cursorOver(over);
    this.hint = over === "turn" ? "Drag to turn about the pivot" : over === "pivot" ? "Drag the pivot to where things are to turn about"
      : typeof over === "number" ? "Drag to scale about the pivot"
        : "Drag a handle or a curve, click to choose, drag the ground for a band; the right button or Space pans, the wheel zooms";
  }

  move(p: Pointer): Gesture {
    const { store } = this.table;
    const handle = handleAt(this.table, p.at) ?? jointAt(this.table, p.at);
    const part = handle ? null : partAt(this.table, p.at);
    const over = handle || part !== null ? null : hoverAt(this.table, p.at);
    const hover = over && { entity: over.entity, sample: over.sample };
    const same = hover?.entity === store.state.hover?.entity && hover?.sample === store.state.hover?.sample;
    if (!same) store.set({ hover });
    return new Idle(this.table, handle ? "handle" : part ?? (over && over.distance < kStill * 2 ? "curve" : "nothing"));
  }

  down(p: Pointer): Gesture {
    if (p.button !== 0) return new Panning(this.table, p.at);
    const { wipe } = this.table.store.state.looks;
    if (wipe !== null && Math.abs(p.at[0] - wipe * this.table.view.width) < kWipe) return new Wiping(this.table);
    const handle = handleAt(this.table, p.at, p.coarse);
    if (handle) return new DraggingHandle(this.table, handle.entity, handle.handle);
    const joined = jointAt(this.table, p.at, p.coarse);
    if (joined) return new DraggingJoint(this.table, joined.id);
    const part = partAt(this.table, p.at, p.coarse);
    if (part !== null) return this.taken(part, p);
    const entity = entityAt(this.table, p.at, p.coarse);
    if (entity !== null) return new Pressed(this.table, entity, p);
    return new PressedGround(this.table, p);
  }

  private taken(part: BoxPart, p: Pointer): Gesture {
    this.table.store.set({ hover: null });
    return part === "turn" ? new Turning(this.table, p) : part === "pivot" ? new MovingPivot(this.table) : new Scaling(this.table, p, part);
  }

  doubled(p: Pointer): Gesture {
    if (handleAt(this.table, p.at, p.coarse)) return this;
    const entity = entityAt(this.table, p.at);
    if (entity !== null && (this.inserted(entity, p) || this.held(entity))) return this;
    if (entity !== null) this.table.store.set({ selection: [entity] });
    return this;
  }

  /** The control points of a curve of a file come and go as handles. */
  private held(entity: number): boolean {
    const { store } = this.table;
    const e = entityOf(store.doc, entity);
    if (e?.kind !== "fixed" || isHeld(store.doc, e) || controlsOf(e.curve).length === 0) return false;
    store.commit(e.held ? "Hide control points" : "Show control points", withEntity(store.doc, { ...e, held: !e.held }), { selection: [entity] });
    return true;
  }

  /** A chosen spline passes the place from now on, between the points it lies between. */
  private inserted(entity: number, p: Pointer): boolean {
    const { store, live, view } = this.table;
    const e = entityOf(store.doc, entity);
    const comb = live.of(entity)?.comb;
    if (e?.kind !== "spline" || !comb || isHeld(store.doc, e) || !store.state.selection.includes(entity)) return false;
    const sampleAt = (at: Pixel) => nearestSample(view, comb, at)?.sample ?? 0;
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
  constructor(private readonly table: Table, private last: Pixel) {}

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
    if (!far) return this;
    return this.from.coarse ? new Panning(this.table, this.from.at).move(p) : new Banding(this.table, this.from).move(p);
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
    if (!e || isHeld(store.doc, e) || !isMovable(e)) return new PressedGround(this.table, this.from).move(p);
    const { selection } = store.state;
    if (!selection.includes(this.entity)) store.set({ selection: this.from.shift ? [...selection, this.entity] : [this.entity] });
    store.set({ hover: null });
    return new Moving(this.table, this.from, this.entity).move(p);
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
