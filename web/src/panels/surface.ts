/** A surface: what light and curvature show, what it is worth, and its way to Class A. */
import {
  type CurveCondition, defaultsOfSurfaceEdit, type NetworkCurveShown, type PatchValueShown, type Surface, type SurfaceEditRequest,
  type SurfaceEditResult, type SurfaceSavResult, type SurfaceValueShown,
} from "../../generated/operations.ts";
import type { Client } from "../api/client.ts";
import { paletteOf } from "../canvas/scene.ts";
import { entityOf, type SurfaceEntity, type SurfaceWishes, withEntity } from "../model/document.ts";
import { type Store, workTold } from "../model/state.ts";
import { legend, type SurfaceLook } from "../surfaces/mesh.ts";
import { networkOf, type SurfaceLooks, type SurfaceStage } from "../surfaces/stage.ts";
import { button, choice, fact, section, slider, toggle } from "../ui/controls.ts";
import { fill, h } from "../ui/dom.ts";
import { measure } from "../view/ticks.ts";
import { NetworkPlane, placeOf } from "./networkplane.ts";

const kLooks: readonly { value: SurfaceLook; name: string }[] = [
  { value: "zebra", name: "zebra" }, { value: "reflection", name: "reflection lines" }, { value: "isophotes", name: "isophotes" },
  { value: "mean", name: "mean curvature" }, { value: "gaussian", name: "Gaussian curvature" }, { value: "shaded", name: "shaded" },
];
const kKeep: readonly { value: SurfaceWishes["keep"]; name: string }[] = [
  { value: "start", name: "first corner" }, { value: "corners", name: "corners" }, { value: "joints", name: "joints" },
  { value: "boundary", name: "boundary" },
];

const nameOf = (patch: readonly number[] = []): string => patch.join(", ");

interface Told {
  before: SurfaceValueShown;
  after: SurfaceValueShown | null;
  edit: SurfaceEditResult | null;
}

export class SurfacePanel {
  private readonly values = new WeakMap<Surface, SurfaceValueShown | null>();
  private readonly edits = new WeakMap<Surface, SurfaceEditResult>();
  private wishes: SurfaceWishes = { keep: "corners", amount: 1, conditions: [] };
  private readonly table = h("div", { id: "sav" });
  private readonly scale = h("div", { class: "scale" });
  private readonly plane: NetworkPlane;
  private entity = 0;
  private patch: string | null = null; // of several: the one whose curves are listed; null: the worst

  constructor(private readonly client: Client, private readonly store: Store, private readonly stage: SurfaceStage) {
    this.plane = new NetworkPlane(client);
    stage.onRange = () => this.renderScale();
  }

  element(e: SurfaceEntity): HTMLElement[] {
    if (this.entity !== e.id) this.wishes = e.wishes ?? { keep: "corners", amount: 1, conditions: [] };
    if (this.entity !== e.id) this.patch = null;
    this.entity = e.id;
    const { looks } = this.stage;
    const curved = looks.look === "mean" || looks.look === "gaussian";
    queueMicrotask(() => this.follow());
    return [
      section("Light and curvature",
        choice({ id: "surface-look", label: "Shows", value: looks.look, options: kLooks, onChoose: (look) => this.choose({ look }) }),
        !curved && looks.look !== "shaded" && slider({
          id: "stripes", label: "Stripes", value: looks.stripes, min: 3, max: 48, step: 1, show: String,
          onInput: (stripes) => this.stage.look({ stripes }), onDone: () => {},
        }),
        curved && slider({
          id: "percentile", label: "Colours hold", value: looks.share, min: 0.5, max: 1, show: (v) => `${(100 * v).toFixed(0)} %`,
          onInput: (share) => this.stage.look({ share }), onDone: () => {},
        }),
        this.scale,
        toggle({ id: "network", label: "Net and its curves", value: looks.network, onChange: (network) => this.stage.look({ network }) }),
        this.store.doc.entities.filter((x) => x.kind === "surface").length > 1 && toggle({
          id: "surface-joints", label: "Joints: G2 green, G1 amber, a fold red", value: looks.joints,
          onChange: (joints) => this.stage.look({ joints }),
        }),
        e.given && toggle({
          id: "surface-wipe", label: "Wipe between before and after (W)", value: this.store.state.looks.wipe !== null,
          onChange: (on) => this.store.look({ wipe: on ? 0.5 : null }),
        }),
        e.given && toggle({ id: "surface-before", label: "As it was before", value: looks.before, onChange: (before) => this.stage.look({ before }) })),
      section("Surface aesthetic value", this.table),
      this.editing(e),
    ];
  }

  /** Looked at otherwise, and other controls for it. */
  private choose(change: Partial<SurfaceLooks>): void {
    this.stage.look(change);
    this.store.set({ selection: [...this.store.state.selection] });
  }

