/** Where a curve of a file has been put, in numbers that can be typed; of several things, how far they go together. */
import { movable, placesOf, middleOf, turnBox } from "../gestures/box.ts";
import { carriedDoc } from "../gestures/carry.ts";
import type { Table } from "../gestures/gesture.ts";
import { controlsOf } from "../model/controls.ts";
import { entityOf, type Fixed, withEntity } from "../model/document.ts";
import { isStill, type Placement, still } from "../model/placement.ts";
import { button, section, toggle } from "../ui/controls.ts";
import { h } from "../ui/dom.ts";

const kDegree = Math.PI / 180;
const kDigits = 5; // shown of a number

interface Field {
  id: string;
  name: string;
  unit: string;
  read: (p: Placement) => number;
  put: (p: Placement, v: number) => Placement;
  allowed?: (v: number) => boolean;
}

const fields = (unit: string): readonly Field[] => [
  { id: "place-x", name: "\u0394x", unit, read: (p) => p.shift[0], put: (p, v) => ({ ...p, shift: [v, p.shift[1]] }) },
  { id: "place-y", name: "\u0394y", unit, read: (p) => p.shift[1], put: (p, v) => ({ ...p, shift: [p.shift[0], v] }) },
  { id: "place-turn", name: "Turn", unit: "\u00b0", read: (p) => p.turn / kDegree, put: (p, v) => ({ ...p, turn: v * kDegree }) },
  { id: "place-scale", name: "Scale", unit: "\u00d7", read: (p) => p.scale, put: (p, v) => ({ ...p, scale: v }), allowed: (v) => v > 0 },
];

const shown = (v: number): string => String(Number(v.toPrecision(kDigits))).replace("-", "\u2212");

function input(field: Field, now: Placement, change: (to: Placement) => void): HTMLElement {
  const was = shown(field.read(now));
  const number = h("input", { type: "text", class: "number", inputmode: "decimal", id: field.id, value: was, "aria-label": `${field.name}, ${field.unit}` });
  number.addEventListener("change", () => {
    const typed = Number(number.value.replace("\u2212", "-").replace(",", "."));
    const good = number.value.trim() !== "" && Number.isFinite(typed) && (field.allowed?.(typed) ?? true);
    if (good) change(field.put(now, typed));
    else number.value = was;
  });
  return h("label", { class: "place", for: field.id }, h("span", {}, field.name), number, h("span", { class: "quiet" }, field.unit));
}

export function placePanel(table: Pick<Table, "store" | "live" | "view">): HTMLElement | null {
  const { store } = table;
  const ids = movable(store);
  const e = ids.length === 1 ? entityOf(store.doc, ids[0] as number) : undefined;
  if (ids.length === 0 || (ids.length === 1 && e?.kind !== "fixed")) return null;
  const { history } = store.state;
  const unit = store.doc.unit || "units";
  const row = (now: Placement, change: (to: Placement) => void) =>
    h("div", { class: "places" }, ...fields(unit).map((f) => input(f, now, change)));
  if (!e) {
    const now = still(turnBox(table)?.pivot ?? middleOf(placesOf(table, ids)));
    return section("Move together", row(now, (to) => store.commit("Place", carriedDoc(table, history.now, ids, to))));
  }
  const own = e as Fixed;
  const now = own.placed ?? still(middleOf(placesOf(table, ids)));
  const { placed: _placed, ...asOpened } = own;
  return section("Place",
    row(now, (placed) => store.commit("Place", withEntity(history.now, { ...own, placed }))),
    controlsOf(own.curve).length > 0 && toggle({
      id: "control-points", label: "Control points as handles", value: own.held === true,
      onChange: (held) => store.commit(held ? "Show control points" : "Hide control points", withEntity(history.now, { ...own, held })),
    }),
    own.placed && !isStill(own.placed)
      && h("div", { class: "row" }, h("span", { class: "quiet" }, "from where it was"),
        button("Put back", () => store.commit("Put back", withEntity(history.now, asOpened)), { id: "put-back" })));
}
