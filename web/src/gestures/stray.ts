/** Clicks on measured points: one that is no part of the curve goes out, clicked again it comes back. */
import { entityOf, type Pixel, type Point, type Scan, toggledStray, withEntity } from "../model/document.ts";
import type { Gesture, Pointer, Table } from "./gesture.ts";
import { Idle } from "./select.ts";

const kReach = 10; // pixels

/** The points that are looked at: those chosen, or those the chosen curve was made of. */
export function scanOf(table: Table): Scan | null {
  const { store } = table;
  const chosen = entityOf(store.doc, store.state.selection.at(-1) ?? null);
  const e = chosen?.kind === "faired" ? entityOf(store.doc, chosen.of) : chosen;
  return e?.kind === "scan" ? e : null;
}

export class ClickingStrays implements Gesture {
  readonly cursor = "crosshair";
  readonly hint = "Click a point to leave it out, again to take it back; Escape ends";

  constructor(private readonly table: Table) {}

  down(p: Pointer): Gesture {
    const scan = scanOf(this.table);
    const index = scan ? this.nearest(scan.line.points as Point[], p.at) : null;
    if (scan && index !== null) {
      const { store } = this.table;
      const changed = toggledStray(scan, index);
      const out = (changed.strays ?? []).includes(index);
      store.commit(out ? "Leave a point out" : "Take a point back", withEntity(store.state.history.now, changed));
    }
    return this;
  }

  cancel(): Gesture {
    this.table.store.set({ tool: "select" });
    return new Idle(this.table);
  }

  private nearest(points: readonly Point[], at: Pixel): number | null {
    let best: { index: number; distance: number } | null = null;
    points.forEach((p, index) => {
      const [x, y] = this.table.view.toScreen(p);
      const distance = Math.hypot(x - at[0], y - at[1]);
      if (distance <= kReach && (!best || distance < best.distance)) best = { index, distance };
    });
    return best === null ? null : (best as { index: number }).index;
  }
}
