import type { Palette } from "../canvas/palette.ts";
import type { Comb } from "../model/document.ts";
import { nearestIndex } from "../view/nearest.ts";
import { Plot, type Range, rangeOf } from "./plot.ts";

export interface Graphed {
  comb: Comb;
  before: Comb | undefined;
  /** slope of each piece, where the curve tells */
  slopes: readonly (number | null)[];
  hover: number | null;
  /** what is measured with */
  unit: string;
}

/** Signed curvature against length; joints upright, the curve before it behind. */
export class CurvaturePlot extends Plot {
  private length = 1;
  private steps: readonly number[] = [];

  constructor() {
    super("Curvature", "s", "\u03ba");
  }

  paint(graphed: Graphed | null, colors: Palette): void {
    if (!graphed) {
      this.say("");
      this.begin(colors);
      this.end();
      return;
    }
    const { comb, before } = graphed;
    this.length = comb.length;
    this.steps = comb.arc_length;
    const own = this.heights(comb);
    this.axes = { x: { low: 0, high: comb.length * 1.0001 }, y: own };
    this.begin(colors);
    for (const i of comb.joints) this.upright(comb.arc_length[i] as number, colors.axis, [2, 3]);
    if (before) {
      const along = comb.length / before.length;
      this.line(before.arc_length.map((s) => s * along), before.curvature, colors.before, 1, new Set(before.joints));
    }
    this.line(comb.arc_length, comb.curvature, colors.comb, 1.75);
    for (const event of comb.graphs?.events ?? []) {
      const extreme = event.kind === "maximum" || event.kind === "minimum";
      this.dot(event.arc_length as number, event.curvature as number,
        extreme ? colors.maximum : colors.inflection, colors.ground, 3.5);
    }
    this.nameSlopes(graphed, colors);
    if (graphed.hover !== null) {
      this.upright(comb.arc_length[graphed.hover] as number, colors.faint);
      this.dot(comb.arc_length[graphed.hover] as number, comb.curvature[graphed.hover] as number,
        colors.mark, colors.ground, 4.5);
    }
    this.end();
    this.say(before ? "amber: after \u00b7 blue: before" : "");
  }

  /** Zero is in sight unless the curve keeps far from it: then how it changes is. */
  private heights(comb: Comb): Range {
    const own = rangeOf(comb.curvature, 0.12) ?? { low: 0, high: 1 };
    const far = own.low > 0 ? own.low > own.high / 2 : own.high < own.low / 2;
    return far ? own : (rangeOf([...comb.curvature, 0], 0.1) as Range);
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
