/** Everything the page shows, in one value, and who is told when it changes. */
import type { Doc, End } from "./document.ts";
import { emptyDoc } from "./document.ts";
import { committed, type History, redone, started, undone } from "./history.ts";

export type ToolName =
  | "select" | "segment" | "compound" | "s-shape" | "spline" | "quasi" | "blend" | "mirror" | "underlay";

export interface Hover {
  entity: number;
  sample: number;
}

export interface Looks {
  comb: boolean;
  combOfAll: boolean;
  /** model length of a tooth where curvature is 1; 0: not chosen yet */
  combScale: number;
  /** every how many samples a tooth stands */
  combDensity: number;
  evolute: boolean;
  events: boolean;
  before: boolean;
  deviation: boolean;
  grid: boolean;
  snap: boolean;
  theme: "dark" | "light";
  /** where the wipe between before and after stands, 0 to 1 of the width; null: none */
  wipe: number | null;
}

export interface Work {
  doing: string;
  fraction: number;
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
}

export interface State {
  history: History<Doc>;
  /** while a gesture goes on: the document as it would become */
  draft: Doc | null;
  selection: readonly number[];
  tool: ToolName;
  hover: Hover | null;
  /** an end picked for a blend */
  picked: { entity: number; end: End } | null;
  looks: Looks;
  work: Work | null;
  message: { text: string; hint: string; bad: boolean } | null;
  reached: boolean;
  underlay: Underlay | null;
}

export const startState = (theme: "dark" | "light"): State => ({
  history: started(emptyDoc()),
  draft: null,
  selection: [],
  tool: "select",
  hover: null,
  picked: null,
  looks: {
    comb: true, combOfAll: false, combScale: 0, combDensity: 2, evolute: false, events: true, before: true,
    deviation: false, grid: true, snap: false, theme, wipe: null,
  },
  work: null,
  message: null,
  reached: true,
  underlay: null,
});

export const docOf = (s: State): Doc => s.draft ?? s.history.now;

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

  /** The document as a gesture would leave it; nothing is remembered yet. */
  draft(doc: Doc): void {
    this.set({ draft: doc });
  }

  /** One step of undo. */
  commit(label: string, doc: Doc, more: Partial<State> = {}): void {
    this.set({ ...more, draft: null, history: committed(this.current.history, label, doc) });
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
