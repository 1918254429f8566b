/** What a curve was before: the spline through measured points, the curve that was driven or slid. */
import type { Curve } from "../../generated/operations.ts";
import type { Client } from "../api/client.ts";
import { type Entity, entityOf } from "./document.ts";
import { type MadeAnswer, type Shown } from "./live.ts";
import type { Store } from "./state.ts";

const kSamples = 1001;

function curveBefore(e: Entity | undefined): Curve | undefined {
  switch (e?.kind) {
    case "faired":
      return e.told.spline;
    case "sliding":
      return e.given;
    case "fixed":
      return e.before;
    default:
      return undefined;
  }
}

export class Before {
  private readonly shown = new WeakMap<Curve, Shown | null>();
  onCurve: () => void = () => {};

  constructor(private readonly client: Client, private readonly store: Store) {}

  of(id: number): Shown | undefined {
    const curve = curveBefore(entityOf(this.store.doc, id));
    if (!curve) return undefined;
    const known = this.shown.get(curve);
    if (known === undefined) {
      this.shown.set(curve, null);
      void this.ask(curve);
    }
    return known ?? undefined;
  }

  private async ask(curve: Curve): Promise<void> {
    const answer = await this.client.call<MadeAnswer>("curve.show", { curve, comb: { samples: kSamples, graphs: true } });
    if (!answer.ok) return;
    this.shown.set(curve, {
      curve: answer.result.curve, comb: answer.result.comb, result: answer.result, failure: null,
    });
    this.onCurve();
  }
}
