/** The line between before and after over surfaces: dragged, or moved by arrows as the slider it is. */
import type { Store } from "../model/state.ts";
import { h } from "../ui/dom.ts";

const kStep = 0.01; // of the width
const kWide = 10; // times as far, with Shift

export class WipeBar {
  readonly element = h("div", {
    class: "wipe-bar", role: "slider", tabindex: 0, hidden: true, "aria-label": "Wipe between before and after",
    "aria-valuemin": 0, "aria-valuemax": 100,
  }, h("span", { class: "side" }, "before"), h("span", { class: "grip" }), h("span", { class: "side" }, "after"));

  constructor(private readonly store: Store) {
    const { element } = this;
    element.addEventListener("pointerdown", (e) => {
      element.setPointerCapture(e.pointerId);
      element.focus({ preventScroll: true });
      e.preventDefault();
    });
    element.addEventListener("pointermove", (e) => {
      const box = element.parentElement?.getBoundingClientRect();
      if (box && element.hasPointerCapture(e.pointerId)) this.put((e.clientX - box.left) / box.width);
    });
    element.addEventListener("keydown", (e) => this.key(e));
  }

  show(shown: boolean): void {
    this.element.hidden = !shown;
    this.follow();
  }

  follow(): void {
    const { wipe } = this.store.state.looks;
    if (wipe === null) return;
    this.element.style.left = `${100 * wipe}%`;
    this.element.setAttribute("aria-valuenow", String(Math.round(100 * wipe)));
    this.element.setAttribute("aria-valuetext", `before on the left ${Math.round(100 * wipe)} %`);
  }

  private put(share: number): void {
    this.store.look({ wipe: Math.min(1, Math.max(0, share)) });
  }

  private key(e: KeyboardEvent): void {
    const now = this.store.state.looks.wipe ?? 0.5;
    const by = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[e.key];
    const to = e.key === "Home" ? 0 : e.key === "End" ? 1 : by && now + by * kStep * (e.shiftKey ? kWide : 1);
    if (to === undefined) return;
    this.put(to);
    e.preventDefault();
    e.stopPropagation();
  }
}
