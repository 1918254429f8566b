/** A curve's place in the alpha-s plane, and its way to Class A: the place is a point one drags. */
import type { Curve, CurveEditResult, CurvePlaneResult, EvaluationShown } from "../../generated/operations.ts";
import type { Client } from "../api/client.ts";
import { paletteOf } from "../canvas/scene.ts";
import { type Placed, PlanePlot } from "../graphs/plane.ts";
import { added, type Entity, entityOf, type Fresh, type Point, type Sliding, withEntity } from "../model/document.ts";
import type { Live } from "../model/live.ts";
import type { Store } from "../model/state.ts";
import { button, choice, fact, slider } from "../ui/controls.ts";
import { fill, h } from "../ui/dom.ts";
import { measure } from "../view/ticks.ts";

const kTypes = ["", "least energy", "Class A", "one matrix, not Class A", "several matrices", "no matrix"];
const kNudge = 0.01; // of the plane, by an arrow

const placeOf = (e: EvaluationShown | undefined): Point | null =>
  e && typeof e.alpha === "number" && typeof e.s === "number" ? [e.alpha, e.s] : null;
const nearOf = (e: EvaluationShown | undefined): Point | null =>
  e?.nearest && typeof e.nearest.alpha === "number" ? [e.nearest.alpha, e.nearest.s ?? 1] : null;
const inWords = (e: EvaluationShown): string => `${e.type} \u2013 ${kTypes[e.type ?? 5]}`;

export class ClassAPanel {
  readonly plot = new PlanePlot();
  private open = false;
  private readonly facts = h("dl", { class: "facts pairs", id: "class-a" });
  private readonly known = new WeakMap<Curve, CurvePlaneResult | string>();
  private entity: number | null = null;

  constructor(private readonly client: Client, private readonly store: Store, private readonly live: Live) {
    this.plot.onResize = () => this.follow();
    const { canvas } = this.plot;
    canvas.addEventListener("pointerdown", (e) => {
      canvas.setPointerCapture(e.pointerId);
      this.drag(e);
    });
    canvas.addEventListener("pointermove", (e) => {
      if (e.buttons & 1) this.drag(e);
    });
    canvas.addEventListener("pointerup", () => this.commit());
    canvas.addEventListener("keydown", (e) => this.key(e));
  }

  private given(): { e: Entity; curve: Curve } | null {
    const e = entityOf(this.store.doc, this.entity);
    const curve = e?.kind === "sliding" ? e.given : e && this.live.of(e.id)?.curve;
    return e && curve ? { e, curve } : null;
  }

  private plane(curve: Curve): CurvePlaneResult | string | undefined {
    const known = this.known.get(curve);
    if (known === undefined && !this.store.state.draft) {
      this.known.set(curve, "\u2026");
      void this.client.call<CurvePlaneResult>("curve.plane", { curve }).then((answer) => {
        this.known.set(curve, answer.ok ? answer.result : answer.error.message);
        this.follow();
      });
    }
    return known;
  }

  element(e: Entity): HTMLElement {
    this.entity = e.id;
    const details = h("details", { open: this.open, id: "class-a-panel" }, h("summary", {}, h("h2", {}, "Class A")));
    details.addEventListener("toggle", () => {
      this.open = details.open;
      this.follow();
    });
    details.append(h("div", { class: "plane" }, this.plot.element), this.facts, ...this.controls(e));
    queueMicrotask(() => this.follow());
    return h("section", {}, details);
  }

  private controls(e: Entity): HTMLElement[] {
    if (e.kind !== "sliding")
      return [h("div", { class: "row" },
        button("Slide to least energy", () => this.slide(null), { id: "slide", class: "primary" }),
        h("span", { class: "quiet" }, "or drag the point"))];
    const put = (change: Partial<Sliding>) => withEntity(this.store.doc, { ...this.current(e), ...change });
    return [
      slider({
        id: "amount", label: "Amount", value: e.amount, min: 0, max: 1, show: (v) => v.toFixed(2),
        onInput: (amount) => this.store.draft(put({ amount })), onDone: () => this.commit(),
      }),
      choice({
        id: "hold", label: "Holds", value: e.hold,
        options: [{ value: "ends-and-tangent", name: "ends and tangent" }, { value: "ends", name: "both ends" },
          { value: "start", name: "start and tangent" }] as const,
        onChoose: (hold) => this.store.commit("Hold", put({ hold })),
      }),
      h("div", { class: "row" },
        button("To least energy", () => this.store.commit("Slide", put({ target: null, amount: 1 })), { id: "to-minimum" }),
        button("As it was", () => this.store.commit("Slide", put({ amount: 0 })), { id: "as-given" })),
    ];
  }

  private current(e: Sliding): Sliding {
    return (entityOf(this.store.doc, e.id) ?? e) as Sliding;
  }

