/** Things moved whole: dragged, turned and scaled about the pivot. One gesture is one step of undo. */
import { type Doc, entityOf, moved, type Point } from "../model/document.ts";
import { carried, type Placement, shiftedBy, still } from "../model/placement.ts";
import { middleOf, movable, placesOf, type TurnBox, turnBox } from "./box.ts";
import { label, roundStep } from "../view/ticks.ts";
import type { Gesture, Pointer, Table } from "./gesture.ts";
import { Idle } from "./select.ts";
import { snapped, snappedShift } from "./snap.ts";

const kDegree = Math.PI / 180;
const kShiftTurn = 15 * kDegree;
const kShiftFactor = 0.1;
const kSnapFactor = 0.01;
const kLeastFactor = 1e-3;

const stepped = (v: number, step: number) => Math.round(v / step) * step;

/** The document with the things moved, each about the middle it has there. */
export function carriedDoc(table: Pick<Table, "store" | "live" | "view">, doc: Doc, ids: readonly number[], by: Placement): Doc {
  const middles = new Map(ids.map((id) => [id, middleOf(placesOf(table, [id]))]));
  return carriedBy(doc, middles, by);
}

const carriedBy = (doc: Doc, middles: ReadonlyMap<number, Point>, by: Placement): Doc =>
  ({ ...doc, entities: doc.entities.map((e) => { const middle = middles.get(e.id); return middle ? moved(e, by, middle) : e; }) });

abstract class Carrying implements Gesture {
  abstract readonly cursor: string;
  abstract readonly step: string;
  readonly placesItself = true;
  protected readonly ids: readonly number[];
  protected readonly from: Point;
  private readonly doc: Doc;
  private readonly box: TurnBox | null;
  private readonly middles: ReadonlyMap<number, Point>;

  constructor(protected readonly table: Table, from: Pointer) {
    this.ids = movable(table.store);
    this.doc = table.store.doc;
    this.box = turnBox(table);
    this.from = table.view.toModel(from.at);
    this.middles = new Map(this.ids.map((id) => [id, middleOf(placesOf(table, [id]))]));
  }

  /** What the pointer there asks for, and how that is told. */
  protected abstract by(p: Pointer): { by: Placement; says: string };

  protected get pivot(): Point {
    return this.box?.pivot ?? [0, 0];
  }

  move(p: Pointer): Gesture {
    const { by, says } = this.by(p);
    const { store } = this.table;
    const corners = (this.box?.corners ?? []).map((c) => carried(by, c));
    const pivot = this.box && { of: store.state.selection, at: carried(by, this.box.pivot) };
    store.set({ draft: carriedBy(this.doc, this.middles, by), carrying: { corners, at: this.table.view.toModel(p.at), says }, pivot });
    return this;
  }
  up(): Gesture {
    const { store } = this.table;
    const { draft } = store.state;
    if (draft) store.commit(this.step, draft, { carrying: null, snappedTo: "" });
    return new Idle(this.table);
  }
  cancel(): Gesture {
    const { store } = this.table;
    store.set({ draft: null, carrying: null, snappedTo: "", pivot: this.box && { of: store.state.selection, at: this.box.pivot } });
    return new Idle(this.table);
  }
}

/** What was taken hold of snaps by its ends, joints and handles; Shift keeps to eight directions. */
export class Moving extends Carrying {
  readonly cursor = "move";
  readonly step = "Move";
  private readonly holds: readonly Point[];

  constructor(table: Table, from: Pointer, held: number) {
    super(table, from);
    const comb = table.live.of(held)?.comb;
    const e = entityOf(table.store.doc, held);
    const drawn = comb ? [comb.points[0], comb.points.at(-1), ...comb.joints.map((i) => comb.points[i])] : [];
    this.holds = [...drawn.filter((p) => p !== undefined), ...(e && "points" in e ? e.points : [])] as Point[];
  }

  protected by(p: Pointer): { by: Placement; says: string } {
    const { store, view } = this.table;
    const to = view.toModel(p.at);
    let shift: Point = [to[0] - this.from[0], to[1] - this.from[1]];
    let snappedTo = "";
    if (p.shift) {
      const angle = stepped(Math.atan2(shift[1], shift[0]), Math.PI / 4);
      const along: Point = [Math.cos(angle), Math.sin(angle)];
      const far = shift[0] * along[0] + shift[1] * along[1];
      shift = [far * along[0], far * along[1]];
    } else if (p.snaps) {
      const found = snappedShift(this.table, this.holds, this.from, shift, this.ids);
      shift = found.place;
      snappedTo = found.to;
    }
    if (snappedTo !== store.state.snappedTo) store.set({ snappedTo });
    const step = roundStep(1 / view.scale);
    return { by: shiftedBy(shift), says: `\u0394x ${label(shift[0], step)}  \u0394y ${label(shift[1], step)}` };
  }
}

export class Turning extends Carrying {
  readonly cursor = "grabbing";
  readonly step = "Turn";
  readonly hint = "Shift: by 15 degrees; Escape puts it back";

  protected by(p: Pointer): { by: Placement; says: string } {
    const to = this.table.view.toModel(p.at);
    const heading = (q: Point) => Math.atan2(q[1] - this.pivot[1], q[0] - this.pivot[0]);
    const raw = heading(to) - heading(this.from);
    const within = Math.atan2(Math.sin(raw), Math.cos(raw));
    const turn = p.shift ? stepped(within, kShiftTurn) : p.snaps ? stepped(within, kDegree) : within;
    return { by: { ...still(this.pivot), turn }, says: `${label(turn / kDegree, 0.1)}\u00b0` };
  }
}

export class Scaling extends Carrying {
  readonly cursor: string;
  readonly step = "Scale";
  readonly hint = "Shift: by tenths; Escape puts it back";

  constructor(table: Table, from: Pointer, corner: number) {
    super(table, from);
    this.cursor = corner % 2 === 0 ? "nesw-resize" : "nwse-resize";
  }

  protected by(p: Pointer): { by: Placement; says: string } {
    const to = this.table.view.toModel(p.at);
    const arm: Point = [this.from[0] - this.pivot[0], this.from[1] - this.pivot[1]];
    const along = (to[0] - this.pivot[0]) * arm[0] + (to[1] - this.pivot[1]) * arm[1];
    const raw = along / (arm[0] ** 2 + arm[1] ** 2);
    const factor = p.shift ? stepped(raw, kShiftFactor) : p.snaps ? stepped(raw, kSnapFactor) : raw;
    const scale = Math.max(kLeastFactor, factor);
    return { by: { ...still(this.pivot), scale }, says: `\u00d7${label(scale, 0.001)}` };
  }
}

/** The point about which is turned and scaled goes with the hand; ends, handles and joints draw it. */
export class MovingPivot implements Gesture {
  readonly cursor = "move";
  readonly hint = "Drag it to where things are to turn about; it snaps to ends, handles and joints";
  readonly placesItself = true;
  constructor(private readonly table: Table) {}

  move(p: Pointer): Gesture {
    const { store, view } = this.table;
    const found = snapped(this.table, p.at);
    const at = found.to || p.snaps ? found.place : view.toModel(p.at);
    store.set({ pivot: { of: store.state.selection, at }, snappedTo: found.to });
    return this;
  }
  up(): Gesture {
    this.table.store.set({ snappedTo: "" });
    return new Idle(this.table);
  }
  cancel(): Gesture {
    this.table.store.set({ pivot: null, snappedTo: "" });
    return new Idle(this.table);
  }
}
