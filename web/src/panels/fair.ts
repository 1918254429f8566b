/** Fairing as steps one can look into. */
import {
  type Curve, defaultsOfFair, type FairedPiece, type FairRequest, type FairResult,
} from "../../generated/operations.ts";
import type { Client, LongWork } from "../api/client.ts";
import { added, type Entity, entityOf, type Faired, type FairTold, type Fresh, lineOf } from "../model/document.ts";
import type { Live } from "../model/live.ts";
import type { Store, Stretch } from "../model/state.ts";
import { button, choice, fact, section, slider } from "../ui/controls.ts";
import { h } from "../ui/dom.ts";
import { measure } from "../view/ticks.ts";
import { verdict } from "./verdict.ts";

type Criterion = NonNullable<FairRequest["criterion"]>;

export interface FairWishes {
  /** 0: by the default rule */
  tolerance: number;
  smoothness: number;
  criterion: Criterion;
  /** what the curve may not pass, as `fair --keep-inside` has it: y>=0 */
  inside: string;
}

const kCriteria: Record<Criterion, string> = { "least-variation": "calmest curvature", "fewest-pieces": "fewest pieces" };

function requestOf(e: Entity, live: Live, wishes: FairWishes): FairRequest {
  const curve = live.of(e.id)?.curve;
  const calm = wishes.criterion === "least-variation" ? { smoothness: wishes.smoothness } : {};
  return {
    ...(e.kind === "scan" ? { line: lineOf(e) } : curve ? { curve } : {}),
    criterion: wishes.criterion,
    ...(wishes.smoothness === defaultsOfFair.smoothness ? {} : calm),
    ...(wishes.tolerance > 0 ? { tolerance: wishes.tolerance } : {}),
    ...(wishes.inside ? { keep_inside: wishes.inside } : {}),
  };
}

function toldOf(r: FairResult, request: FairRequest): FairTold {
  const { line: _line, curve: _curve, ...wishes } = request;
  return {
    request: wishes,
    spline: r.spline as Curve,
    pieces: r.pieces ?? [],
    length: r.length ?? 0,
    noise: r.noise ?? 0,
    tolerance: r.tolerance ?? 0,
    max: r.deviation?.max ?? 0,
    rms: r.deviation?.rms ?? 0,
    within: r.within_tolerance ?? false,
    cancelled: r.cancelled ?? false,
    fairness: r.fairness ?? null,
    notes: r.report ?? [],
  };
}

