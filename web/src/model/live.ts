/**
 * The curves of the document as the server makes them. Of what changes while a hand drags only the
 * newest is asked for: one question is under way, the next one is whatever the document says by then.
 */
import type { Curve } from "../../generated/operations.ts";
import type { Answer, Client, Failure } from "../api/client.ts";
import { type Comb, type Entity, entityOf, type Fixed } from "./document.ts";
import { carriedComb, type Placement, still } from "./placement.ts";
import { type Recipe, recipeOf } from "./recipe.ts";
import type { Store } from "./state.ts";

export interface Shown {
  curve: Curve;
  comb: Comb;
  /** the operation's whole result, for panels */
  result: Record<string, unknown>;
  /** the last try failed: what is shown is the curve before it */
  failure: Failure | null;
}

export interface MadeAnswer {
  curve: Curve;
  comb: Comb;
  [member: string]: unknown;
}

const kSamples = 201;
const kMostSamples = 1201;
const kPerPiece = 40;
const kFollowed = 3; // so many curves of files are asked for while a hand moves them; of more only the drawing moves

/** Enough to see every piece: a long chain gets more. */
export function samplesFor(curve: Curve | undefined): number {
  const pieces = (curve?.pieces as unknown[] | undefined)?.length ?? 1;
  return Math.min(kMostSamples, Math.max(kSamples, kPerPiece * pieces));
}

interface Asked {
  key: string;
  busy: boolean;
}

/** What a shown curve of a file answers, and the drawing of it where a hand has put it since. */
interface Placing {
  curve: Curve;
  placed: Placement | undefined;
  drawn?: { at: Placement | undefined; shown: Shown };
}

export class Live {
  private readonly shown = new Map<number, Shown>();
  private readonly asked = new Map<number, Asked>();
  private readonly failures = new Map<number, Failure>();
  private readonly placings = new Map<number, Placing>();
  /** Told when a curve has come, with the time of the input it answers. */
  onCurve: (id: number) => void = () => {};

  constructor(private readonly client: Client, private readonly store: Store) {
    store.onChange((now, before) => {
      if (now.history.now !== before.history.now || now.draft !== before.draft) this.refresh();
    });
  }

  of(id: number): Shown | undefined {
    const shown = this.shown.get(id);
    const placing = shown && this.placings.get(id);
    const e = placing && entityOf(this.store.doc, id);
    if (!shown || e?.kind !== "fixed" || e.curve !== placing?.curve || e.placed === placing.placed) return shown;
    return this.drawn(shown, e, placing);
  }

  /** The answer for the place is on its way: until then what is drawn is moved. */
  private drawn(shown: Shown, e: Fixed, placing: Placing): Shown {
    if (placing.drawn && placing.drawn.at === e.placed) return placing.drawn.shown;
    const { about } = placing.placed ?? e.placed ?? still([0, 0]);
    const comb = carriedComb(shown.comb, placing.placed ?? still(about), e.placed ?? still(about));
    placing.drawn = { at: e.placed, shown: { ...shown, comb } };
    return placing.drawn.shown;
  }

  failureOf(id: number): Failure | undefined {
    return this.failures.get(id);
  }

  /** Whether an answer is on its way. */
  get asking(): boolean {
    return [...this.asked.values()].some((asked) => asked.busy);
  }

  /** Whether all curves are those of the document as it is. */
  get settled(): boolean {
    return this.store.doc.entities.every((e) => {
      const recipe = this.recipe(e);
      const asked = this.asked.get(e.id);
      return !recipe || (asked?.key === keyOf(recipe) && !asked.busy);
    });
  }

  refresh(): void {
    const doc = this.store.doc;
    const there = new Set(doc.entities.map((e) => e.id));
    for (const id of this.shown.keys())
      if (!there.has(id)) {
        this.shown.delete(id);
        this.asked.delete(id);
        this.failures.delete(id);
        this.placings.delete(id);
      }
    for (const e of doc.entities) void this.update(e);
  }

  private recipe(e: Entity): Recipe | null {
    return recipeOf(e, (id) => this.shown.get(id)?.curve);
  }

  private async update(e: Entity): Promise<void> {
    const asked = this.asked.get(e.id) ?? { key: "", busy: false };
    this.asked.set(e.id, asked);
    if (asked.busy) return; // its answer looks again
    const recipe = this.recipe(e);
    if (!recipe || this.isOneOfMany(e)) return;
    const key = keyOf(recipe);
    if (key === asked.key) {
      this.place(e);
      return;
    }
    asked.key = key;
    asked.busy = true;
    const samples = samplesFor(recipe.request.curve as Curve | undefined);
    const answer = await this.client.quick<MadeAnswer>(recipe.op, {
      ...recipe.request, comb: { samples, graphs: true },
    });
    asked.busy = false;
    if (this.asked.get(e.id) !== asked) return; // gone meanwhile
    this.take(e.id, answer);
    if (answer.ok) this.place(e);
    const now = this.store.doc.entities.find((other) => other.id === e.id);
    if (now) void this.update(now);
    for (const other of this.store.doc.entities)
      if (isMadeOf(other, e.id)) void this.update(other);
    this.onCurve(e.id);
  }

  private isOneOfMany(e: Entity): boolean {
    const { draft, selection } = this.store.state;
    return draft !== null && e.kind === "fixed" && selection.length > kFollowed && selection.includes(e.id)
      && !draft.entities.some((other) => isMadeOf(other, e.id));
  }

  /** What is shown stands where the thing does. */
  private place(e: Entity): void {
    if (e.kind === "fixed") this.placings.set(e.id, { curve: e.curve, placed: e.placed });
  }

  private take(id: number, answer: Answer<MadeAnswer>): void {
    if (answer.ok) {
      this.failures.delete(id);
      const { curve, comb } = answer.result;
      this.shown.set(id, { curve, comb, result: answer.result, failure: null });
      return;
    }
    this.failures.set(id, answer.error);
    const before = this.shown.get(id);
    if (before) this.shown.set(id, { ...before, failure: answer.error });
  }
}

const keyOf = (recipe: Recipe): string => JSON.stringify([recipe.op, recipe.request]);

const isMadeOf = (e: Entity, id: number): boolean =>
  (e.kind === "blend" && e.of.includes(id)) || (e.kind === "mirror" && e.of === id);
