/** The box about chosen things, the band a hand draws, and how far things have been carried. */
import type { Pixel } from "../model/document.ts";
import type { State } from "../model/state.ts";
import { type BoxPart, type TurnBox, turnerOf } from "../gestures/box.ts";
import type { Viewport } from "../view/viewport.ts";
import { kRuler } from "./grid.ts";
import type { Palette } from "./palette.ts";

type Pen = CanvasRenderingContext2D;

const kCorner = 3.5; // half a corner's side, in pixels
const kTurner = 4.5;
const kPivot = 5;

function outline(g: Pen, at: readonly Pixel[]): void {
  g.beginPath();
  for (const p of at) g.lineTo(...p);
  g.closePath();
  g.stroke();
}

function paintPivot(g: Pen, [x, y]: Pixel, hot: boolean, colors: Palette): void {
  g.strokeStyle = colors.handle;
  g.lineWidth = hot ? 2 : 1.25;
  g.beginPath();
  g.arc(x, y, kPivot, 0, 2 * Math.PI);
  for (const [dx, dy] of [[1, 0], [0, 1]] as const) {
    g.moveTo(x - (kPivot + 3) * dx, y - (kPivot + 3) * dy);
    g.lineTo(x + (kPivot + 3) * dx, y + (kPivot + 3) * dy);
  }
  g.stroke();
}

export function paintBox(g: Pen, view: Viewport, box: TurnBox, hot: BoxPart | null, colors: Palette): void {
  const at = box.corners.map((c) => view.toScreen(c));
  const turner = turnerOf(view, box.corners);
  g.strokeStyle = colors.handleLine;
  g.lineWidth = 1;
  outline(g, at);
  g.beginPath();
  g.moveTo(...turner.foot);
  g.lineTo(...turner.at);
  g.stroke();
  g.strokeStyle = colors.handle;
  at.forEach(([x, y], i) => {
    const r = hot === i ? kCorner + 1.5 : kCorner;
    g.fillStyle = hot === i ? colors.handle : colors.ground;
    g.fillRect(x - r, y - r, 2 * r, 2 * r);
    g.strokeRect(x - r, y - r, 2 * r, 2 * r);
  });
  g.beginPath();
  g.arc(...turner.at, hot === "turn" ? kTurner + 1.5 : kTurner, 0, 2 * Math.PI);
  g.fillStyle = hot === "turn" ? colors.handle : colors.ground;
  g.fill();
  g.stroke();
  paintPivot(g, view.toScreen(box.pivot), hot === "pivot", colors);
}

/** While things are carried: their box as it goes along, and how far beside the pointer. */
export function paintCarrying(g: Pen, view: Viewport, { carrying, pivot }: State, colors: Palette): void {
  if (!carrying) return;
  g.strokeStyle = colors.handleLine;
  g.lineWidth = 1;
  if (carrying.corners.length > 0) outline(g, carrying.corners.map((c) => view.toScreen(c)));
  if (pivot) paintPivot(g, view.toScreen(pivot.at), false, colors);
  g.font = "12px system-ui, sans-serif";
  const width = g.measureText(carrying.says).width + 14;
  const [x, y] = view.toScreen(carrying.at);
  const left = Math.max(kRuler + 4, Math.min(x + 16, view.width - width - 4));
  const top = Math.max(kRuler + 4, Math.min(y + 18, view.height - 26));
  g.fillStyle = colors.ruler;
  g.globalAlpha = 0.92;
  g.fillRect(left, top, width, 22);
  g.globalAlpha = 1;
  g.fillStyle = colors.text;
  g.textAlign = "left";
  g.textBaseline = "middle";
  g.fillText(carrying.says, left + 7, top + 11.5);
}

/** Dashed where it takes what it only touches. */
export function paintBand(g: Pen, view: Viewport, band: State["band"], colors: Palette): void {
  if (!band) return;
  const [a, b] = [view.toScreen(band[0]), view.toScreen(band[1])];
  g.fillStyle = colors.region;
  g.fillRect(a[0], a[1], b[0] - a[0], b[1] - a[1]);
  g.strokeStyle = colors.handle;
  g.lineWidth = 1;
  if (b[0] < a[0]) g.setLineDash([5, 4]);
  g.strokeRect(a[0], a[1], b[0] - a[0], b[1] - a[1]);
  g.setLineDash([]);
}
