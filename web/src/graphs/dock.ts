/** The graphs below the canvas: of the chosen curve, all linked by the sample that is hovered. */
import type { Palette } from "../canvas/palette.ts";
import type { DeviationTold } from "../model/deviation.ts";
import type { Shown } from "../model/live.ts";
import type { Store } from "../model/state.ts";
import { slopesOf } from "../panels/measures.ts";
import { h } from "../ui/dom.ts";
import { CurvaturePlot, type Graphed } from "./curvature.ts";
import { DeviationPlot } from "./deviation.ts";
import { LcgPlot, LddcPlot } from "./logarithmic.ts";

export interface Subject {
  entity: number;
  shown: Shown;
  before: Shown | undefined;
  /** name of another curve that `before` is */
  beside: string;
  deviation: DeviationTold | undefined;
}

export class Dock {
  readonly element: HTMLElement;
  readonly curvature = new CurvaturePlot();
  private readonly lcg = new LcgPlot();
  private readonly lddc = new LddcPlot();
  private readonly deviation = new DeviationPlot();

  constructor(private readonly store: Store, private readonly subject: () => Subject | null,
              private readonly colors: () => Palette) {
    this.element = h("div", { class: "dock" }, this.curvature.element, this.lcg.element, this.lddc.element,
      this.deviation.element);
    for (const plot of [this.curvature, this.lcg, this.lddc, this.deviation]) {
      plot.onResize = () => this.paint();
      plot.canvas.addEventListener("pointermove", (e) => {
        if (!this.store.state.targeting) this.hover(plot.hit(e.offsetX, e.offsetY));
      });
      plot.canvas.addEventListener("pointerleave", () => this.store.set({ hover: null }));
      plot.canvas.addEventListener("keydown", (e) => this.key(e));
    }
  }

  private hover(sample: number | null): void {
    const subject = this.subject();
    const now = this.store.state.hover;
    if (now?.sample === sample && now?.entity === subject?.entity) return;
    this.store.set({ hover: subject && sample !== null ? { entity: subject.entity, sample } : null });
  }

  /** Arrows walk along the curve. */
  private key(e: KeyboardEvent): void {
    const step = { ArrowLeft: -1, ArrowRight: 1, PageDown: 10, PageUp: -10 }[e.key];
    const subject = this.subject();
    if (!step || !subject) return;
    const last = subject.shown.comb.points.length - 1;
    const now = this.store.state.hover?.sample ?? (step > 0 ? -1 : last + 1);
    this.hover(Math.min(last, Math.max(0, now + step)));
    e.preventDefault();
    e.stopPropagation();
  }

  paint(): void {
    const subject = this.subject();
    const { hover, looks, stretch } = this.store.state;
    const graphed: Graphed | null = subject && {
      comb: subject.shown.comb,
      before: looks.before ? subject.before?.comb : undefined,
      beside: subject.beside,
      slopes: slopesOf(subject.shown),
      hover: hover?.entity === subject.entity ? hover.sample : null,
      stretch: stretch?.entity === subject.entity ? stretch : null,
      deviation: subject.deviation,
      unit: this.store.doc.unit,
    };
    this.curvature.targeting = this.store.state.targeting;
    this.lddc.element.hidden = looks.deviation;
    this.deviation.element.hidden = !looks.deviation;
    const colors = this.colors();
    this.curvature.paint(graphed, colors);
    this.lcg.paint(graphed, colors);
    if (looks.deviation) this.deviation.paint(graphed, colors);
    else this.lddc.paint(graphed, colors);
  }
}
