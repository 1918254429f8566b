/** Drawing tools: so many clicks make a thing. */
import { added, type Doc, type Fresh, type Pixel, type Point } from "../model/document.ts";
import type { ToolName } from "../model/state.ts";
import type { Gesture, Pointer, Table } from "./gesture.ts";
import { Measuring } from "./measure.ts";
import { Idle, Panning } from "./select.ts";
import { ClickingStrays } from "./stray.ts";

const kSplineShows = 2; // points of a spline that make a curve

interface Recipe {
  /** clicks that complete it; Infinity: until it is ended */
  clicks: number;
  hints: readonly string[];
  make: (points: Point[], number: number) => Fresh;
}

const three = ["Click where the curve starts", "Click where both tangents meet", "Click where the curve ends"];

export const recipes: Partial<Record<ToolName, Recipe>> = {
  segment: {
    clicks: 3,
    hints: three,
    make: (p, n) => ({ kind: "segment", name: `Segment ${n}`, points: p as [Point, Point, Point], alpha: -1 }),
  },
  compound: {
    clicks: 3,
    hints: three,
    make: (p, n) => ({
      kind: "compound", name: `Compound ${n}`, points: p as [Point, Point, Point], alpha: [-1, 1], ratio: 0.5,
    }),
  },
  quasi: {
    clicks: 3,
    hints: three,
    make: (p, n) => ({
      kind: "quasi", name: `Quasi ${n}`, points: p as [Point, Point, Point], alpha: -1, form: "best", degree: 6,
    }),
  },
  "s-shape": {
    clicks: 4,
    hints: ["Click where the curve starts", "Click where it heads at the start",
      "Click where it comes from at the end", "Click where the curve ends"],
    make: (p, n) => ({ kind: "s-shape", name: `S-shape ${n}`, points: p as [Point, Point, Point, Point], alpha: -1 }),
  },
  spline: {
    clicks: Infinity,
    hints: ["Click points for the curve to pass; Enter or double click ends it"],
    make: (p, n) => ({ kind: "spline", name: `Spline ${n}`, points: p, alpha: -1, closed: false }),
  },
};

export class Drawing implements Gesture {
  readonly cursor = "crosshair";
  readonly hint: string;

  constructor(private readonly table: Table, private readonly tool: ToolName, private readonly recipe: Recipe,
              readonly started: readonly Point[] = []) {
    this.hint = recipe.hints[Math.min(started.length, recipe.hints.length - 1)] ?? "";
  }

  /** As soon as one click more would complete it, the curve is there and follows. */
  move(p: Pointer): Gesture {
    const { store } = this.table;
    const points = [...this.started, p.place];
    const last = this.started.at(-1);
    const stands = last && last[0] === p.place[0] && last[1] === p.place[1];
    if (points.length < (this.recipe.clicks === Infinity ? kSplineShows : this.recipe.clicks) || stands) return this;
    const { doc, id } = this.made(points);
    store.set({ draft: doc, selection: [id] });
    return this;
  }

  down(p: Pointer): Gesture {
    if (p.button === 1 || p.button === 2) return new PanningWithin(this.table, p.at, this);
    const last = this.started.at(-1);
    if (last && last[0] === p.place[0] && last[1] === p.place[1]) return this;
    const points = [...this.started, p.place];
    if (points.length < this.recipe.clicks) return new Drawing(this.table, this.tool, this.recipe, points);
    return this.complete(points);
  }

  doubled(): Gesture {
    return this.recipe.clicks === Infinity && this.started.length >= 2 ? this.complete([...this.started]) : this;
  }

  key(name: string): Gesture | null {
    if (name === "Enter") return this.doubled();
    if (name === "Backspace" && this.started.length > 0) {
      this.table.store.set({ draft: null });
      return new Drawing(this.table, this.tool, this.recipe, this.started.slice(0, -1));
    }
    return null;
  }

  cancel(): Gesture {
    if (this.table.store.state.draft) this.table.store.set({ draft: null, selection: [] });
    if (this.started.length > 0) return new Drawing(this.table, this.tool, this.recipe);
    this.table.store.set({ tool: "select" });
    return new Idle(this.table);
  }

  private complete(points: Point[]): Gesture {
    const { store } = this.table;
    const { doc, id } = this.made(points);
    store.commit(`Draw ${this.tool}`, doc, { selection: [id], tool: "select" });
    return new Idle(this.table);
  }

  private made(points: Point[]): { doc: Doc; id: number } {
    const { now } = this.table.store.state.history;
    return added(now, this.recipe.make(points, now.next));
  }
}

class PanningWithin extends Panning {
  constructor(table: Table, at: Pixel, private readonly back: Gesture) {
    super(table, at);
  }
  override up(): Gesture {
    return this.back;
  }
  override cancel(): Gesture {
    return this.back;
  }
}

export function gestureFor(table: Table, tool: ToolName): Gesture {
  if (tool === "measure") return new Measuring(table);
  if (tool === "strays") return new ClickingStrays(table);
  const recipe = recipes[tool];
  return recipe ? new Drawing(table, tool, recipe) : new Idle(table);
}
