/** How far the points of a scan lie from what fairing made of them. */
import type { Curve, CurveDeviationResult } from "../../generated/operations.ts";
import type { Client } from "../api/client.ts";
import { entityOf, lineOf } from "./document.ts";
import type { Store } from "./state.ts";

export interface DeviationTold {
  places: CurveDeviationResult;
  tolerance: number;
}

export class Deviation {
  private readonly known = new WeakMap<Curve, CurveDeviationResult | null>();
  onCame: () => void = () => {};

  constructor(private readonly client: Client, private readonly store: Store) {}

  /** Asked for only where somebody looks. */
  of(id: number): DeviationTold | undefined {
    const e = entityOf(this.store.doc, id);
    if (e?.kind !== "faired" || !this.store.state.looks.deviation) return undefined;
    const scan = entityOf(this.store.doc, e.of);
    if (scan?.kind !== "scan") return undefined;
    const known = this.known.get(e.curve);
    if (known === undefined) {
      this.known.set(e.curve, null);
      void this.ask(e.curve, lineOf(scan).points);
    }
    return known ? { places: known, tolerance: e.told.tolerance } : undefined;
  }

  private async ask(curve: Curve, points: readonly (readonly number[])[]): Promise<void> {
    const work = this.client.long<CurveDeviationResult>("curve.deviation", { curve, points }, () => {});
    const answer = await work.answer;
    if (!answer.ok) return;
    this.known.set(curve, answer.result);
    this.onCame();
  }
}
