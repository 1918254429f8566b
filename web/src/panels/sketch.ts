/** A picture below the curves: how it lies, what is seen in it stage by stage, and its lines as curves. */
import {
  type Curve, defaultsOfSketchTrace, type SketchTraceRequest, type SketchTraceResult, type StageShown,
} from "../../generated/operations.ts";
import type { Client } from "../api/client.ts";
import { contentOf, type KeptPicture } from "../model/autosave.ts";
import { added, type Doc } from "../model/document.ts";
import { baseOf } from "../model/open.ts";
import { type Store, type Underlay, workTold } from "../model/state.ts";
import { button, choice, section, slider, toggle } from "../ui/controls.ts";
import { h } from "../ui/dom.ts";
import { Regions } from "./regions.ts";

const kLayer = "Sketch";

type Picture = Pick<Underlay, "url" | "width" | "height">;

/** What tracing sees of a picture: of one that the browser cannot show (TIFF), of a photo that it mapped. */
async function seenOf(client: Client, store: Store, file: string): Promise<Picture | null> {
  const answer = await client.long<SketchTraceResult>("sketch.trace", { file, stages: true }, () => {}).answer;
  const [first] = answer.ok ? answer.result.stages ?? [] : [];
  if (first) return { url: await pictureOf(first), width: first.width ?? 1, height: first.height ?? 1 };
  const why = answer.ok ? undefined : answer.error;
  store.say(why?.message ?? "this picture cannot be shown here", why?.hint ?? "save it as PNG or JPEG", true);
  return null;
}

/** One pixel is one unit, the lower left corner the origin, as sketch.trace has it, unless it lay otherwise before. */
export async function layUnder(client: Client, store: Store, picture: Blob, file: string, before?: KeptPicture): Promise<void> {
  const mapped = before?.mapped ?? false;
  const shown: Picture | null = mapped ? await seenOf(client, store, file) : await createImageBitmap(picture).then(
    ({ width, height }) => ({ url: URL.createObjectURL(picture), width, height }),
    () => seenOf(client, store, file));
  if (!shown) return;
  const old = store.state.underlay;
  if (old) URL.revokeObjectURL(old.url);
  store.set({
    underlay: {
      ...shown, name: before?.name ?? baseOf(file), file, picture, mapped,
      at: before?.at ?? [0, 0], scale: before?.scale ?? 1, opacity: before?.opacity ?? 0.5, stages: [], stage: "",
    },
  });
}

/** The picture of work that was kept, or of a saved document, as it lay. */
export async function layAgain(client: Client, store: Store, kept: KeptPicture): Promise<void> {
  const saved = contentOf(kept);
  if (saved) {
    const there = await client.upload(kept.name, saved);
    if (there.ok) return layUnder(client, store, saved, there.result, kept);
    return store.say(there.error.message, there.error.hint ?? "", true);
  }
  const picture = await client.given(kept.file);
  if (picture) return layUnder(client, store, picture, kept.file, kept);
  store.say(`the picture below, ${kept.name}, is not there any more`, "drop it on the page again", true);
}

async function pictureOf(stage: StageShown): Promise<string> {
  const { width = 1, height = 1 } = stage;
  const gray = Uint8Array.from(atob(stage.gray ?? ""), (c) => c.charCodeAt(0));
  const pixels = new ImageData(width, height);
  gray.forEach((v, i) => pixels.data.set([v, v, v, 255], 4 * i));
  const canvas = new OffscreenCanvas(width, height);
  canvas.getContext("2d")?.putImageData(pixels, 0, 0);
  return URL.createObjectURL(await canvas.convertToBlob());
}

/** The lines found take the place of those found before. */
function withStrokes(doc: Doc, answer: SketchTraceResult, under: Underlay): { doc: Doc; ids: number[] } {
  let now: Doc = { ...doc, entities: doc.entities.filter((e) => !(e.kind === "fixed" && e.layer === kLayer)) };
  const ids: number[] = [];
  for (const [i, stroke] of (answer.strokes ?? []).entries()) {
    const made = added(now, {
      kind: "fixed", name: `Stroke ${i + 1}`, layer: kLayer, curve: stroke.curve as Curve,
      ...(stroke.members && { members: stroke.members }),
    });
    now = made.doc;
    ids.push(made.id);
  }
  const unit = under.scale !== 1 ? "mm" : now.entities.length === ids.length ? "px" : now.unit;
  return { doc: { ...now, unit }, ids };
}

