/** Where the handle in hand may stand for its curve to be drawn, and the nearest that can be. */
import type { Curve, LacRegionResult } from "../../generated/operations.ts";
import type { Client } from "../api/client.ts";
import { type Comb, type Compound, entityOf, type Point, type Segment, withHandle } from "./document.ts";
import type { Live, MadeAnswer } from "./live.ts";
import { recipeOf } from "./recipe.ts";
import type { Store } from "./state.ts";

const kSamples = 101;

type Subject = Segment | Compound;

/** Everything the region depends on: the handles that stay, and the slopes. */
const keyOf = (e: Subject, handle: number): string =>
  JSON.stringify([e.points.filter((_, i) => i !== handle), e.alpha, e.kind === "compound" ? e.ratio : null, handle]);

export class DrawableRegion {
  outlines: readonly (readonly Point[])[] = [];
  /** the nearest curve that can be drawn, where the one in hand cannot */
  nearest: Comb | null = null;
  private key = "";
  private busy = false;
  onChange: () => void = () => {};

  constructor(private readonly client: Client, private readonly store: Store, private readonly live: Live) {
    store.onChange((now, before) => {
      if (now.dragged !== before.dragged || now.draft !== before.draft) void this.update();
    });
  }

  private subject(): { e: Subject; handle: number } | null {
    const { dragged } = this.store.state;
    const e = entityOf(this.store.doc, dragged?.entity ?? null);
    return dragged && (e?.kind === "segment" || e?.kind === "compound") ? { e, handle: dragged.handle } : null;
  }

  private clear(): void {
    this.outlines = [];
    this.nearest = null;
    this.key = "";
  }

  /** Looks again whenever an answer has come: of several moves only the newest is asked for. */
  async update(): Promise<void> {
    const subject = this.subject();
    if (!subject) return this.clear();
    if (this.busy) return;
    const { e, handle } = subject;
    const key = keyOf(e, handle);
    const fails = this.live.failureOf(e.id) !== undefined;
    if (!fails) this.nearest = null;
    if (key === this.key && !fails) return;
    this.busy = true;
    const answer = await this.client.quick<LacRegionResult>("lac.region", {
      points: e.points, handle, alpha: e.alpha, ...(e.kind === "compound" ? { ratio: e.ratio } : {}),
    });
    if (answer.ok) {
      this.outlines = (answer.result.outlines ?? []) as Point[][];
      this.key = key;
      const near = answer.result.nearest as Point | undefined;
      this.nearest = near ? await this.drawn(withHandle(e, handle, near) as Subject) : null;
    }
    this.busy = false;
    if (!this.subject()) this.clear();
    else if (this.subject()?.e !== e) void this.update();
    this.onChange();
  }

  private async drawn(e: Subject): Promise<Comb | null> {
    const recipe = recipeOf(e, (): Curve | undefined => undefined);
    if (!recipe) return null;
    const answer = await this.client.quick<MadeAnswer>(recipe.op, {
      ...recipe.request, comb: { samples: kSamples, graphs: false },
    });
    return answer.ok ? answer.result.comb : null;
  }
}
