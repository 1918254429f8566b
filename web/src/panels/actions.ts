/** What can be made of the chosen curves: a mirror image of one, a blend between two. */
import { added, entityOf, type Fresh, type Point } from "../model/document.ts";
import type { Live } from "../model/live.ts";
import type { Store } from "../model/state.ts";
import { button, section } from "../ui/controls.ts";
import { h } from "../ui/dom.ts";

const distance = (a: Point, b: Point): number => Math.hypot(a[0] - b[0], a[1] - b[1]);

export function actionsPanel(store: Store, live: Live): HTMLElement | null {
  const chosen = store.state.selection.flatMap((id) => {
    const comb = live.of(id)?.comb;
    return comb ? [{ id, start: comb.points[0] as Point, end: comb.points.at(-1) as Point }] : [];
  });
  const make = (label: string, fresh: Fresh) => {
    const made = added(store.state.history.now, fresh);
    store.commit(label, made.doc, { selection: [made.id] });
  };
  const [a, b] = chosen;
  if (!a || chosen.length > 2) return null;
  const nameOf = (id: number) => entityOf(store.doc, id)?.name ?? "";
  if (!b)
    return section("Make", h("div", { class: "row" }, button("Mirror image", () =>
      make("Mirror", { kind: "mirror", name: `${nameOf(a.id)}, mirrored`, of: a.id, axis: [a.end, [a.end[0], a.end[1] + 1]] }),
    { id: "mirror" })));
  // it leaves the end of one for the start of the other, whichever is nearer
  const [from, to] = distance(a.end, b.start) <= distance(b.end, a.start) ? [a, b] : [b, a];
  return section("Make", h("div", { class: "row" }, button("Blend G2 between both", () =>
    make("Blend", {
      kind: "blend", name: `Blend ${from.id}\u2013${to.id}`, of: [from.id, to.id], ends: ["end", "start"], order: "G2", alpha: -1,
    }), { id: "blend" })));
}