  private renderScale(): void {
    const { look } = this.stage.looks;
    const [low, high] = this.stage.range;
    const curved = look === "mean" || look === "gaussian";
    const ramp = h("div", { class: "ramp" });
    ramp.style.background = legend();
    fill(this.scale, curved && ramp, curved && h("div", { class: "row quiet" },
      h("span", {}, measure(low, 3)), h("span", {}, look === "mean" ? "1/length" : "1/length\u00b2"), h("span", {}, measure(high, 3))));
  }

  private editing(e: SurfaceEntity): HTMLElement {
    const told = this.edits.get(e.surface);
    return section("Edit to Class A",
      choice({
        id: "keep", label: "Keeps", value: this.wishes.keep, options: kKeep,
        onChoose: (keep) => { this.wishes = { ...this.wishes, keep }; },
      }),
      slider({
        id: "surface-amount", label: "Amount", value: this.wishes.amount, min: 0, max: 1, show: (v) => v.toFixed(2),
        onInput: (amount) => { this.wishes = { ...this.wishes, amount }; },
        onDone: () => { if (e.given) void this.edit(e); },
      }),
      this.condition(e),
      h("div", { class: "row" },
        button("Edit", () => void this.edit(e), { id: "edit-surface", class: "primary" }),
        e.given && button("As it was", () => this.restore(e), { id: "restore-surface" })),
      told && this.outcome(told));
  }

  /** Where the chosen network curve may go in the plane. */
  private condition(e: SurfaceEntity): HTMLElement | null {
    const name = this.stage.looks.chosen;
    if (!name) return h("p", { class: "quiet" }, "Click a curve of the table to say where its \u03b1 and s may lie.");
    const now = this.wishes.conditions.find((c) => c.curve === name) ?? { curve: name };
    const put = (change: Partial<CurveCondition>) => {
      const others = this.wishes.conditions.filter((c) => c.curve !== name);
      this.wishes = { ...this.wishes, conditions: [...others, { ...now, ...change }] };
    };
    const given = e.given ?? e.surface;
    const points = given.type === "bezier-surface" ? networkOf(given).get(name) : undefined;
    this.plane.onPlace = (alpha, s) => {
      put({ alpha: [alpha, alpha], s: [s, s] });
      void this.edit(e);
    };
    queueMicrotask(() => points && this.plane.show(given, name, points, this.value(given)?.curves?.find((c) => c.name === name),
      now.alpha && now.s ? [now.alpha[0], now.s[0]] : null, () => paletteOf(this.store.state)));
    const range = (id: "alpha" | "s", label: string) => {
      const field = h("input", {
        type: "text", class: "number", id: `condition-${id}`, value: now[id]?.join(" \u2026 ") ?? "", placeholder: "any",
        "aria-label": `${name}: range of ${label}`,
      });
      field.addEventListener("change", () => {
        const [low, high] = field.value.split(/\s*(?:\u2026|\.\.+|;|\s)\s*/).map(Number);
        if (low !== undefined && Number.isFinite(low) && (high === undefined || Number.isFinite(high)) && field.value.trim())
          put({ [id]: [low, high ?? low] });
        else put({ [id]: undefined } as Partial<CurveCondition>);
      });
      return h("div", { class: "row" }, h("label", { for: `condition-${id}` }, `${name}: ${label} from \u2026 to`), field);
    };
    return h("div", {}, points ? this.plane.element : null, range("alpha", "\u03b1"), range("s", "s"));
  }

  private outcome(told: SurfaceEditResult): HTMLElement {
    const joints = told.joints;
    return h("div", {},
      h("dl", { class: "facts", id: "surface-outcome" },
        fact("SAV", `${measure(told.before?.sav ?? 0, 4)} \u2192 ${measure(told.after?.sav ?? 0, 4)}`),
        fact("Largest departure", measure(told.departure ?? 0, 3)),
        ...(told.target ? [fact("Target", told.target)] : []),
        ...(joints ? [fact("Joints", String(joints.before?.joints ?? 0)),
          fact("G0, G1 before", `${joints.before?.G0 ?? 0}, ${joints.before?.G1 ?? 0}`),
          fact("G0, G1 after", `${joints.after?.G0 ?? 0}, ${joints.after?.G1 ?? 0}`)] : [])),
      ...(told.missed ?? []).map((m) => h("p", { class: "quiet" }, `${m.target}: ${m.curve ? `${m.curve}, ` : ""}${m.why}`)));
  }

  private request(e: SurfaceEntity): SurfaceEditRequest {
    const { keep, amount, conditions } = this.wishes;
    const asked = conditions.filter((c) => c.alpha || c.s).map(({ curve, alpha, s }) => ({
      ...(curve ? { curve } : {}), ...(alpha ? { alpha } : {}), ...(s ? { s } : {}),
    }));
    return {
      surface: e.given ?? e.surface, keep, ...(amount === defaultsOfSurfaceEdit.amount ? {} : { amount }),
      ...(asked.length > 0 ? { conditions: asked } : {}),
    };
  }