export class SketchPanel {
  private wishes: SketchTraceRequest = {};
  private readonly regions = new Regions();

  constructor(private readonly client: Client, private readonly store: Store) {}

  private put(change: Partial<Underlay>): void {
    const { underlay } = this.store.state;
    if (underlay) this.store.set({ underlay: { ...underlay, ...change } });
  }

  async trace(): Promise<void> {
    const { underlay } = this.store.state;
    if (!underlay || this.store.state.work) return;
    const request: SketchTraceRequest = {
      file: underlay.file, stages: true, ...this.wishes,
      ...(underlay.scale === 1 ? {} : { scale: underlay.scale }),
      ...(this.regions.any ? { thresholds: [...this.regions.values] } : {}),
    };
    const work = this.client.long<SketchTraceResult>("sketch.trace", request, (fraction, doing) => workTold(this.store, fraction, doing));
    this.store.set({ work: { doing: "looking at the picture", fraction: 0, trace: [], cancel: work.cancel } });
    const answer = await work.answer;
    const stages = answer.ok ? await Promise.all((answer.result.stages ?? []).map(async (stage) =>
      ({ name: stage.name ?? "", url: await pictureOf(stage) }))) : [];
    this.store.set({ work: null });
    if (!answer.ok) return this.store.say(answer.error.message, answer.error.hint ?? "", true);
    const { doc, ids } = withStrokes(this.store.opened, answer.result, underlay);
    for (const old of underlay.stages) URL.revokeObjectURL(old.url);
    this.put({ stages, stage: stages.some((s) => s.name === underlay.stage) ? underlay.stage : "" });
    const [first] = answer.result.stages ?? [];
    if (answer.result.sheet && first) // a photo was mapped back to its sheet, whose lines these are
      this.put({ mapped: true, url: await pictureOf(first), width: first.width ?? underlay.width, height: first.height ?? underlay.height });
    this.store.commit("Trace", doc, { selection: ids.slice(0, 1) });
    const explained = answer.result.explained === undefined ? "" : `, ${(100 * answer.result.explained).toFixed(0)} % of the ink lies beside one`;
    this.store.say(`${ids.length} line${ids.length === 1 ? "" : "s"} found${explained}`, (answer.result.report ?? []).join("; "));
  }

  element(): HTMLElement | null {
    const { underlay } = this.store.state;
    if (!underlay) return null;
    const stages = [{ value: "", name: "the picture" }, ...underlay.stages.map((s) => ({ value: s.name, name: s.name }))];
    return section("Picture below",
      h("p", { class: "quiet" }, `${underlay.name}, ${underlay.width} \u00d7 ${underlay.height} pixels${underlay.scale === 1 ? "" : `, ${underlay.scale.toPrecision(4)} mm each`}`),
      slider({
        id: "opacity", label: "Opacity", value: underlay.opacity, min: 0, max: 1, show: (v) => v.toFixed(2),
        onInput: (opacity) => this.put({ opacity }), onDone: () => {},
      }),
      underlay.stages.length > 0 && choice({
        id: "stage", label: "Shows", value: underlay.stage, options: stages, onChoose: (stage) => this.put({ stage }),
      }),
      h("div", { class: "row wrap" }, button("Scale by two points", () => this.store.set({ tool: "measure" }), { id: "scale-picture" }),
        button("Remove", () => this.store.set({ underlay: null }))),
      this.scaling(underlay),
      ...(this.client.can("sketch.trace") ? this.tracing(underlay) : []));
  }

  private tracing(underlay: Underlay): (HTMLElement | false)[] {
    return [
      h("h3", {}, "Lines"),
      ...this.wishing(underlay),
      this.grouping(),
      h("div", { class: "row" }, button("Trace its lines", () => void this.trace(), { id: "trace", class: "primary" })),
    ];
  }

