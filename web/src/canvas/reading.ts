/** What is read at a place: its numbers beside it, the circle that touches the curve there. */
import type { Comb, Pixel, Point } from "../model/document.ts";
import type { Viewport } from "../view/viewport.ts";
import type { Palette } from "./palette.ts";

type Pen = CanvasRenderingContext2D;

const kPad = 6;
const kLine = 15;
const kAway = 14; // pixels from the place
const kFlat = 20_000; // pixels of radius beyond which a circle is a straight line

/** The circle that has the curve's place, direction and curvature in common with it. */
export function paintCircle(g: Pen, view: Viewport, comb: Comb, sample: number, colors: Palette): void {
  const k = comb.curvature[sample] ?? 0;
  const [x, y] = comb.points[sample] as Point;
  const [nx, ny] = comb.normals[sample] as Point;
  const radius = Math.abs(1 / k) * view.scale;
  if (!(radius < kFlat)) return;
  const center = view.toScreen([x + nx / k, y + ny / k]);
  g.strokeStyle = colors.evolute;
  g.lineWidth = 1;
  g.globalAlpha = 0.8;
  g.beginPath();
  g.arc(center[0], center[1], radius, 0, 2 * Math.PI);
  g.moveTo(...center);
  g.lineTo(...view.toScreen([x, y]));
  g.stroke();
  g.globalAlpha = 1;
  g.fillStyle = colors.evolute;
  g.fillRect(center[0] - 2, center[1] - 2, 4, 4);
}

/** Lines of text on a card that keeps within the canvas and off the curve's outer side. */
export function paintCard(g: Pen, view: Viewport, at: Point, outward: Point, lines: readonly string[], colors: Palette): void {
  g.font = "11px system-ui, sans-serif";
  const width = Math.max(...lines.map((line) => g.measureText(line).width)) + 2 * kPad;
  const height = kLine * lines.length + 2 * kPad - 3;
  const [x, y] = view.toScreen(at);
  const inner: Point = [-outward[0], -outward[1]]; // the comb stands on the outer side
  const left = inner[0] >= 0 ? x + kAway : x - kAway - width;
  const top = inner[1] >= 0 ? y - kAway - height : y + kAway;
  const within = (v: number, most: number) => Math.min(Math.max(v, 26), Math.max(26, most - 4));
  const box: Pixel = [within(left, view.width - width), within(top, view.height - height)];
  g.fillStyle = colors.ruler;
  g.globalAlpha = 0.92;
  g.beginPath();
  g.roundRect(box[0], box[1], width, height, 4);
  g.fill();
  g.globalAlpha = 1;
  g.strokeStyle = colors.axis;
  g.lineWidth = 1;
  g.stroke();
  g.fillStyle = colors.text;
  g.textAlign = "left";
  g.textBaseline = "top";
  lines.forEach((line, i) => g.fillText(line, box[0] + kPad, box[1] + kPad + kLine * i));
}
