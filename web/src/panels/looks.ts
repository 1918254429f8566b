/** How curves are looked at: the comb first. */
import { entityOf } from "../model/document.ts";
import { docOf, type State, type Store } from "../model/state.ts";
import { iconButton, slider } from "../ui/controls.ts";
import { fill, h } from "../ui/dom.ts";
import { icons } from "../ui/icons.ts";

const inSpace = (state: State): boolean => entityOf(docOf(state), state.selection.at(-1) ?? null)?.kind === "surface";

export class LooksBar {
  onHelp: () => void = () => {};
  readonly element = h("div", { class: "looks", role: "toolbar", "aria-label": "How curves are shown" });

  constructor(private readonly store: Store, private readonly autoScale: () => void) {
    store.onChange((now, before) => {
      const { combScale: _a, combDensity: _b, combOwn: _e, ...rest } = now.looks;
      const { combScale: _c, combDensity: _d, combOwn: _f, ...old } = before.looks;
      if (JSON.stringify(rest) !== JSON.stringify(old) || inSpace(now) !== inSpace(before)) this.render();
    });
    this.render();
  }

  private render(): void {
    const { store } = this;
    const { looks } = store.state;
    const space = inSpace(store.state); // where nothing of the drawing board is seen
    const flip = (id: string, icon: string, label: string, name: "comb" | "combOfAll" | "evolute" | "circle" | "deviation" | "grid" | "snap", key?: string) =>
      iconButton({
        id: `look-${id}`, icon, label, pressed: looks[name] && !space, disabled: space, ...(key ? { key } : {}),
        onClick: () => store.look({ [name]: !looks[name] }),
      });
    fill(this.element,
      flip("comb", icons.comb, "Comb", "comb", "K"),
      flip("combs", icons.combs, "Combs of all curves", "combOfAll", "J"),
      flip("evolute", icons.evolute, "Evolute", "evolute", "E"),
      flip("circle", icons.circle, "Osculating circle where the pointer reads", "circle", "O"),
      flip("deviation", icons.deviation, "Deviation of measured points", "deviation", "D"),
      iconButton({
        id: "look-wipe", icon: icons.wipe, label: "Wipe between before and after", key: "W", pressed: looks.wipe !== null,
        onClick: () => store.look({ wipe: looks.wipe === null ? 0.5 : null }),
      }),
      flip("grid", icons.grid, "Grid", "grid", "G"),
      flip("snap", icons.snap, "Snap to ends, handles, joints and the grid", "snap", "N"),
      iconButton({
        id: "look-theme", icon: icons.sun, label: "Light or dark", pressed: looks.theme === "light",
        onClick: () => store.look({ theme: looks.theme === "dark" ? "light" : "dark" }),
      }),
      iconButton({ id: "help", icon: icons.help, label: "Keys", key: "?", onClick: () => this.onHelp() }));
  }

  /** The comb's own sliders, for the panel. */
  combControls(): HTMLElement {
    const { store } = this;
    const first = store.state.looks.combScale || 1;
    return h("div", { class: "comb-controls" },
      slider({
        id: "comb-scale", label: "Comb length", value: 0, min: -2, max: 2, show: (v) => `\u00d7${(10 ** v).toFixed(2)}`, read: Math.log10,
        onInput: (v) => store.scaleComb(first * 10 ** v), onDone: () => {},
      }),
      slider({
        id: "comb-density", label: "A tooth every", value: store.state.looks.combDensity, min: 1, max: 12, step: 1,
        show: (v) => String(v), onInput: (v) => store.look({ combDensity: Math.round(v) }), onDone: () => {},
      }),
      h("button", { type: "button", id: "comb-auto", click: this.autoScale }, "Length to fit"));
  }
}
