/**
 * A band drawn about things chooses them: from left to right what lies within it, from right to left
 * whatever it touches too.
 */
import { type Entity, isHeld, isShown, type Point } from "../model/document.ts";
import type { Gesture, Pointer, Table } from "./gesture.ts";
import { Idle } from "./select.ts";

interface Rect {
  low: Point;
  high: Point;
}

const within = ({ low, high }: Rect, [x, y]: Point): boolean => x >= low[0] && x <= high[0] && y >= low[1] && y <= high[1];

/** Whether the straight line between two points passes the rectangle (Liang and Barsky). */
export function crosses(rect: Rect, a: Point, b: Point): boolean {
  let [from, to] = [0, 1];
  for (const i of [0, 1] as const) {
    const along = b[i] - a[i];
    const [low, high] = [rect.low[i] - a[i], rect.high[i] - a[i]];
    if (along === 0) {
      if (low > 0 || high < 0) return false;
      continue;
    }
    from = Math.max(from, Math.min(low / along, high / along));
    to = Math.min(to, Math.max(low / along, high / along));
  }
  return from <= to;
}

export function taken(points: readonly Point[], from: Point, to: Point): boolean {
  const rect: Rect = { low: [Math.min(from[0], to[0]), Math.min(from[1], to[1])], high: [Math.max(from[0], to[0]), Math.max(from[1], to[1])] };
  if (points.length === 0) return false;
  if (to[0] >= from[0]) return points.every((p) => within(rect, p));
  return points.some((p, i) => within(rect, p) || (i > 0 && crosses(rect, points[i - 1] as Point, p)));
}

export class Banding implements Gesture {
  readonly cursor = "crosshair";
  readonly hint = "To the right: what lies within; to the left: what it touches; Shift adds";

  constructor(private readonly table: Table, private readonly from: Pointer) {}

  move(p: Pointer): Gesture {
    const { store, view } = this.table;
    store.set({ band: [view.toModel(this.from.at), view.toModel(p.at)] });
    return this;
  }
  up(): Gesture {
    const { store } = this.table;
    const { band, selection } = store.state;
    const ids = band ? this.found(...band) : [];
    const more = ids.filter((id) => !selection.includes(id));
    store.set({ band: null, selection: this.from.shift ? [...selection, ...more] : ids });
    return new Idle(this.table);
  }
  cancel(): Gesture {
    this.table.store.set({ band: null });
    return new Idle(this.table);
  }

  private found(from: Point, to: Point): number[] {
    const doc = this.table.store.doc;
    const drawn = (e: Entity) =>
      (e.kind === "scan" ? e.line.points : this.table.live.of(e.id)?.comb.points ?? []) as Point[];
    return doc.entities.filter((e) => isShown(doc, e) && !isHeld(doc, e) && taken(drawn(e), from, to)).map((e) => e.id);
  }
}
