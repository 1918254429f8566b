/** Fairing as steps one can look into. */
import { added, type Entity, type FairPiece, type Faired, type FairTold, type Fresh, type Scan } from "../model/document.ts";
import type { Live } from "../model/live.ts";
import type { Store } from "../model/state.ts";
import { button, choice, fact, section, slider } from "../ui/controls.ts";
import { h } from "../ui/dom.ts";
import { measure } from "../view/ticks.ts";
import type { Client, LongWork } from "../api/client.ts";
import type { Curve, FairResult } from "../../generated/operations.ts";

export interface FairWishes {
  /** 0: by the default rule */
  tolerance: number;
  pieces: number;
  criterion: "fewest-pieces" | "least-variation";
}

export const defaultWishes: FairWishes = { tolerance: 0, pieces: 0, criterion: "least-variation" };

function requestOf(e: Entity, live: Live, wishes: FairWishes): Record<string, unknown> {
  const subject = e.kind === "scan" ? { line: e.line } : { curve: live.of(e.id)?.curve };
  return {
    ...subject,
    criterion: wishes.criterion,
    ...(wishes.tolerance > 0 ? { tolerance: wishes.tolerance } : {}),
    ...(wishes.pieces > 0 ? { pieces: wishes.pieces } : {}),
  };
}

function toldOf(r: FairResult, request: Record<string, unknown>): FairTold {
  const { line: _line, curve: _curve, ...wishes } = request;
  return {
    request: wishes,
    spline: r.spline as Curve,
    pieces: (r.pieces ?? []) as FairPiece[],
    length: r.length ?? 0,
    noise: r.noise ?? 0,
    tolerance: r.tolerance ?? 0,
    max: r.deviation?.max ?? 0,
    rms: r.deviation?.rms ?? 0,
    within: r.within_tolerance ?? false,
    cancelled: r.cancelled ?? false,
    notes: r.report ?? [],
  };
}

/** The work, its progress told, its answer put into the document as one step. */
export async function fairIt(client: Client, store: Store, live: Live, e: Entity, wishes: FairWishes,
                             more: Record<string, unknown> = {}): Promise<void> {
  const subject = e.kind === "faired" ? store.doc.entities.find((x) => x.id === e.of) ?? e : e;
  const request = { ...requestOf(subject, live, wishes), ...more };
  const work: LongWork<FairResult> = client.long("fair", request, (fraction, doing) => {
    if (store.state.work) store.set({ work: { ...store.state.work, fraction, doing } });
  });
  store.set({ work: { doing: "reading the points", fraction: 0, cancel: () => work.cancel() }, message: null });
  const answer = await work.answer;
  store.set({ work: null });
  if (!answer.ok) {
    store.say(answer.error.message, answer.error.hint ?? "", answer.error.code !== "cancelled");
    return;
  }
  const told = toldOf(answer.result, request);
  const curve = answer.result.curve as Curve;
  const doc = store.state.history.now;
  const old = doc.entities.find((x) => x.kind === "faired" && x.of === subject.id);
  if (old) {
    const entities = doc.entities.map((x) => (x.id === old.id ? ({ ...x, curve, told } as Faired) : x));
    store.commit("Fair", { ...doc, entities }, { selection: [old.id] });
    return;
  }
  const fresh: Fresh<Faired> = { kind: "faired", name: `${subject.name}, faired`, layer: subject.layer, curve, of: subject.id, told };
  const made = added(doc, fresh);
  store.commit("Fair", made.doc, { selection: [made.id] });
}

export class FairPanel {
  private wishes: FairWishes = { ...defaultWishes };

  constructor(private readonly client: Client, private readonly store: Store, private readonly live: Live) {}

  start(e: Entity): void {
    void fairIt(this.client, this.store, this.live, e, this.wishes);
  }

  element(e: Entity): HTMLElement {
    const told = e.kind === "faired" ? e.told : null;
    return section("Fair", ...this.wishing(e, told), ...(told ? this.steps(e as Faired, told) : this.points(e)));
  }

