/** Two clicks say how large a picture is: the panel asks for their distance. */
import type { Point } from "../model/document.ts";
import type { Gesture, Pointer, Table } from "./gesture.ts";
import { Idle } from "./select.ts";

export class Measuring implements Gesture {
  readonly cursor = "crosshair";
  readonly hint: string;

  constructor(private readonly table: Table, readonly started: readonly Point[] = []) {
    this.hint = started.length === 0 ? "Click a point of the picture" : "Click another, as far away as you know";
  }

  down(p: Pointer): Gesture {
    const [first] = this.started;
    if (!first) return new Measuring(this.table, [p.place]);
    this.table.store.set({ measured: [first, p.place], tool: "select" });
    return new Idle(this.table);
  }

  cancel(): Gesture {
    this.table.store.set({ tool: "select" });
    return new Idle(this.table);
  }
}
