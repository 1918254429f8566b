import { label, roundStep, ticks } from "../view/ticks.ts";
import type { Viewport } from "../view/viewport.ts";
import type { Palette } from "./palette.ts";

export const kRuler = 22; // pixels

const kFine = 9; // least pixels between fine lines
const kLabelled = 64; // least pixels between numbers

function lines(g: CanvasRenderingContext2D, view: Viewport, step: number): void {
  const low = view.toModel([0, view.height]);
  const high = view.toModel([view.width, 0]);
  g.beginPath();
  for (const x of ticks(low[0], high[0], step)) {
    const at = Math.round(view.toScreen([x, 0])[0]) + 0.5;
    g.moveTo(at, 0);
    g.lineTo(at, view.height);
  }
  for (const y of ticks(low[1], high[1], step)) {
    const at = Math.round(view.toScreen([0, y])[1]) + 0.5;
    g.moveTo(0, at);
    g.lineTo(view.width, at);
  }
  g.stroke();
}

export const gridStep = (view: Viewport): number => roundStep(kFine / view.scale);

export function paintGrid(g: CanvasRenderingContext2D, view: Viewport, colors: Palette): void {
  g.lineWidth = 1;
  const coarse = roundStep(kLabelled / view.scale);
  g.strokeStyle = colors.gridFine;
  lines(g, view, gridStep(view));
  g.strokeStyle = colors.grid;
  lines(g, view, coarse);
  const [x, y] = view.toScreen([0, 0]);
  g.strokeStyle = colors.axis;
  g.beginPath();
  g.moveTo(Math.round(x) + 0.5, 0);
  g.lineTo(Math.round(x) + 0.5, view.height);
  g.moveTo(0, Math.round(y) + 0.5);
  g.lineTo(view.width, Math.round(y) + 0.5);
  g.stroke();
}

export function paintRulers(g: CanvasRenderingContext2D, view: Viewport, colors: Palette, unit: string,
                            cursor: [number, number] | null): void {
  const step = roundStep(kLabelled / view.scale);
  const low = view.toModel([0, view.height]);
  const high = view.toModel([view.width, 0]);
  g.fillStyle = colors.ruler;
  g.fillRect(0, 0, view.width, kRuler);
  g.fillRect(0, 0, kRuler, view.height);
  g.strokeStyle = colors.axis;
  g.fillStyle = colors.rulerText;
  g.font = "10px system-ui, sans-serif";
  g.lineWidth = 1;
  g.beginPath();
  g.textAlign = "left";
  g.textBaseline = "middle";
  for (const x of ticks(low[0], high[0], step / 5)) {
    const at = Math.round(view.toScreen([x, 0])[0]) + 0.5;
    const whole = Math.abs(x / step - Math.round(x / step)) < 1e-6;
    g.moveTo(at, kRuler - (whole ? kRuler : 5));
    g.lineTo(at, kRuler);
    if (whole && at > kRuler) g.fillText(label(x, step), at + 3, 8);
  }
  g.save();
  for (const y of ticks(low[1], high[1], step / 5)) {
    const at = Math.round(view.toScreen([0, y])[1]) + 0.5;
    const whole = Math.abs(y / step - Math.round(y / step)) < 1e-6;
    g.moveTo(kRuler - (whole ? kRuler : 5), at);
    g.lineTo(kRuler, at);
    if (!whole || at < kRuler + 14) continue;
    g.save();
    g.translate(8, at - 3);
    g.rotate(-Math.PI / 2);
    g.fillText(label(y, step), 0, 0);
    g.restore();
  }
  g.restore();
  g.stroke();
  if (cursor) {
    g.fillStyle = colors.handle;
    g.fillRect(cursor[0] - 0.5, 0, 1, kRuler);
    g.fillRect(0, cursor[1] - 0.5, kRuler, 1);
  }
  g.fillStyle = colors.ruler;
  g.fillRect(0, 0, kRuler, kRuler);
  g.fillStyle = colors.rulerText;
  g.textAlign = "center";
  g.fillText(unit || "\u2013", kRuler / 2, kRuler / 2);
}
