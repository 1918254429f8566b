/** Fairing as steps one can look into: what is asked for, and an answer that follows it. */
import type { FairRequest, FairResult } from "../../generated/operations.ts";
import type { Client, LongWork } from "../api/client.ts";
import { type Entity, entityOf, type FairTold } from "../model/document.ts";
import { type Criterion, type FairWishes, noWishes, putFaired, requestOf, toldOf, wishesOf } from "../model/fairing.ts";
import type { Live } from "../model/live.ts";
import { type Store, workTold } from "../model/state.ts";
import { button, choice, section, slider } from "../ui/controls.ts";
import { h } from "../ui/dom.ts";
import { measure } from "../view/ticks.ts";
import { FairSteps } from "./fairsteps.ts";

const kCriteria: Record<Criterion, string> = { "least-variation": "calmest curvature", "fewest-pieces": "fewest pieces" };
const kStill = 250; // ms that a hand rests before the answer follows it
const kOwnLine = "line";
const kSymmetries = [
  { value: "off", name: "as measured" }, { value: "auto", name: "exact where it is found" }, { value: kOwnLine, name: "about a line" },
] as const;

export class FairPanel {
  private wishes: FairWishes = noWishes();
  /** of what the wishes are */
  private subject = 0;
  private work: LongWork<FairResult> | null = null;
  /** the newest start: answers of those before it are not waited for */
  private turn = 0;
  private timer: ReturnType<typeof setTimeout> | undefined;
  /** the hand chose a line, and has yet to write it */
  private ownLine = false;
  private readonly steps: FairSteps;

  constructor(private readonly client: Client, private readonly store: Store, private readonly live: Live) {
    this.steps = new FairSteps(store, (e, more) => void this.start(e, more));
  }

  element(e: Entity): HTMLElement {
    const told = e.kind === "faired" ? e.told : null;
    const subject = e.kind === "faired" ? e.of : e.id;
    if (subject !== this.subject) {
      this.wishes = told ? wishesOf(told.request) : noWishes();
      this.ownLine = false;
    }
    this.subject = subject;
    return section("Fair", ...(told ? this.steps.outcome(told) : []), ...this.wishing(e, told), ...this.steps.elements(e));
  }

  /** The work, its progress told, its answer put into the document. A newer wish takes its place. */
  private async start(e: Entity, more: FairRequest = {}): Promise<void> {
    clearTimeout(this.timer);
    if (this.store.state.work && !this.work) return; // something else is being worked at
    const turn = ++this.turn;
    this.work?.cancel();
    const subject = e.kind === "faired" ? entityOf(this.store.doc, e.of) ?? e : e;
    const request = { ...requestOf(subject, this.live, this.wishes), ...more };
    const work: LongWork<FairResult> = this.client.long("fair", request, (fraction, doing) => {
      if (turn === this.turn) workTold(this.store, fraction, doing);
    });
    this.work = work;
    this.store.set({ work: { doing: "reading the points", fraction: 0, trace: [], cancel: () => work.cancel() }, message: null });
    const answer = await work.answer;
    if (turn !== this.turn) return;
    this.work = null;
    this.store.set({ work: null });
    if (!answer.ok) return this.store.say(answer.error.message, answer.error.hint ?? "", answer.error.code !== "cancelled");
    if (answer.result.curve) putFaired(this.store, subject, answer.result.curve, toldOf(answer.result, request));
  }

  /** What has been faired follows the hand as soon as that rests. */
  private follow(e: Entity): void {
    clearTimeout(this.timer);
    if (e.kind !== "faired") return;
    this.timer = setTimeout(() => {
      if (entityOf(this.store.doc, e.id)) void this.start(e); // it may have been undone meanwhile
    }, kStill);
  }

