/** A curvature drawn by hand in the curvature graph, and the curve that follows it ([Sketch], Fig. 18). */
import type { Curve, FitCurvatureRequest, FitCurvatureResult } from "../../generated/operations.ts";
import type { Client } from "../api/client.ts";
import type { CurvaturePlot } from "../graphs/curvature.ts";
import { type Entity, entityOf, type Fixed, recast, withEntity } from "../model/document.ts";
import type { Live } from "../model/live.ts";
import { type Store, workTold } from "../model/state.ts";
import { button, section, toggle } from "../ui/controls.ts";
import { h } from "../ui/dom.ts";
import { measure } from "../view/ticks.ts";

const kMostDegree = 5; // what fit.curvature takes

export function canFollow(curve: Curve | undefined): boolean {
  const members = (curve?.["curves"] ?? [curve]) as (Curve | undefined)[];
  return members.every((c) => c?.type === "bezier" && (c["points"] as unknown[]).length <= kMostDegree + 1 && !c["weights"]);
}

export class TargetPanel {
  private holdEnd = true;

  constructor(private readonly client: Client, private readonly store: Store, private readonly live: Live,
              plot: CurvaturePlot) {
    plot.onTarget = (target) => void this.follow(target);
  }

  element(e: Entity): HTMLElement | null {
    if (e.kind !== "fixed" || !canFollow(e.curve)) return null;
    const drawing = this.store.state.targeting;
    return section("Curvature target",
      h("div", { class: "row wrap" },
        button(drawing ? "Draw it in the graph\u2026" : "Draw it", () => this.store.set({ targeting: !drawing }), {
          id: "draw-target", "aria-pressed": String(drawing),
        }),
        button("Smooth", () => void this.drive("smooth"), { id: "target-smooth" }),
        button("To rhythm", () => void this.drive("rhythm"), { id: "target-rhythm" })),
      toggle({ id: "hold-end", label: "The end stays", value: this.holdEnd, onChange: (v) => { this.holdEnd = v; } }),
      h("p", { class: "quiet" }, drawing ? "Draw a line in the curvature graph; the curve follows when you let go." : ""));
  }

  private subject(): Fixed | null {
    const e = entityOf(this.store.doc, this.store.state.selection.at(-1) ?? null);
    return e?.kind === "fixed" ? e : null;
  }

  /** Lengths as the graph has them; the operation wants shares of the whole. */
  private async follow(target: readonly (readonly [number, number])[]): Promise<void> {
    const e = this.subject();
    const length = e && this.live.of(e.id)?.comb.length;
    this.store.set({ targeting: false });
    if (!length || target.length < 2) return;
    await this.drive(target.map(([s, curvature]) => ({ along: Math.min(1, Math.max(0, s / length)), curvature })));
  }

  private async drive(target: FitCurvatureRequest["target"]): Promise<void> {
    const e = this.subject();
    if (!e || this.store.state.work) return;
    const given = this.live.of(e.id)?.curve ?? e.curve;
    const work = this.client.long<FitCurvatureResult>("fit.curvature", { curve: given, target, hold_end: this.holdEnd },
      (fraction, doing) => workTold(this.store, fraction, doing));
    this.store.set({ work: { doing: "following the curvature", fraction: 0, trace: [], cancel: () => work.cancel() } });
    const answer = await work.answer;
    this.store.set({ work: null });
    if (!answer.ok) return this.store.say(answer.error.message, answer.error.hint ?? "", true);
    const { curve, before, after, moved } = answer.result;
    this.store.commit("Follow curvature", withEntity(this.store.state.history.now, recast(e, curve as Curve, given)));
    this.store.say(`Curvature off its target by ${measure(before ?? 0, 3)}, now ${measure(after ?? 0, 3)}`, `moved by at most ${measure(moved ?? 0, 3)}`);
  }
}
