/** Every command by keyboard. */
import type { Table } from "./gestures/gesture.ts";
import { movable } from "./gestures/box.ts";
import { carriedDoc } from "./gestures/carry.ts";
import { entityOf, handlesOf, isHeld, type Point, withEntity, withHandle, withoutPoint } from "./model/document.ts";
import { shiftedBy } from "./model/placement.ts";
import { tools } from "./panels/toolbar.ts";
import { h } from "./ui/dom.ts";
import type { Studio } from "./studio.ts";

const kPan = 40; // pixels
const kStep = 10;
const kFarStep = 50;
const kFineStep = 1;
const kWide = 10; // times as far, with Shift
const kNudge = "Nudge";
const kWipeStep = 0.01;
const arrows: Record<string, Point> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

interface Command {
  keys: readonly string[];
  says: string;
  act: () => void;
}

/** Keys pressed together, and those that mean more than one thing. */
const kChords = [
  ["Ctrl Z", "undo"], ["Ctrl Shift Z", "redo"], ["Ctrl O", "open a file"], ["Ctrl S", "save the document"], ["Ctrl A", "choose all"],
  ["Arrows", "pan; with a tool move the pointer; with a handle move that (Shift: far)"], ["Space", "with a tool: click"],
  ["Alt Arrows", "move what is chosen by a pixel (Shift: ten)"], ["Space drag", "pan"], ["Enter", "end a spline"], ["Escape", "leave off"],
] as const;

export class Keyboard {
  /** the handle that arrows move; null: the whole thing */
  private handle: number | null = null;
  /** single keys, as the help lists them */
  private readonly commands: readonly Command[];

  constructor(private readonly studio: Studio, private readonly table: Table) {
    this.commands = this.singles();
    addEventListener("keydown", (e) => {
      if (this.typing(e)) return;
      if (this.command(e) || (!e.ctrlKey && !e.metaKey && this.single(e))) e.preventDefault();
    });
  }

  private typing(e: KeyboardEvent): boolean {
    const at = e.target as HTMLElement;
    if (at.tagName === "INPUT" && (at as HTMLInputElement).type !== "text") return arrows[e.key] !== undefined;
    return ["INPUT", "SELECT", "TEXTAREA"].includes(at.tagName) && !e.ctrlKey && !e.metaKey;
  }

  private singles(): Command[] {
    const { studio } = this;
    const { store } = studio;
    const looks = () => store.state.looks;
    const flip = (name: "comb" | "evolute" | "circle" | "deviation" | "combOfAll" | "box" | "grid" | "snap") => () =>
      store.look({ [name]: !looks()[name] });
    return [
      { keys: ["f"], says: "fit all", act: () => studio.fit() },
      { keys: ["k"], says: "comb", act: flip("comb") },
      { keys: ["j"], says: "combs of all curves", act: flip("combOfAll") },
      { keys: ["["], says: "shorter comb", act: () => store.scaleComb(looks().combScale / 1.2) },
      { keys: ["]"], says: "longer comb", act: () => store.scaleComb(looks().combScale * 1.2) },
      { keys: ["e"], says: "evolute", act: flip("evolute") },
      { keys: ["o"], says: "osculating circle", act: flip("circle") },
      { keys: ["d"], says: "deviation of measured points", act: flip("deviation") },
      { keys: ["w"], says: "wipe between before and after", act: () => store.look({ wipe: looks().wipe === null ? 0.5 : null }) },
      { keys: [","], says: "wipe to the left", act: () => this.wipe(-kWipeStep) },
      { keys: ["."], says: "wipe to the right", act: () => this.wipe(kWipeStep) },
      { keys: ["b"], says: "the box that turns and scales what is chosen", act: flip("box") },
      { keys: ["g"], says: "grid", act: flip("grid") },
      { keys: ["n"], says: "snapping", act: flip("snap") },
      { keys: ["x"], says: "split where the pointer reads", act: () => studio.splitHere() },
      { keys: ["h"], says: "next handle, for the arrows to move", act: () => this.nextHandle() },
      { keys: ["delete", "backspace"], says: "remove; of a spline the point under the pointer, or that H has chosen", act: () => this.remove() },
      { keys: ["+", "="], says: "zoom in", act: () => this.zoom(1.25) },
      { keys: ["-"], says: "zoom out", act: () => this.zoom(0.8) },
      { keys: ["?"], says: "this list", act: () => this.help() },
    ];
  }

  help(): void {
    const row = (keys: readonly string[], says: string) =>
      h("tr", {}, h("th", { scope: "row" }, ...keys.map((key) => h("kbd", {}, key))), h("td", {}, says));
    const written = (key: string) => (key.length > 1 ? `${key[0]?.toUpperCase()}${key.slice(1)}` : key.toUpperCase());
    const dialog = h("dialog", { class: "help", "aria-label": "Keys" },
      h("h2", {}, "Keys"),
      h("table", {}, h("tbody", {},
        ...tools.map((t) => row([t.key], t.label)),
        ...this.commands.map((c) => row(c.keys.map(written), c.says)),
        ...kChords.map(([keys, says]) => row([keys], says)))),
      h("form", { method: "dialog" }, h("button", { class: "primary", type: "submit" }, "Close")));
    dialog.addEventListener("close", () => dialog.remove());
    document.body.append(dialog);
    dialog.showModal();
  }

