/** How far measured points lie from the curve, against its length. */
import type { Palette } from "../canvas/palette.ts";
import { nearestIndex } from "../view/nearest.ts";
import { measure } from "../view/ticks.ts";
import type { Graphed } from "./curvature.ts";
import { Plot } from "./plot.ts";

export class DeviationPlot extends Plot {
  private steps: readonly number[] = [];

  constructor() {
    super("Deviation", "s", "left +");
  }

  paint(graphed: Graphed | null, colors: Palette): void {
    const told = graphed?.deviation;
    this.steps = graphed?.comb.arc_length ?? [];
    if (!graphed || !told) {
      return this.blank(colors, graphed ? "Of curves made of measured points" : "");
    }
    const places = told.places.arc_length ?? [];
    const distances = told.places.distance ?? [];
    const most = Math.max(told.tolerance, told.places.max ?? 0) * 1.15;
    this.axes = { x: { low: 0, high: graphed.comb.length * 1.0001 }, y: { low: -most, high: most } };
    this.begin(colors);
    this.level(told.tolerance, colors);
    this.level(-told.tolerance, colors);
    this.hairs(places, distances, told.tolerance, colors);
    if (graphed.hover !== null) this.upright(graphed.comb.arc_length[graphed.hover] as number, colors.faint);
    this.end();
    this.say(`largest ${measure(told.places.max ?? 0, 3)}, rms ${measure(told.places.rms ?? 0, 3)}`);
  }

  private level(value: number, colors: Palette): void {
    const g = this.pen;
    g.strokeStyle = colors.bad;
    g.globalAlpha = 0.7;
    g.lineWidth = 1;
    g.setLineDash([4, 3]);
    g.beginPath();
    g.moveTo(0, this.y(value));
    g.lineTo(this.width, this.y(value));
    g.stroke();
    g.setLineDash([]);
    g.globalAlpha = 1;
  }

  private hairs(places: readonly number[], distances: readonly number[], tolerance: number, colors: Palette): void {
    const g = this.pen;
    g.strokeStyle = colors.before;
    g.lineWidth = 1;
    g.beginPath();
    places.forEach((s, i) => {
      g.moveTo(this.x(s), this.y(0));
      g.lineTo(this.x(s), this.y(distances[i] as number));
    });
    g.stroke();
    places.forEach((s, i) => {
      const distance = distances[i] as number;
      g.fillStyle = Math.abs(distance) > tolerance ? colors.bad : colors.before;
      g.fillRect(this.x(s) - 1.5, this.y(distance) - 1.5, 3, 3);
    });
  }

  hit(x: number, _y: number): number | null {
    return this.steps.length === 0 ? null : nearestIndex(this.steps, this.valueX(x));
  }
}
