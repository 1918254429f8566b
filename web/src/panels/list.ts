/** The document: what is there, on which layer, shown, held. */
import { type Doc, type Entity, type Layer, without } from "../model/document.ts";
import type { Store } from "../model/state.ts";
import { choice, iconButton, section } from "../ui/controls.ts";
import { h, svg } from "../ui/dom.ts";
import { icons } from "../ui/icons.ts";

const iconOf: Record<Entity["kind"], string> = {
  segment: icons.segment, compound: icons.compound, "s-shape": icons["s-shape"], spline: icons.spline,
  quasi: icons.quasi, blend: icons.blend, mirror: icons.mirror, fixed: icons.segment,
  scan: "M4 15h.01M6 11h.01M9 8h.01M13 6h.01M17 5h.01", faired: icons.comb, sliding: icons.segment, surface: icons.grid,
};

function change(store: Store, label: string, doc: Doc): void {
  store.commit(label, doc);
}

/** What tells names of one file apart stands at their end: a long one is shortened before it. */
function shortened(name: string): HTMLElement {
  const kept = 10;
  return h("span", { class: "shortened" }, h("span", {}, name.slice(0, -kept)), h("span", {}, name.slice(-kept)));
}

function row(store: Store, e: Entity): HTMLElement {
  const { doc, state } = store;
  const put = (label: string, part: Partial<Entity>) =>
    change(store, label, { ...doc, entities: doc.entities.map((x) => (x.id === e.id ? ({ ...x, ...part } as Entity) : x)) });
  const name = h("button", {
    type: "button", class: "name", id: `entity-${e.id}`, "aria-pressed": String(state.selection.includes(e.id)),
    title: `${e.name}\nClick to choose, Shift adds, double click or F2 renames`,
    click: (event: MouseEvent) => {
      const others = state.selection.filter((id) => id !== e.id);
      const added = others.length < state.selection.length ? others : [...others, e.id];
      store.set({ selection: event.shiftKey ? added : [e.id] });
    },
    dblclick: () => rename(name, e.name, (to) => put("Rename", { name: to })),
    keydown: (event: KeyboardEvent) => {
      if (event.key === "F2") rename(name, e.name, (to) => put("Rename", { name: to }));
    },
  }, svg(iconOf[e.kind], 16), shortened(e.name));
  return h("li", { class: state.selection.includes(e.id) ? "chosen" : "" },
    name,
    iconButton({
      icon: e.visible ? icons.eye : icons.hidden, label: e.visible ? `Hide ${e.name}` : `Show ${e.name}`,
      onClick: () => put(e.visible ? "Hide" : "Show", { visible: !e.visible }),
    }),
    iconButton({
      icon: e.locked ? icons.lock : icons.free, label: e.locked ? `Free ${e.name}` : `Lock ${e.name}`,
      onClick: () => put(e.locked ? "Free" : "Lock", { locked: !e.locked }),
    }),
    iconButton({
      icon: icons.remove, label: `Remove ${e.name}`,
      onClick: () => store.commit("Remove", without(doc, [e.id]), {
        selection: state.selection.filter((id) => id !== e.id), hover: null,
      }),
    }));
}

function rename(at: HTMLElement, old: string, done: (name: string) => void): void {
  const input = h("input", { type: "text", value: old, "aria-label": "Name" });
  const finish = () => {
    if (input.value.trim() && input.value !== old) done(input.value.trim());
    else input.replaceWith(at);
  };
  input.addEventListener("blur", finish, { once: true });
  input.addEventListener("keydown", (e) => {
    if (e.key === "Enter") input.blur();
    if (e.key === "Escape") {
      input.value = old;
      input.blur();
    }
    e.stopPropagation();
  });
  at.replaceWith(input);
  input.select();
}

function layerRow(store: Store, layer: Layer): HTMLElement {
  const put = (label: string, part: Partial<Layer>) =>
    change(store, label, {
      ...store.doc, layers: store.doc.layers.map((l) => (l.name === layer.name ? { ...l, ...part } : l)),
    });
  const called = (to: string) => {
    if (store.doc.layers.some((l) => l.name === to)) return store.say(`There is a layer ${to}`, "give another name", true);
    change(store, "Rename layer", {
      ...store.doc, layers: store.doc.layers.map((l) => (l.name === layer.name ? { ...l, name: to } : l)),
      entities: store.doc.entities.map((e) => (e.layer === layer.name ? { ...e, layer: to } : e)),
    });
  };
  const name = h("button", {
    type: "button", class: "name", title: "Double click, or Enter, renames", dblclick: () => rename(name, layer.name, called),
    keydown: (e: KeyboardEvent) => {
      if (e.key !== "Enter") return;
      e.preventDefault();
      rename(name, layer.name, called);
    },
  }, layer.name);
  return h("div", { class: "layer" },
    h("h3", {}, name),
    iconButton({
      icon: layer.visible ? icons.eye : icons.hidden,
      label: `${layer.visible ? "Hide" : "Show"} layer ${layer.name}`,
      onClick: () => put("Layer", { visible: !layer.visible }),
    }),
    iconButton({
      icon: layer.locked ? icons.lock : icons.free,
      label: `${layer.locked ? "Free" : "Lock"} layer ${layer.name}`,
      onClick: () => put("Layer", { locked: !layer.locked }),
    }));
}

const kNew = "\u0000"; // no layer's name

/** Where the chosen things stand. */
function layerOfChosen(store: Store): HTMLElement | null {
  const { doc, state } = store;
  const ids = new Set(state.selection);
  const first = doc.entities.find((e) => ids.has(e.id));
  if (!first) return null;
  const to = (layer: string, more: readonly Layer[] = []) => change(store, "Layer", {
    ...doc, layers: [...doc.layers, ...more], entities: doc.entities.map((e) => (ids.has(e.id) ? { ...e, layer } : e)),
  });
  return choice({
    id: "entity-layer", label: "Layer", value: first.layer,
    options: [...doc.layers.map((l) => ({ value: l.name, name: l.name })), { value: kNew, name: "a new one" }],
    onChoose: (layer) => {
      if (layer !== kNew) return to(layer);
      let number = doc.layers.length + 1;
      while (doc.layers.some((l) => l.name === `Layer ${number}`)) ++number;
      to(`Layer ${number}`, [{ name: `Layer ${number}`, visible: true, locked: false }]);
    },
  });
}

const kList = "things"; // scrolls by itself, so that what belongs to the chosen thing stands in sight

/** Scrolls the list, and nothing around it, as far as the thing needs to be seen. */
export function reveal(id: number): void {
  const list = document.getElementById(kList)?.getBoundingClientRect();
  const row = document.getElementById(`entity-${id}`)?.getBoundingClientRect();
  if (!list || !row) return;
  const by = row.top < list.top ? row.top - list.top : Math.max(0, row.bottom - list.bottom);
  document.getElementById(kList)?.scrollBy(0, by);
}

export function listPanel(store: Store): HTMLElement {
  const { doc } = store;
  const used = doc.layers.filter((l) => doc.entities.some((e) => e.layer === l.name));
  return section("Document",
    h("div", { id: kList }, ...used.flatMap((layer) => [
      used.length > 1 || !layer.visible || layer.locked ? layerRow(store, layer) : null,
      h("ul", { class: "things" }, ...doc.entities.filter((e) => e.layer === layer.name).map((e) => row(store, e))),
    ])),
    layerOfChosen(store),
    doc.entities.length === 0 && h("p", { class: "quiet" }, "Nothing drawn yet. Choose a tool on the left, or drop a file here."));
}
