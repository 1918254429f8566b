/** The alpha-s plane: where Class A is, lines of equal energy, and the curve as a point in it. */
import type { CurvePlaneResult } from "../../generated/operations.ts";
import type { Palette } from "../canvas/palette.ts";
import type { Point } from "../model/document.ts";
import { contour, evenLevels, type Field } from "../view/contour.ts";
import { Plot } from "./plot.ts";

export interface Placed {
  plane: CurvePlaneResult;
  /** the curve as it was given, where it has a place */
  given: Point | null;
  /** the curve now, and whether that is only the nearest of one matrix */
  now: Point | null;
  near: boolean;
  minimum: Point | null;
  path: readonly Point[];
}

const kLevels = 9;

export class PlanePlot extends Plot {
  private lines: [Point, Point][][] = [];
  private contoured: CurvePlaneResult | null = null;

  constructor() {
    super("\u03b1\u2013s plane", "\u03b1", "s");
  }

  /** Contours are worked out once for a curve, not with every move. */
  private contours(plane: CurvePlaneResult): [Point, Point][][] {
    if (this.contoured === plane) return this.lines;
    this.contoured = plane;
    const field: Field = {
      x: plane.alpha as [number, number], y: plane.s as [number, number], rows: (plane.energy ?? []) as number[][],
    };
    this.lines = evenLevels(field, kLevels).map((level) => contour(field, level));
    return this.lines;
  }

  paint(placed: Placed | null, colors: Palette): void {
    if (!placed) return this.blank(colors, "\u2026");
    const { plane } = placed;
    const [low, high] = plane.s as [number, number];
    this.axes = { x: { low: 0, high: (plane.alpha as [number, number])[1] }, y: { low, high } };
    this.begin(colors);
    this.regions(plane, colors, low, high);
    this.pen.strokeStyle = colors.faint;
    this.pen.lineWidth = 0.75;
    this.pen.globalAlpha = 0.55;
    this.pen.beginPath();
    for (const line of this.contours(plane).flat()) this.segment(line);
    this.pen.stroke();
    this.pen.globalAlpha = 1;
    this.dashed((plane.reach ?? []) as Point[], colors.evolute, [2, 3]);
    this.dashed(placed.path, colors.comb, [5, 3]);
    if (placed.minimum) this.cross(placed.minimum, colors.inflection);
    if (placed.given) this.dot(...placed.given, colors.before, colors.ground, 4);
    if (placed.now) this.dot(...placed.now, placed.near ? colors.faint : colors.handle, colors.ground, 6);
    this.end();
    this.say(placed.near ? "ring: the nearest of one matrix" : "");
  }

  private regions(plane: CurvePlaneResult, colors: Palette, low: number, high: number): void {
    const g = this.pen;
    for (const [line, edge] of [[plane.growing, high], [plane.falling, low]] as const) {
      const border = (line ?? []) as Point[];
      g.beginPath();
      for (const p of border) g.lineTo(this.x(p[0]), this.y(p[1]));
      for (const p of [...border].reverse()) g.lineTo(this.x(p[0]), this.y(edge));
      g.fillStyle = colors.region;
      g.fill();
      this.line(border.map((p) => p[0]), border.map((p) => p[1]), colors.regionEdge, 1.25);
    }
  }

  private segment([a, b]: [Point, Point]): void {
    this.pen.moveTo(this.x(a[0]), this.y(a[1]));
    this.pen.lineTo(this.x(b[0]), this.y(b[1]));
  }

  private dashed(points: readonly Point[], color: string, dash: number[]): void {
    this.pen.setLineDash(dash);
    this.line(points.map((p) => p[0]), points.map((p) => p[1]), color, 1.5);
    this.pen.setLineDash([]);
  }

  private cross([x, y]: Point, color: string): void {
    const g = this.pen;
    const [px, py] = [this.x(x), this.y(y)];
    g.strokeStyle = color;
    g.lineWidth = 2;
    g.beginPath();
    for (const [dx, dy] of [[5, 5], [5, -5]] as const) {
      g.moveTo(px - dx, py - dy);
      g.lineTo(px + dx, py + dy);
    }
    g.stroke();
  }

  /** The place under the pointer, kept inside what is shown. */
  placeAt(x: number, y: number): { alpha: number; s: number } {
    const clamp = (v: number, { low, high }: { low: number; high: number }) => Math.min(high, Math.max(low, v));
    return { alpha: clamp(this.valueX(x), this.axes.x), s: clamp(this.valueY(y), this.axes.y) };
  }
}