  private points(e: Entity): (HTMLElement | null)[] {
    if (e.kind !== "scan") return [];
    return [h("dl", { class: "facts" },
      fact("Points", String((e as Scan).line.points.length)),
      fact("Noise", measure(e.line.noise ?? 0, 3)),
      fact("Length", measure(e.line.length ?? 0))),
    notes(e.line.notes ?? [])];
  }

  private wishing(e: Entity, told: FairTold | null): HTMLElement[] {
    const unit = this.store.doc.unit;
    const size = told?.length ?? (e.kind === "scan" ? e.line.length ?? 1 : this.live.of(e.id)?.comb.length ?? 1);
    const now = this.wishes.tolerance || told?.tolerance || 5e-4 * size;
    const start = () => this.start(e);
    return [
      slider({
        id: "tolerance", label: `Tolerance${unit ? `, ${unit}` : ""}`, value: Math.log10(now / size), min: -5, max: -1.5,
        show: (v) => measure(size * 10 ** v, 3),
        onInput: (v) => { this.wishes.tolerance = size * 10 ** v; },
        onDone: () => { if (told) start(); },
      }),
      choice({
        id: "criterion", label: "Looks for", value: this.wishes.criterion,
        options: [
          { value: "fewest-pieces", name: "fewest pieces" },
          { value: "least-variation", name: "calmest curvature" },
        ] as const,
        onChoose: (criterion) => {
          this.wishes.criterion = criterion;
          if (told) start();
        },
      }),
      h("div", { class: "row" },
        button(told ? "Fair again" : "Fair", start, { class: "primary", id: "fair", disabled: this.store.state.work !== null }),
        h("span", { class: "quiet" }, this.wishes.tolerance > 0 ? "" : "tolerance by the noise")),
    ];
  }

  private steps(e: Faired, told: FairTold): (HTMLElement | null)[] {
    const unit = this.store.doc.unit ? ` ${this.store.doc.unit}` : "";
    return [
      h("p", { class: told.within ? "verdict good" : "verdict bad", id: "verdict" },
        told.cancelled ? "Stopped early: the best found" : told.within ? "Within the tolerance" : "Beyond the tolerance"),
      h("dl", { class: "facts" },
        fact("Largest deviation", measure(told.max, 3) + unit),
        fact("Root mean square", measure(told.rms, 3) + unit),
        fact("Tolerance", measure(told.tolerance, 3) + unit),
        fact("Noise", measure(told.noise, 3) + unit)),
      h("h3", {}, `Pieces (${told.pieces.length})`),
      h("ol", { class: "pieces" }, ...told.pieces.map((p, i) => this.piece(e, p, i))),
      notes(told.notes),
    ];
  }

  private piece(e: Faired, p: FairPiece, index: number): HTMLElement {
    const readings = p.interpretations.slice(0, 5);
    const select = h("select", { id: `reading-${index}`, "aria-label": `Reading of piece ${index}` },
      h("option", { value: "", selected: true }, `${p.rhythm} ${slopes(p.slopes)}`),
      ...readings.filter((r) => r.rhythm !== p.rhythm).map((r) =>
        h("option", { value: r.rhythm }, `as ${r.rhythm} ${slopes(r.slopes)} \u2013 ${(100 * r.plausibility).toFixed(0)} %`)));
    select.addEventListener("change", () => {
      if (select.value)
        void fairIt(this.client, this.store, this.live, e, this.wishes,
          { interpretation: [{ piece: index, rhythm: select.value }] });
    });
    return h("li", { "data-start": p.start, "data-length": p.length },
      h("span", {}, `${measure(p.length, 3)}`), select, h("span", { class: "quiet" }, p.impression));
  }
}

const slopes = (list: number[]) => list.map((s) => s.toFixed(2).replace("-", "\u2212")).join(", ");

const notes = (list: readonly string[]) =>
  list.length === 0 ? null
    : h("details", {}, h("summary", {}, `${list.length} note${list.length > 1 ? "s" : ""}`),
      h("ul", {}, ...list.map((n) => h("li", {}, n))));
