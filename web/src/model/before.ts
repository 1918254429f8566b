/** The splines through measured points, for looking at beside what fairing made of them. */
import type { Client } from "../api/client.ts";
import { entityOf, type Faired } from "./document.ts";
import { type MadeAnswer, type Shown } from "./live.ts";
import type { Store } from "./state.ts";

const kSamples = 1001;

export class Before {
  private readonly shown = new Map<object, Shown | null>();
  onCurve: () => void = () => {};

  constructor(private readonly client: Client, private readonly store: Store) {}

  of(id: number): Shown | undefined {
    const e = entityOf(this.store.doc, id);
    if (e?.kind !== "faired") return undefined;
    const spline = e.told.spline as object;
    const known = this.shown.get(spline);
    if (known === undefined) {
      this.shown.set(spline, null);
      void this.ask(e, spline);
    }
    return known ?? undefined;
  }

  private async ask(e: Faired, spline: object): Promise<void> {
    const answer = await this.client.call<MadeAnswer>("curve.show", {
      curve: e.told.spline, comb: { samples: kSamples, graphs: true },
    });
    if (!answer.ok) return;
    this.shown.set(spline, {
      curve: answer.result.curve, comb: answer.result.comb, result: answer.result, failure: null,
    });
    this.onCurve();
  }
}
