/** A picture below the curves, and its lines as curves. */
import type { Curve, SketchTraceResult } from "../../generated/operations.ts";
import type { Client } from "../api/client.ts";
import { added } from "../model/document.ts";
import type { Store } from "../model/state.ts";
import { button, section, slider } from "../ui/controls.ts";
import { h } from "../ui/dom.ts";

/** One pixel is one unit, the lower left corner the origin, as sketch.trace has it. */
export async function layUnder(store: Store, picture: Blob, file: string): Promise<void> {
  const { width, height } = await createImageBitmap(picture);
  const old = store.state.underlay;
  if (old) URL.revokeObjectURL(old.url);
  store.set({
    underlay: {
      url: URL.createObjectURL(picture), name: file.replace(/^.*\//, ""), file, width, height, at: [0, 0], scale: 1, opacity: 0.5,
    },
  });
}

async function trace(client: Client, store: Store, file: string): Promise<void> {
  const work = client.long<SketchTraceResult>("sketch.trace", { file }, (fraction, doing) => {
    if (store.state.work) store.set({ work: { ...store.state.work, fraction, doing } });
  });
  store.set({ work: { doing: "looking at the picture", fraction: 0, cancel: work.cancel } });
  const answer = await work.answer;
  store.set({ work: null });
  if (!answer.ok) return store.say(answer.error.message, answer.error.hint ?? "", true);
  let { doc } = { doc: store.state.history.now };
  const ids: number[] = [];
  for (const [i, stroke] of (answer.result.strokes ?? []).entries()) {
    if (!stroke.curve) continue;
    const made = added(doc, { kind: "fixed", name: `Stroke ${i + 1}`, layer: "Sketch", curve: stroke.curve as Curve });
    doc = made.doc;
    ids.push(made.id);
  }
  store.commit("Trace", doc, { selection: ids.slice(0, 1) });
  store.say(`${ids.length} line${ids.length === 1 ? "" : "s"} found`);
}

export function underlayPanel(client: Client, store: Store): HTMLElement | null {
  const { underlay } = store.state;
  if (!underlay) return null;
  const put = (opacity: number) => store.state.underlay && store.set({ underlay: { ...store.state.underlay, opacity } });
  return section("Picture below",
    h("p", { class: "quiet" }, `${underlay.name}, ${underlay.width} \u00d7 ${underlay.height}`),
    slider({
      id: "opacity", label: "Opacity", value: underlay.opacity, min: 0, max: 1, show: (v) => v.toFixed(2),
      onInput: put, onDone: () => {},
    }),
    h("div", { class: "row" },
      button("Trace its lines", () => void trace(client, store, underlay.file), { id: "trace", class: "primary" }),
      button("Remove", () => store.set({ underlay: null }))));
}
