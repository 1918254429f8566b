/** The two logarithmic diagrams: LCG and LDDC. */
import type { Palette } from "../canvas/palette.ts";
import type { Comb } from "../model/document.ts";
import { type Graphed } from "./curvature.ts";
import { Plot, rangeOf, withOther } from "./plot.ts";

const kNamed = 2; // slopes that have room beside the title

/** Samples of the graph at which another piece begins. */
function breaksOf(comb: Comb, samples: readonly number[]): Set<number> {
  const breaks = new Set<number>();
  let next = 0;
  samples.forEach((sample, i) => {
    while (next < comb.joints.length && (comb.joints[next] as number) <= sample) {
      breaks.add(i);
      ++next;
    }
    if (i > 0 && sample !== (samples[i - 1] as number) + 1) breaks.add(i);
  });
  return breaks;
}

abstract class LogPlot extends Plot {
  protected places: { sample: number; x: number; y: number }[] = [];

  /** The sample drawn nearest to the place. */
  hit(x: number, y: number): number | null {
    let best: { sample: number; distance: number } | null = null;
    for (const place of this.places) {
      const distance = Math.hypot(this.x(place.x) - x, this.y(place.y) - y);
      if (!best || distance < best.distance) best = { sample: place.sample, distance };
    }
    return best && best.distance < 60 ? best.sample : null;
  }

  protected empty(colors: Palette, graphed: Graphed | null): void {
    this.places = [];
    this.blank(colors, graphed ? "The radius does not change" : "");
  }
}

/** log(rho ds/drho) over log rho: a straight line wherever the curve is log-aesthetic. */
export class LcgPlot extends LogPlot {
  constructor() {
    super("LCG", "log \u03c1", "log \u03c1 ds/d\u03c1");
  }

  paint(graphed: Graphed | null, colors: Palette): void {
    const graphs = graphed?.comb.graphs;
    const lcg = (graphs?.lcg ?? []) as [number, number][];
    if (!graphed || !graphs || lcg.length === 0) return this.empty(colors, graphed);
    const samples = graphs.samples ?? [];
    const xs = lcg.map((p) => p[0]);
    const ys = lcg.map((p) => p[1]);
    const old = (graphed.before?.graphs?.lcg ?? []) as [number, number][];
    this.axes = {
      x: withOther(rangeOf(xs) ?? { low: 0, high: 1 }, rangeOf(old.map((p) => p[0]))),
      y: withOther(rangeOf(ys) ?? { low: 0, high: 1 }, rangeOf(old.map((p) => p[1]))),
    };
    this.places = samples.map((sample, i) => ({ sample, x: xs[i] as number, y: ys[i] as number }));
    this.begin(colors);
    if (graphed.before && old.length > 0)
      this.line(old.map((p) => p[0]), old.map((p) => p[1]), colors.before, 1,
        breaksOf(graphed.before, graphed.before.graphs?.samples ?? []));
    this.line(xs, ys, colors.comb, 1.75, breaksOf(graphed.comb, samples));
    const at = graphed.hover === null ? -1 : samples.indexOf(graphed.hover);
    if (at >= 0) this.dot(xs[at] as number, ys[at] as number, colors.mark, colors.ground, 4.5);
    this.end();
    const slopes = graphed.slopes.filter((s): s is number => s !== null);
    const named = slopes.map((s) => s.toFixed(2).replace("-", "\u2212"));
    this.say(named.length > kNamed ? `${named.length} slopes` : named.length > 0 ? `slope ${named.join("  ")}` : "");
  }
}

/** How much of the length has which radius, both logarithmic. */
export class LddcPlot extends LogPlot {
  constructor() {
    super("LDDC", "log\u2081\u2080 \u03c1/L", "log\u2081\u2080 share");
  }

  paint(graphed: Graphed | null, colors: Palette): void {
    const graphs = graphed?.comb.graphs;
    const tops = (graphs?.lddc ?? []) as [number, number][];
    if (!graphed || !graphs || tops.length === 0) return this.empty(colors, graphed);
    const x = rangeOf(tops.map((t) => t[0]), 0.1) ?? { low: -1, high: 1 };
    const y = rangeOf([...tops.map((t) => t[1]), -3], 0.1) ?? { low: -3, high: 0 };
    this.axes = { x: { low: x.low - 0.05, high: x.high + 0.05 }, y: { low: -3.1, high: y.high } };
    const bars = graphs.bars ?? [];
    this.places = (graphs.samples ?? []).flatMap((sample, i) => {
      const top = tops[bars[i] ?? -1];
      return top ? [{ sample, x: top[0], y: top[1] }] : [];
    });
    this.begin(colors);
    const g = this.pen;
    const hovered = this.places.find((p) => p.sample === graphed.hover);
    for (const [at, height] of tops) {
      const left = this.x(at - 0.022);
      const right = this.x(at + 0.022);
      const top = this.y(height);
      const lit = hovered?.x === at;
      g.fillStyle = lit ? colors.comb : colors.combFill;
      g.strokeStyle = colors.comb;
      g.lineWidth = 1;
      g.fillRect(left, top, right - left, this.y(-3.1) - top);
      g.strokeRect(left, top, right - left, this.y(-3.1) - top);
    }
    this.end();
    const slope = graphs.lddc_gradient;
    this.say(typeof slope === "number" ? `gradient ${slope.toFixed(2).replace("-", "\u2212")}` : "");
  }
}