  private command(e: KeyboardEvent): boolean {
    if (!e.ctrlKey && !e.metaKey) return false;
    const { store } = this.studio;
    switch (e.key.toLowerCase()) {
      case "z":
        if (e.shiftKey) store.redo();
        else store.undo();
        return true;
      case "y":
        store.redo();
        return true;
      case "o":
        this.studio.chooseFile();
        return true;
      case "s":
        void this.studio.saveDocument();
        return true;
      case "a":
        store.set({ selection: store.doc.entities.map((x) => x.id) });
        return true;
      default:
        return false;
    }
  }

  private single(e: KeyboardEvent): boolean {
    const { store, canvas } = this.studio;
    if (document.querySelector("dialog[open]")) return false;
    if (["Escape", "Enter", "Backspace"].includes(e.key) && canvas.key(e.key)) return true;
    const onBoard = document.activeElement === canvas.element || document.activeElement === document.body;
    if (onBoard && store.state.tool !== "select" && this.pointing(e)) return true;
    if (onBoard && arrows[e.key]) {
      const by = arrows[e.key] as Point;
      return e.altKey ? this.nudge(by, e.shiftKey, e.repeat) : this.arrow(by, e.shiftKey);
    }
    const tool = tools.find((t) => t.key.toLowerCase() === e.key.toLowerCase());
    if (tool) {
      store.set({ tool: tool.name });
      return true;
    }
    const command = this.commands.find((c) => c.keys.includes(e.key.toLowerCase()));
    command?.act();
    return command !== undefined;
  }

  /** With a tool, arrows move the pointer and the space bar clicks: everything drawn can be drawn by keys. */
  private pointing(e: KeyboardEvent): boolean {
    const { canvas } = this.studio;
    const by = arrows[e.key];
    const step = e.shiftKey ? kFarStep : e.altKey ? kFineStep : kStep;
    if (by) canvas.step([by[0] * step, -by[1] * step]);
    else if (e.key === " ") canvas.press();
    return by !== undefined || e.key === " ";
  }

  private remove(): void {
    const { store, canvas } = this.studio;
    const e = entityOf(store.doc, store.state.selection.at(-1) ?? null);
    const hot = canvas.hot;
    const handle = hot && hot.entity === e?.id ? hot.handle : this.handle;
    if (e?.kind !== "spline" || handle === null) return this.studio.removeSelected();
    const less = withoutPoint(e, handle);
    if (less === e) return store.say("No point less", "a curve needs two, a closed one three", true);
    this.handle = null;
    store.commit("Remove a point", withEntity(store.doc, less));
  }

  /** The line between before and after, by a hundredth of the width. */
  private wipe(by: number): void {
    const { store } = this.studio;
    const { wipe } = store.state.looks;
    if (wipe !== null) store.look({ wipe: Math.min(1, Math.max(0, wipe + by)) });
  }

  private zoom(factor: number): void {
    const { view } = this.table;
    view.zoomAt([view.width / 2, view.height / 2], factor);
    this.table.paint();
  }

  /** H goes through the handles of what is chosen; arrows then move that handle. */
  private nextHandle(): void {
    const { store } = this.studio;
    const e = entityOf(store.doc, store.state.selection.at(-1) ?? null);
    const count = e ? handlesOf(e).length : 0;
    const next = this.handle === null ? 0 : this.handle + 1;
    this.handle = next < count ? next : null;
    store.say(this.handle === null ? "Arrows move the view" : `Arrows move handle ${this.handle + 1} of ${count}`);
  }

  private arrow(by: Point, wide: boolean): boolean {
    const { store } = this.studio;
    const { view } = this.table;
    const e = entityOf(store.doc, store.state.selection.at(-1) ?? null);
    const handle = this.handle === null ? undefined : e && handlesOf(e)[this.handle];
    if (e && !isHeld(store.doc, e) && handle) {
      const step = (wide ? kWide : 1) / view.scale;
      const to: Point = [handle[0] + by[0] * step, handle[1] + by[1] * step];
      store.commit("Nudge", withEntity(store.doc, withHandle(e, this.handle as number, to)));
      return true;
    }
    view.panBy(-by[0] * kPan, by[1] * kPan);
    this.table.paint();
    return true;
  }

  /** All that is chosen, by a pixel or ten; a key held down makes one step of undo. */
  private nudge(by: Point, wide: boolean, held: boolean): boolean {
    const { store } = this.studio;
    const ids = movable(store);
    if (ids.length === 0) return true;
    const step = (wide ? kWide : 1) / this.table.view.scale;
    const doc = carriedDoc(this.table, store.state.history.now, ids, shiftedBy([by[0] * step, by[1] * step]));
    if (held && store.state.history.past.at(-1)?.label === kNudge) store.amend(doc);
    else store.commit(kNudge, doc);
    return true;
  }
}
