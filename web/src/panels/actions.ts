/** What can be made of the chosen curves: a mirror image, a blend, one of several, two of one, a group. */
import type { Curve, CurveJoinResult, CurveSplitResult } from "../../generated/operations.ts";
import type { Client } from "../api/client.ts";
import { added, type Doc, type Entity, entityOf, type Fixed, type Fresh, type Kind, type Point, withEntity, without } from "../model/document.ts";
import type { Live } from "../model/live.ts";
import type { Hover, Store } from "../model/state.ts";
import { button, section } from "../ui/controls.ts";
import { h } from "../ui/dom.ts";

const distance = (a: Point, b: Point): number => Math.hypot(a[0] - b[0], a[1] - b[1]);

interface Chosen {
  id: number;
  curve: Curve;
  start: Point;
  end: Point;
}

function chosenOf(store: Store, live: Live): Chosen[] {
  return store.state.selection.flatMap((id) => {
    const shown = live.of(id);
    return shown ? [{ id, curve: shown.curve, start: shown.comb.points[0] as Point, end: shown.comb.points.at(-1) as Point }] : [];
  });
}

/** The curves give way to those made of them. */
function exchanged(doc: Doc, gone: readonly number[], fresh: readonly Fresh[]): { doc: Doc; ids: number[] } {
  let now = without(doc, gone);
  const ids: number[] = [];
  for (const one of fresh) {
    const made = added(now, one);
    now = made.doc;
    ids.push(made.id);
  }
  return { doc: now, ids };
}

async function join(client: Client, store: Store, chosen: readonly Chosen[]): Promise<void> {
  const first = entityOf(store.doc, chosen[0]?.id ?? null);
  const [a, b] = [chosen[0] as Chosen, chosen[1] as Chosen];
  // as near as a hand means when it says that they belong together
  const reach = Math.min(...[a.start, a.end].flatMap((p) => [distance(p, b.start), distance(p, b.end)])) * 1.01 + 1e-9;
  const answer = await client.call<CurveJoinResult>("curve.join", { curves: chosen.map((c) => c.curve), tolerance: reach });
  if (!answer.ok) return store.say(answer.error.message, answer.error.hint ?? "", true);
  const made = exchanged(store.state.history.now, chosen.map((c) => c.id), [
    { kind: "fixed", name: first?.name ?? "Joined", ...(first ? { layer: first.layer } : {}), curve: answer.result.curve },
  ]);
  store.commit("Join", made.doc, { selection: made.ids, hover: null });
}

/** Where the pointer last read a place. */
export async function split(client: Client, store: Store, live: Live, at: Hover): Promise<void> {
  const e = entityOf(store.doc, at.entity);
  const shown = live.of(at.entity);
  if (!e || !shown) return;
  const share = (shown.comb.arc_length[at.sample] ?? 0) / shown.comb.length;
  const answer = await client.call<CurveSplitResult>("curve.split", { curve: shown.curve, at: share });
  if (!answer.ok) return store.say(answer.error.message, answer.error.hint ?? "", true);
  const made = exchanged(store.state.history.now, [e.id], (answer.result.parts ?? []).map((part, i) =>
    ({ kind: "fixed", name: `${e.name}.${i + 1}`, layer: e.layer, curve: part.curve as Curve })));
  store.commit("Split", made.doc, { selection: made.ids.slice(0, 1), hover: null });
}

function group(store: Store, chosen: readonly Chosen[]): void {
  const { doc } = store;
  const name = `Group ${doc.layers.length}`;
  const ids = new Set(chosen.map((c) => c.id));
  store.commit("Group", {
    ...doc, layers: [...doc.layers, { name, visible: true, locked: false }],
    entities: doc.entities.map((e) => (ids.has(e.id) ? { ...e, layer: name } : e)),
  });
}

/** Curves that stand where what they were made of says. */
const kHeld: readonly Kind[] = ["faired", "sliding", "blend", "mirror"];

function letGo(store: Store, { id, name, layer, visible, locked, color }: Entity, curve: Curve): void {
  const own: Fixed = { kind: "fixed", id, name, layer, visible, locked, color, curve };
  store.commit("Let go", withEntity(store.state.history.now, own));
}

export function actionsPanel(client: Client, store: Store, live: Live): HTMLElement | null {
  const chosen = chosenOf(store, live);
  const make = (label: string, fresh: Fresh) => {
    const made = added(store.state.history.now, fresh);
    store.commit(label, made.doc, { selection: [made.id] });
  };
  const [a, b] = chosen;
  if (!a) return null;
  const e = entityOf(store.doc, a.id);
  const nameOf = (id: number) => entityOf(store.doc, id)?.name ?? "";
  if (!b)
    return section("Make", h("div", { class: "row wrap" }, button("Mirror image", () =>
      make("Mirror", { kind: "mirror", name: `${nameOf(a.id)}, mirrored`, of: a.id, axis: [a.end, [a.end[0], a.end[1] + 1]] }),
    { id: "mirror" }), e && kHeld.includes(e.kind) && button("Let it go", () => letGo(store, e, a.curve),
      { id: "let-go", title: "A curve of its own from now on, that can be moved: it no longer follows what it was made of" }),
    h("span", { class: "quiet" }, "X splits at the pointer")));
  // it leaves the end of one for the start of the other, whichever is nearer
  const [from, to] = distance(a.end, b.start) <= distance(b.end, a.start) ? [a, b] : [b, a];
  return section("Make", h("div", { class: "row wrap" },
    chosen.length === 2 && button("Blend G2", () =>
      make("Blend", {
        kind: "blend", name: `Blend ${from.id}\u2013${to.id}`, of: [from.id, to.id], ends: ["end", "start"], order: "G2", alpha: -1,
      }), { id: "blend" }),
    button("Join ends", () => void join(client, store, chosen), { id: "join" }),
    button("Group", () => group(store, chosen), { id: "group" })));
}
