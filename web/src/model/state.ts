/** Everything the page shows, in one value, and who is told when it changes. */
import type { Doc, Point } from "./document.ts";
import { emptyDoc } from "./document.ts";
import { committed, type History, redone, started, undone } from "./history.ts";

export type ToolName =
  | "select" | "segment" | "compound" | "s-shape" | "spline" | "quasi" | "measure" | "strays";

export interface Hover {
  entity: number;
  sample: number;
}

/** A part of a curve, by its lengths. */
export interface Stretch {
  entity: number;
  from: number;
  to: number;
}

export interface Looks {
  comb: boolean;
  combOfAll: boolean;
  /** model length of a tooth where curvature is 1; 0: not chosen yet */
  combScale: number;
  /** the hand has chosen it: it stays with whatever is looked at */
  combOwn: boolean;
  /** every how many samples a tooth stands */
  combDensity: number;
  evolute: boolean;
  events: boolean;
  before: boolean;
  deviation: boolean;
  /** the osculating circle at the place that is read */
  circle: boolean;
  /** the box about chosen things, by which they are turned and scaled */
  box: boolean;
  grid: boolean;
  snap: boolean;
  theme: "dark" | "light";
  /** where the wipe between before and after stands, 0 to 1 of the width; null: none */
  wipe: number | null;
}

export interface Work {
  doing: string;
  fraction: number;
  /** what a search has come to so far, number by number */
  trace: readonly number[];
  cancel: () => void;
}

export interface Underlay {
  url: string;
  name: string;
  /** the name the server knows it by */
  file: string;
  width: number;
  height: number;
  /** lower left corner, and model length of a pixel */
  at: [number, number];
  scale: number;
  opacity: number;
  /** what the file holds */
  picture: Blob;
  /** whether what is shown is what tracing saw: a photo mapped back to its sheet */
  mapped: boolean;
  /** pictures of what tracing saw, and the name of the one shown; "": the picture itself */
  stages: readonly { name: string; url: string }[];
  stage: string;
}

export interface State {
  history: History<Doc>;
  /** while a gesture goes on: the document as it would become */
  draft: Doc | null;
  selection: readonly number[];
  tool: ToolName;
  hover: Hover | null;
  stretch: Stretch | null;
  /** the handle a hand holds */
  dragged: { entity: number; handle: number } | null;
  /** about what the chosen things turn and scale, where a hand has said so; it holds for that choice alone */
  pivot: { of: readonly number[]; at: Point } | null;
  /** while things are moved whole: where the box about them has got to, and how far that is */
  carrying: { corners: readonly Point[]; at: Point; says: string } | null;
  /** opposite corners of what a hand draws around things to choose them */
  band: readonly [Point, Point] | null;
  /** what the hand has been drawn to: "end of Segment 1" */
  snappedTo: string;
  looks: Looks;
  work: Work | null;
  message: { text: string; hint: string; bad: boolean } | null;
  reached: boolean;
  underlay: Underlay | null;
  /** two points of a picture whose distance is about to be told */
  measured: readonly [Point, Point] | null;
  /** a curvature is about to be drawn in the graph */
  targeting: boolean;
}

export const startState = (theme: "dark" | "light"): State => ({
  history: started(emptyDoc()),
  draft: null,
  selection: [],
  tool: "select",
  hover: null,
  stretch: null,
  dragged: null,
  pivot: null,
  carrying: null,
  band: null,
  snappedTo: "",
  looks: {
    comb: true, combOfAll: false, combScale: 0, combOwn: false, combDensity: 2, evolute: false, events: true, before: true,
    deviation: false, circle: false, box: true, grid: true, snap: false, theme, wipe: null,
  },
  work: null,
  message: null,
  reached: true,
  underlay: null,
  measured: null,
  targeting: false,
});

/** The label of the step that put an example there. */
export const kExample = "Example";

const kTraced = 2000; // steps of a search that are kept to be drawn

export const docOf = (s: State): Doc => s.draft ?? s.history.now;

/** How far the work is; a search that names its best value leaves a line of them. */
export function workTold(store: Store, fraction: number, doing: string): void {
  const { work } = store.state;
  if (!work) return;
  const best = /\bbest \w+ (-?[\d.]+)$/.exec(doing)?.[1];
  const trace = best === undefined ? work.trace : [...work.trace, Number(best)].slice(-kTraced);
  store.set({ work: { ...work, fraction, doing, trace } });
}

type Listener = (now: State, before: State) => void;

export class Store {
  private listeners: Listener[] = [];
  constructor(private current: State) {}

  get state(): State {
    return this.current;
  }

  get doc(): Doc {
    return docOf(this.current);
  }

  set(change: Partial<State>): void {
    const before = this.current;
    this.current = { ...before, ...change };
    for (const listener of this.listeners) listener(this.current, before);
  }

  look(change: Partial<Looks>): void {
    this.set({ looks: { ...this.current.looks, ...change } });
  }

  /** A comb as long as the hand wants it. */
  scaleComb(combScale: number): void {
    this.look({ combScale, combOwn: true });
  }

  /** What files are opened into: an example nobody has touched gives way. */
  get opened(): Doc {
    const { past, now } = this.current.history;
    return past.length === 1 && past[0]?.label === kExample ? emptyDoc() : now;
  }

  /** The document as a gesture would leave it; nothing is remembered yet. */
  draft(doc: Doc): void {
    this.set({ draft: doc });
  }

  /** One step of undo. */
  commit(label: string, doc: Doc, more: Partial<State> = {}): void {
    this.set({ ...more, draft: null, history: committed(this.current.history, label, doc) });
  }

  /** The newest step goes on: it stays one step of undo. */
  amend(doc: Doc): void {
    this.set({ draft: null, history: { ...this.current.history, now: doc, future: [] } });
  }

  undo(): void {
    this.set({ draft: null, history: undone(this.current.history) });
  }

  redo(): void {
    this.set({ draft: null, history: redone(this.current.history) });
  }

  say(text: string, hint = "", bad = false): void {
    this.set({ message: text ? { text, hint, bad } : null });
  }

  onChange(listener: Listener): void {
    this.listeners.push(listener);
  }
}
