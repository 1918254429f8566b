import type { Palette } from "../canvas/palette.ts";
import type { DeviationTold } from "../model/deviation.ts";
import type { Comb } from "../model/document.ts";
import { nearestIndex } from "../view/nearest.ts";
import { Plot, type Range, rangeOf, withOther } from "./plot.ts";

export interface Graphed {
  comb: Comb;
  before: Comb | undefined;
  /** name of another curve that `before` is */
  beside: string;
  /** slope of each piece, where the curve tells */
  slopes: readonly (number | null)[];
  hover: number | null;
  /** lengths of a part that is pointed at */
  stretch: { from: number; to: number } | null;
  /** of measured points, where somebody looks */
  deviation: DeviationTold | undefined;
  /** what is measured with */
  unit: string;
}

/** Signed curvature against length; joints upright, the curve before it behind. */
export class CurvaturePlot extends Plot {
  private length = 1;
  private steps: readonly number[] = [];

  private target: [number, number][] = [];
  /** a hand draws a target here instead of reading places */
  targeting = false;
  onTarget: (target: readonly (readonly [number, number])[]) => void = () => {};

  constructor() {
    super("Curvature", "s", "\u03ba");
    this.canvas.addEventListener("pointerdown", (e) => {
      if (!this.targeting) return;
      this.canvas.setPointerCapture(e.pointerId);
      this.target = [[this.valueX(e.offsetX), this.valueY(e.offsetY)]];
    });
    this.canvas.addEventListener("pointermove", (e) => {
      if (this.targeting && e.buttons & 1) this.draw(this.valueX(e.offsetX), this.valueY(e.offsetY));
    });
    this.canvas.addEventListener("pointerup", () => {
      if (!this.targeting) return;
      this.targeting = false;
      this.onTarget([...this.target].sort((a, b) => a[0] - b[0]));
      this.target = [];
    });
  }

  /** Drawn over again, the newest line counts. */
  private draw(s: number, curvature: number): void {
    const last = this.target.at(-1)?.[0] ?? s;
    this.target = [...this.target.filter(([at]) => at <= Math.min(last, s) || at >= Math.max(last, s)), [s, curvature]];
    this.onResize();
  }

  paint(graphed: Graphed | null, colors: Palette): void {
    if (!graphed) {
      this.steps = [];
      return this.blank(colors, "No curve is chosen");
    }
    const { comb, before } = graphed;
    this.length = comb.length;
    this.steps = comb.arc_length;
    const own = this.heights(comb);
    const y = before && graphed.beside ? withOther(own, this.heights(before)) : own;
    this.axes = { x: { low: 0, high: comb.length * 1.0001 }, y };
    this.begin(colors);
    if (graphed.stretch) this.band(graphed.stretch, colors);
    for (const i of comb.joints) this.upright(comb.arc_length[i] as number, colors.axis, [2, 3]);
    if (before) {
      const along = comb.length / before.length;
      this.line(before.arc_length.map((s) => s * along), before.curvature, colors.before, 1, new Set(before.joints));
    }
    this.line(comb.arc_length, comb.curvature, colors.comb, 1.75);
    for (const event of comb.graphs?.events ?? []) {
      if (event.curvature === null) continue;
      const extreme = event.kind === "maximum" || event.kind === "minimum";
      this.dot(event.arc_length as number, event.curvature as number,
        extreme ? colors.maximum : colors.inflection, colors.ground, 3.5);
    }
    const drawn = [...this.target].sort((a, b) => a[0] - b[0]);
    this.line(drawn.map((p) => p[0]), drawn.map((p) => p[1]), colors.handle, 2);
    this.nameSlopes(graphed, colors);
    if (graphed.hover !== null) {
      this.upright(comb.arc_length[graphed.hover] as number, colors.faint);
      this.dot(comb.arc_length[graphed.hover] as number, comb.curvature[graphed.hover] as number,
        colors.mark, colors.ground, 4.5);
    }
    this.end();
    this.say(before ? `blue: ${graphed.beside || "before"}` : "");
  }

  /** Zero is in sight unless the curve keeps far from it: then how it changes is. */
  private heights(comb: Comb): Range {
    const own = rangeOf(comb.curvature, 0.12) ?? { low: 0, high: 1 };
    const far = own.low > 0 ? own.low > own.high / 2 : own.high < own.low / 2;
    return far ? own : (rangeOf([...comb.curvature, 0], 0.1) as Range);
  }

  private band({ from, to }: { from: number; to: number }, colors: Palette): void {
    this.pen.fillStyle = colors.region;
    this.pen.fillRect(this.x(from), 0, this.x(to) - this.x(from), this.height);
  }

  private nameSlopes({ comb, slopes }: Graphed, colors: Palette): void {
    const g = this.pen;
    const starts = [0, ...comb.joints, comb.arc_length.length];
    g.fillStyle = colors.faint;
    g.textAlign = "center";
    g.textBaseline = "top";
    for (let i = 0; i + 1 < starts.length; ++i) {
      const slope = slopes[i];
      const from = this.x(comb.arc_length[starts[i] as number] as number);
      const to = this.x(comb.arc_length[(starts[i + 1] as number) - 1] as number);
      if (slope === null || slope === undefined || to - from < 40) continue;
      g.fillText(`\u03b1 ${slope.toFixed(2).replace("-", "\u2212")}`, (from + to) / 2, 25);
    }
  }

  /** The sample whose length is nearest. */
  hit(x: number): number | null {
    if (this.steps.length === 0) return null;
    const s = this.valueX(x);
    if (s < -0.02 * this.length || s > 1.02 * this.length) return null;
    return nearestIndex(this.steps, s);
  }
}