  /** Which drawn strokes the chosen lines stand for, and what to make of them instead. */
  private grouping(): HTMLElement | false {
    const { doc, state } = this.store;
    const chosen = doc.entities.flatMap((e) => (e.kind === "fixed" && e.members && state.selection.includes(e.id) ? [e.members] : []));
    const members = chosen.flat();
    if (chosen.length === 0) return false;
    const again = (wish: SketchTraceRequest) => {
      this.wishes = { ...this.wishes, ...wish };
      void this.trace();
    };
    const { join = [], split = [], keep = [] } = this.wishes;
    const decided = join.length + split.length + keep.length;
    return h("div", { id: "members" },
      h("p", { class: "quiet" }, `${chosen.length > 1 ? "The chosen lines stand" : "The chosen line stands"} for stroke${members.length > 1 ? "s" : ""} ${members.join(", ")}`),
      h("div", { class: "row wrap" },
        chosen.length > 1 && button("Make them one line", () => again({ join: [...join, members] }), { id: "join-strokes" }),
        members.length > 1 && button("Take apart", () => again({ split: [...split, members] }), { id: "split-strokes" }),
        button("Leave as drawn", () => again({ keep: [...keep, ...members] }), { id: "keep-strokes" }),
        decided > 0 && button("Decide anew", () => again({ join: [], split: [], keep: [] }), { id: "decide-anew" })));
  }

  /** Two points have been clicked: how far are they apart? */
  private scaling(underlay: Underlay): HTMLElement | null {
    const { measured } = this.store.state;
    if (!measured) return null;
    const [a, b] = measured;
    const now = Math.hypot(b[0] - a[0], b[1] - a[1]);
    const field = h("input", { type: "text", class: "number", id: "measured", inputmode: "decimal", value: now.toPrecision(5), "aria-label": "Distance of the two points, mm" });
    field.addEventListener("change", () => {
      const wanted = Number(field.value.replace(",", "."));
      if (!(wanted > 0 && now > 0)) return;
      const by = wanted / now;
      this.store.set({ measured: null });
      this.put({ scale: underlay.scale * by, at: [a[0] + (underlay.at[0] - a[0]) * by, a[1] + (underlay.at[1] - a[1]) * by] });
    });
    return h("div", { class: "row" }, h("label", { for: "measured" }, "They are apart, mm"), field);
  }

  private wishing(underlay: Underlay): (HTMLElement | false)[] {
    const wish = <K extends keyof SketchTraceRequest>(name: K, value: SketchTraceRequest[K]) => {
      this.wishes = { ...this.wishes, [name]: value };
    };
    const { wishes } = this;
    return [
      choice({
        id: "trace-curvature", label: "Curvature", value: wishes.curvature ?? defaultsOfSketchTrace.curvature,
        options: [{ value: "none", name: "as drawn" }, { value: "smooth", name: "smoothed" }, { value: "rhythm", name: "to its rhythm" }] as const,
        onChoose: (v) => wish("curvature", v),
      }),
      choice({
        id: "trace-edge", label: "Follows", value: wishes.edge ?? defaultsOfSketchTrace.edge,
        options: [{ value: "center", name: "middle of the lines" }, { value: "outer", name: "outer border" }] as const,
        onChoose: (v) => wish("edge", v),
      }),
      choice({
        id: "trace-polarity", label: "Drawn", value: wishes.polarity ?? defaultsOfSketchTrace.polarity,
        options: [{ value: "auto", name: "as found" }, { value: "dark", name: "dark on light" }, { value: "light", name: "light on dark" }] as const,
        onChoose: (v) => wish("polarity", v),
      }),
      toggle({
        id: "trace-consolidate", label: "Lines drawn several times become one",
        value: wishes.consolidate ?? defaultsOfSketchTrace.consolidate, onChange: (v) => wish("consolidate", v),
      }),
      this.regions.element(underlay),
    ];
  }
}