  private wishing(e: Entity, told: FairTold | null): (HTMLElement | false)[] {
    const unit = this.store.doc.unit;
    const size = told?.length ?? (e.kind === "scan" ? e.line.length ?? 1 : this.live.of(e.id)?.comb.length ?? 1);
    const now = this.wishes.tolerance || told?.tolerance || 5e-4 * size;
    const put = (change: Partial<FairWishes>) => {
      this.wishes = { ...this.wishes, ...change };
      this.follow(e);
    };
    const calmest = this.wishes.criterion === "least-variation";
    return [
      slider({
        id: "tolerance", label: `Tolerance${unit ? `, ${unit}` : ""}`, value: Math.log10(now / size), min: -5, max: -1.5,
        show: (v) => measure(size * 10 ** v, 3), read: (typed) => Math.log10(typed / size),
        unset: this.wishes.tolerance || told ? undefined : "auto",
        onInput: (v) => put({ tolerance: size * 10 ** v }), onDone: () => {},
      }),
      choice({
        id: "criterion", label: "Looks for", value: this.wishes.criterion,
        options: Object.entries(kCriteria).map(([value, name]) => ({ value: value as Criterion, name })),
        onChoose: (criterion) => {
          put({ criterion });
          this.renew();
        },
      }),
      calmest && slider({
        id: "smoothness", label: "Smoothness", value: this.wishes.smoothness, min: 0, max: 1,
        stops: [{ at: 0, name: "as measured" }, { at: 1, name: "calmest" }], show: (v) => v.toFixed(2),
        onInput: (smoothness) => put({ smoothness }), onDone: () => {},
      }),
      calmest && this.rate(unit, put),
      this.field("keep-inside", "Not past", this.wishes.inside, "y>=0", (inside) => put({ inside })),
      ...this.symmetry(told, put),
      h("div", { class: "row" },
        button(told ? "Fair again" : "Fair", () => void this.start(e), { class: "primary", id: "fair", disabled: this.store.state.work !== null }),
        h("span", { class: "quiet" }, this.wishes.tolerance > 0 ? "" : "tolerance by the noise")),
    ];
  }

  private rate(unit: string, put: (change: Partial<FairWishes>) => void): HTMLElement {
    const label = `Curvature changes by at most${unit ? `, 1/${unit}\u00b2` : ""}`;
    return this.field("max-rate", label, this.wishes.rate > 0 ? String(this.wishes.rate) : "", "any", (text) => {
      const rate = text === "" ? 0 : Number(text.replace(",", "."));
      if (rate >= 0) put({ rate });
      else this.renew();
    });
  }

  /** Exactly the same on both sides of a line: of the one that is found, or of a given one. */
  private symmetry(told: FairTold | null, put: (change: Partial<FairWishes>) => void): (HTMLElement | false)[] {
    const { symmetric } = this.wishes;
    const own = this.ownLine || !["off", "auto"].includes(symmetric);
    const found = told?.symmetry;
    return [
      choice({
        id: "symmetric", label: "Symmetry", value: own ? kOwnLine : (symmetric as "off" | "auto"), options: kSymmetries,
        onChoose: (value) => {
          this.ownLine = value === kOwnLine;
          if (value !== kOwnLine) put({ symmetric: value });
          this.renew();
        },
      }),
      own && this.field("symmetry-line", "Line", ["off", "auto"].includes(symmetric) ? "" : symmetric, "x=0, or 0,0:90", (line) => {
        if (line) put({ symmetric: line });
      }),
      !own && !!found && !found.exact && h("p", { class: "quiet" }, "The points are symmetric within their noise."),
    ];
  }

  /** Other controls for other wishes. */
  private renew(): void {
    this.store.set({ selection: [...this.store.state.selection] });
  }

  private field(id: string, label: string, value: string, placeholder: string, done: (text: string) => void): HTMLElement {
    const input = h("input", { type: "text", id, value, placeholder });
    input.addEventListener("change", () => done(input.value.trim()));
    return h("div", { class: "row" }, h("label", { for: id }, label), input);
  }
}