/** The work, its progress told, its answer put into the document as one step. */
export async function fairIt(client: Client, store: Store, live: Live, e: Entity, wishes: FairWishes,
                             more: FairRequest = {}): Promise<void> {
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
  const curve = answer.result.curve;
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
  private wishes: FairWishes = {
    tolerance: 0, smoothness: defaultsOfFair.smoothness, criterion: defaultsOfFair.criterion, inside: "",
  };

  constructor(private readonly client: Client, private readonly store: Store, private readonly live: Live) {}

  private start(e: Entity, more: FairRequest = {}): void {
    if (!this.store.state.work) void fairIt(this.client, this.store, this.live, e, this.wishes, more);
  }

  element(e: Entity): HTMLElement {
    const told = e.kind === "faired" ? e.told : null;
    return section("Fair", ...this.wishing(e, told), ...(told ? this.steps(e as Faired, told) : this.points(e)));
  }

  private points(e: Entity): (HTMLElement | null)[] {
    if (e.kind !== "scan") return [];
    return [h("dl", { class: "facts" },
      fact("Points", String(lineOf(e).points.length)),
      fact("Noise", measure(e.line.noise ?? 0, 3)),
      fact("Length", measure(e.line.length ?? 0))),
    notes(e.line.notes ?? [])];
  }

  private wishing(e: Entity, told: FairTold | null): (HTMLElement | false)[] {
    const unit = this.store.doc.unit;
    const size = told?.length ?? (e.kind === "scan" ? e.line.length ?? 1 : this.live.of(e.id)?.comb.length ?? 1);
    const now = this.wishes.tolerance || told?.tolerance || 5e-4 * size;
    const again = () => {
      if (told) this.start(e);
    };
    return [
      slider({
        id: "tolerance", label: `Tolerance${unit ? `, ${unit}` : ""}`, value: Math.log10(now / size), min: -5, max: -1.5,
        show: (v) => measure(size * 10 ** v, 3),
        onInput: (v) => { this.wishes.tolerance = size * 10 ** v; },
        onDone: again,
      }),
      choice({
        id: "criterion", label: "Looks for", value: this.wishes.criterion,
        options: Object.entries(kCriteria).map(([value, name]) => ({ value: value as Criterion, name })),
        onChoose: (criterion) => {
          this.wishes.criterion = criterion;
          again();
        },
      }),
      this.wishes.criterion === "least-variation" && slider({
        id: "smoothness", label: "Smoothness", value: this.wishes.smoothness, min: 0, max: 1,
        stops: [{ at: 0, name: "as measured" }, { at: 1, name: "calmest" }], show: (v) => v.toFixed(2),
        onInput: (smoothness) => { this.wishes.smoothness = smoothness; },
        onDone: again,
      }),
      this.keeping(again),
      this.leaving(e),
      h("div", { class: "row" },
        button(told ? "Fair again" : "Fair", () => this.start(e), { class: "primary", id: "fair", disabled: this.store.state.work !== null }),
        h("span", { class: "quiet" }, this.wishes.tolerance > 0 ? "" : "tolerance by the noise")),
    ];
  }

  private keeping(again: () => void): HTMLElement {
    const field = h("input", { type: "text", id: "keep-inside", value: this.wishes.inside, placeholder: "y>=0", "aria-label": "Not past" });
    field.addEventListener("change", () => {
      this.wishes.inside = field.value.trim();
      again();
    });
    return h("div", { class: "row" }, h("label", { for: "keep-inside" }, "Not past"), field);
  }

  /** Points that a click leaves out. */
  private leaving(e: Entity): HTMLElement | false {
    const scan = e.kind === "faired" ? entityOf(this.store.doc, e.of) : e;
    if (scan?.kind !== "scan") return false;
    const count = scan.strays?.length ?? 0;
    const clicking = this.store.state.tool === "strays";
    return h("div", { class: "row" },
      button(clicking ? "Done" : "Leave points out", () => this.store.set({ tool: clicking ? "select" : "strays" }),
        { id: "strays", "aria-pressed": String(clicking) }),
      h("span", { class: "quiet" }, count > 0 ? `${count} left out` : clicking ? "click them" : ""));
  }

  private steps(e: Faired, told: FairTold): (HTMLElement | null)[] {
    const unit = this.store.doc.unit ? ` ${this.store.doc.unit}` : "";
    return [
      ...verdict(told),
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

  private piece(e: Faired, p: FairedPiece, index: number): HTMLElement {
    const readings = (p.interpretations ?? []).slice(0, 5);
    const select = h("select", { id: `reading-${index}`, "aria-label": `Reading of piece ${index}` },
      h("option", { value: "", selected: true }, `${p.rhythm} ${slopes(p.slopes)}`),
      ...readings.filter((r) => r.rhythm !== p.rhythm).map((r) =>
        h("option", { value: r.rhythm }, `as ${r.rhythm} ${slopes(r.slopes)} \u2013 ${(100 * (r.plausibility ?? 0)).toFixed(0)} %`)));
    select.addEventListener("change", () => {
      const rhythm = readings.find((r) => r.rhythm === select.value)?.rhythm;
      if (rhythm) this.start(e, { interpretation: [{ piece: index, rhythm }] });
    });
    const from = p.start ?? 0;
    const point = (stretch: Stretch | null) => this.store.set({ stretch });
    const here = { entity: e.id, from, to: from + (p.length ?? 0) };
    return h("li", {
      pointerenter: () => point(here), pointerleave: () => point(null), focusin: () => point(here), focusout: () => point(null),
    },
      h("span", {}, measure(p.length ?? 0, 3)), select, h("span", { class: "quiet" }, p.impression ?? ""));
  }
}

const slopes = (list: number[] = []) => list.map((s) => s.toFixed(2).replace("-", "\u2212")).join(", ");

const notes = (list: readonly string[]) =>
  list.length === 0 ? null
    : h("details", {}, h("summary", {}, `${list.length} note${list.length > 1 ? "s" : ""}`),
      h("ul", {}, ...list.map((n) => h("li", {}, n))));
