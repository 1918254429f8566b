/** The picture in 8 by 8 regions, each with a threshold of its own where a hand has set one. */
import type { Underlay } from "../model/state.ts";
import { slider } from "../ui/controls.ts";
import { fill, h } from "../ui/dom.ts";

const kSide = 8; // as sketch.trace has them

export class Regions {
  readonly values: (number | null)[] = Array<null>(kSide * kSide).fill(null);
  private chosen: number | null = null;
  private open = false;

  get any(): boolean {
    return this.values.some((v) => v !== null);
  }

  element(underlay: Underlay): HTMLElement {
    const details = h("details", { open: this.open, id: "regions" }, h("summary", {}, "Threshold by region"));
    details.addEventListener("toggle", () => { this.open = details.open; });
    const below = h("div");
    const cells = this.values.map((_, i) => h("button", {
      type: "button", class: "cell", "aria-label": `Region ${Math.floor(i / kSide) + 1}, ${(i % kSide) + 1}`,
      click: () => {
        this.chosen = i;
        mark();
      },
    }));
    const mark = () => {
      cells.forEach((cell, i) => {
        cell.classList.toggle("own", this.values[i] !== null);
        cell.setAttribute("aria-pressed", String(i === this.chosen));
      });
      fill(below, this.chosen === null ? h("p", { class: "quiet" }, "Click a region of the picture.") : this.control(this.chosen, mark));
    };
    mark();
    const picture = h("img", { src: underlay.stages.find((s) => s.name === "log")?.url ?? underlay.url, alt: "" });
    const grid = h("div", { class: "regions" }, picture, h("div", { class: "cells" }, ...cells));
    grid.style.aspectRatio = `${underlay.width} / ${underlay.height}`;
    details.append(grid, below);
    return details;
  }

  private control(i: number, mark: () => void): HTMLElement {
    return h("div", {},
      slider({
        id: "region-threshold", label: `Region ${Math.floor(i / kSide) + 1}, ${(i % kSide) + 1}: ink is darker than`,
        value: this.values[i] ?? 0.5, min: 0, max: 1, show: (v) => v.toFixed(2),
        onInput: (v) => { this.values[i] = v; }, onDone: mark,
      }),
      h("button", {
        type: "button", click: () => {
          this.values[i] = null;
          mark();
        },
      }, "As found"));
  }
}