  /** A curve of a file slides itself; of a drawn one a sliding copy is made. */
  private slide(target: Sliding["target"]): void {
    const given = this.given();
    if (!given) return;
    const { e, curve } = given;
    const fresh: Fresh<Sliding> = {
      kind: "sliding", name: e.name, layer: e.layer, given: curve, target, hold: target ? "ends" : "ends-and-tangent", amount: 1,
    };
    const doc = this.store.state.history.now;
    if (e.kind === "fixed") {
      const sliding: Sliding = { ...fresh, layer: e.layer, id: e.id, visible: e.visible, locked: e.locked, color: e.color };
      this.store.commit("Slide to Class A", withEntity(doc, sliding), { selection: [e.id] });
      return;
    }
    const made = added(doc, { ...fresh, name: `${e.name}, Class A` });
    this.store.commit("Slide to Class A", made.doc, { selection: [made.id] });
  }

  private drag(event: PointerEvent): void {
    const given = this.given();
    if (!given || typeof this.plane(given.curve) !== "object") return;
    this.move(given.e, this.plot.placeAt(event.offsetX, event.offsetY));
  }

  private move(e: Entity, target: { alpha: number; s: number }): void {
    if (e.kind !== "sliding") return this.slide(target);
    const hold = e.hold === "ends-and-tangent" && e.target === null ? "ends" : e.hold;
    this.store.draft(withEntity(this.store.doc, { ...e, target, hold, amount: 1 }));
  }

  private commit(): void {
    if (this.store.state.draft) this.store.commit("Slide", this.store.state.draft);
  }

  private key(event: KeyboardEvent): void {
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    const given = this.given();
    const plane = given && this.plane(given.curve);
    if (!step || !given || typeof plane !== "object" || plane === null) return;
    const now = this.placed(given.e, plane).now ?? [0.3, 1.2];
    const wide = event.shiftKey ? 10 : 1;
    const [low, high] = plane.s as [number, number];
    const [, widest] = plane.alpha as [number, number];
    this.move(given.e, {
      alpha: Math.min(widest, Math.max(0, now[0] + wide * (step[0] as number) * kNudge * widest)),
      s: Math.min(high, Math.max(low, now[1] + wide * (step[1] as number) * kNudge * (high - low))),
    });
    this.commit();
    event.preventDefault();
    event.stopPropagation();
  }

  private placed(e: Entity, plane: CurvePlaneResult): Placed {
    const edited = e.kind === "sliding" ? (this.live.of(e.id)?.result as unknown as CurveEditResult | undefined) : undefined;
    const now = edited?.after ?? plane.value;
    const minimum = plane.value?.minimum;
    return {
      plane,
      given: e.kind === "sliding" ? placeOf(plane.value) ?? nearOf(plane.value) : null,
      now: placeOf(now) ?? nearOf(now),
      near: placeOf(now) === null,
      minimum: minimum ? [minimum.alpha ?? 0, minimum.s ?? 1] : null,
      path: (edited?.path ?? []) as Point[],
    };
  }

  /** The curve has moved, or its plane has come. */
  follow(): void {
    const given = this.open && this.plot.element.isConnected ? this.given() : null;
    if (!given) return;
    const plane = this.plane(given.curve);
    const colors = paletteOf(this.store.state);
    if (typeof plane !== "object") {
      this.plot.paint(null, colors);
      fill(this.facts, h("p", { class: "quiet" }, plane ?? ""));
      return;
    }
    this.plot.paint(this.placed(given.e, plane), colors);
    const edited = given.e.kind === "sliding" ? (this.live.of(given.e.id)?.result as unknown as CurveEditResult | undefined) : undefined;
    fill(this.facts, ...this.told(edited?.before ?? plane.value, edited?.after));
  }

  private told(before: EvaluationShown | undefined, after: EvaluationShown | undefined): HTMLElement[] {
    const now = after ?? before;
    if (!before || !now) return [];
    const row = (name: string, of: (e: EvaluationShown) => string) =>
      after ? h("div", { class: "fact" }, h("dt", {}, name), h("dd", { class: "was" }, of(before)), h("dd", {}, of(after)))
        : fact(name, of(before));
    const number = (v: number | null | undefined, digits: number) => (typeof v === "number" ? measure(v, digits) : "\u2013");
    return [
      h("div", { class: "fact wide" }, h("dt", {}, "Type"), h("dd", { id: "class-a-type", class: now.type && now.type <= 2 ? "good" : "" }, inWords(now))),
      row("CAV", (e) => number(e.cav, 4)),
      row("\u03b1", (e) => number(e.alpha, 4)),
      row("s", (e) => number(e.s, 4)),
      row("Strain energy", (e) => number(e.energy, 4)),
      row("Monotone curvature", (e) => e.monotone ?? "undecided"),
      ...(now.nearest ? [fact("Nearest of one matrix", `${number(now.nearest.distance, 3)} away, CAV ${number(now.nearest.cav, 3)}`)] : []),
      ...(before.approximation ? [fact("Approximated within", number(before.approximation.deviation, 3))] : []),
    ];
  }
}