  private async edit(e: SurfaceEntity): Promise<void> {
    if (this.store.state.work) return;
    const work = this.client.long<SurfaceEditResult>("surface.edit", this.request(e), (fraction, doing) => workTold(this.store, fraction, doing));
    this.store.set({ work: { doing: "editing the patch", fraction: 0, trace: [], cancel: () => work.cancel() } });
    const answer = await work.answer;
    this.store.set({ work: null });
    if (!answer.ok) return this.store.say(answer.error.message, answer.error.hint ?? "", true);
    const surface = answer.result.surface;
    if (!surface) return this.store.say("The patches no longer meet", "keep joints or boundary", true);
    this.edits.set(surface, answer.result);
    const now = entityOf(this.store.doc, e.id) as SurfaceEntity | undefined;
    if (!now) return;
    this.store.commit("Edit surface", withEntity(this.store.state.history.now, {
      ...now, surface, given: now.given ?? now.surface, wishes: this.wishes,
    }));
  }

  private restore(e: SurfaceEntity): void {
    const { given, wishes: _wishes, ...rest } = e;
    if (given) this.store.commit("As it was", withEntity(this.store.doc, { ...rest, surface: given }));
  }

  private value(surface: Surface): SurfaceValueShown | null {
    const known = this.values.get(surface);
    if (known !== undefined) return known;
    this.values.set(surface, null);
    void this.client.long<SurfaceSavResult>("surface.sav", { surface }, () => {}).answer.then((answer) => {
      if (answer.ok) this.values.set(surface, answer.result);
      else fill(this.table, h("p", { class: "quiet" }, answer.error.message));
      this.follow();
    });
    return null;
  }

  follow(): void {
    const e = entityOf(this.store.doc, this.entity);
    if (e?.kind !== "surface" || !this.table.isConnected) return;
    const edit = this.edits.get(e.surface) ?? null;
    const before = e.given ? this.value(e.given) : this.value(e.surface);
    if (!before) return fill(this.table, h("p", { class: "quiet" }, "\u2026"));
    this.renderTable({ before, after: e.given ? edit?.after ?? this.value(e.surface) : null, edit });
  }

  private renderTable({ before, after }: Told): void {
    const now = after ?? before;
    const several = (now.patches?.length ?? 0) > 1;
    // the net of several patches is no network: its lines have no types
    const typesOf = ({ curves = [] }: SurfaceValueShown) => new Map(several ? [] : curves.map((c) => [c.name ?? "", c.type ?? 5]));
    this.stage.types = typesOf(now);
    this.stage.typesBefore = typesOf(before);
    this.stage.paint();
    const patch = this.patch ?? nameOf(now.worst_patch);
    const curves = (now.curves ?? []).filter((c) => !several || nameOf(c.patch) === patch);
    fill(this.table,
      h("p", { class: "figure", id: "sav-value" }, after && h("span", { class: "was" }, `${measure(before.sav ?? 0, 4)} \u2192 `), measure(now.sav ?? 0, 4)),
      several && h("p", { class: "quiet" }, `the sum of ${now.patches?.length} patches; curves of one of them:`),
      several && this.patches(now.patches ?? [], patch),
      h("table", { class: "figures" },
        h("thead", {}, h("tr", {}, ...["curve", "type", "CAV", "\u03b1", "s"].map((name) => h("th", { scope: "col" }, name)))),
        h("tbody", {}, ...curves.map((c) => this.row(c)))));
  }

  /** Which of them the curves are of, the worst first. */
  private patches(all: readonly PatchValueShown[], patch: string): HTMLElement {
    const sorted = [...all].sort((a, b) => (b.sav ?? 0) - (a.sav ?? 0));
    return choice({
      id: "patch", label: "Patch", value: patch,
      options: sorted.map((p) => ({ value: nameOf(p.patch), name: `${nameOf(p.patch)}: ${measure(p.sav ?? 0, 4)}` })),
      onChoose: (name) => {
        this.patch = name;
        this.follow();
      },
    });
  }

  private row(c: NetworkCurveShown): HTMLElement {
    const chosen = this.stage.looks.chosen === c.name;
    const type = c.type ?? 5;
    const place = placeOf(c);
    const choose = button(c.name ?? "", () => {
      this.choose({ chosen: chosen ? null : c.name ?? null });
    }, { class: "link", "aria-pressed": String(chosen), id: `network-${c.name}` });
    return h("tr", { class: chosen ? "chosen" : "" }, h("th", { scope: "row" }, choose),
      h("td", { class: type <= 2 ? "good" : type === 3 ? "" : "bad" }, String(type)),
      h("td", {}, measure(c.cav ?? 0, 3)),
      ...[0, 1].map((i) => h("td", { class: c.alpha === null ? "was" : "" }, place ? measure(place[i] as number, 3) : "\u2013")));
  }
}
