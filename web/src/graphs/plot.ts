/** A graph: a canvas with axes, lines, and the place that is hovered everywhere. */
import type { Palette } from "../canvas/palette.ts";
import { h } from "../ui/dom.ts";
import { label, roundStep, ticks } from "../view/ticks.ts";

export interface Range {
  low: number;
  high: number;
}

export interface Axes {
  x: Range;
  y: Range;
}

const kLeft = 52;
const kRight = 12;
const kTop = 24;
const kBottom = 22;
const kRounding = 1e-9; // of a value: a range below that is none
const kTickX = 58; // least pixels between numbers
const kTickY = 28;

export function rangeOf(values: Iterable<number>, margin = 0.06): Range | null {
  let low = Infinity;
  let high = -Infinity;
  for (const v of values) {
    if (v < low) low = v;
    if (v > high) high = v;
  }
  if (low > high) return null;
  const most = Math.max(Math.abs(low), Math.abs(high));
  const size = high - low > kRounding * most ? high - low : Math.max(most, 1e-12) * 0.1;
  return { low: low - margin * size, high: high + margin * size };
}

/** The one range, and of another as much as leaves the one a third of the room. */
export function withOther(own: Range, other: Range | null): Range {
  const size = own.high - own.low;
  return other ? { low: Math.max(Math.min(own.low, other.low), own.low - size), high: Math.min(Math.max(own.high, other.high), own.high + size) } : own;
}

export abstract class Plot {
  readonly canvas: HTMLCanvasElement;
  readonly element: HTMLElement;
  protected readonly pen: CanvasRenderingContext2D;
  protected axes: Axes = { x: { low: 0, high: 1 }, y: { low: 0, high: 1 } };
  protected width = 100;
  protected height = 100;
  private readonly note: HTMLElement;

  constructor(title: string, readonly xName: string, readonly yName: string) {
    this.canvas = h("canvas", { tabindex: 0, role: "img", "aria-label": title });
    this.note = h("span", { class: "note" });
    this.element = h("figure", { class: "graph" },
      h("figcaption", {}, h("span", {}, title), h("span", { class: "axis" }, yName), this.note), this.canvas);
    this.pen = this.canvas.getContext("2d") as CanvasRenderingContext2D;
    new ResizeObserver(() => this.resize()).observe(this.canvas);
  }

  /** Told when there is another size to paint. */
  onResize: () => void = () => {};

  protected say(text: string): void {
    if (this.note.textContent !== text) this.note.textContent = text;
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    const ratio = devicePixelRatio;
    this.canvas.width = Math.round(clientWidth * ratio);
    this.canvas.height = Math.round(clientHeight * ratio);
    this.pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.width = clientWidth;
    this.height = clientHeight;
    this.onResize();
  }

  x(value: number): number {
    const { low, high } = this.axes.x;
    return kLeft + ((value - low) / (high - low)) * (this.width - kLeft - kRight);
  }

  y(value: number): number {
    const { low, high } = this.axes.y;
    return this.height - kBottom - ((value - low) / (high - low)) * (this.height - kTop - kBottom);
  }

  valueX(at: number): number {
    const { low, high } = this.axes.x;
    return low + ((at - kLeft) / (this.width - kLeft - kRight)) * (high - low);
  }

  valueY(at: number): number {
    const { low, high } = this.axes.y;
    return low + ((this.height - kBottom - at) / (this.height - kTop - kBottom)) * (high - low);
  }

  protected begin(colors: Palette): void {
    const g = this.pen;
    g.fillStyle = colors.ground;
    g.fillRect(0, 0, this.width, this.height);
    g.font = "10px system-ui, sans-serif";
    g.fillStyle = colors.rulerText;
    g.strokeStyle = colors.grid;
    g.lineWidth = 1;
    const { x, y } = this.axes;
    const across = this.width - kLeft - kRight;
    const up = this.height - kTop - kBottom;
    if (across <= 0 || up <= 0) return;
    const stepX = roundStep(((x.high - x.low) * kTickX) / across);
    const stepY = roundStep(((y.high - y.low) * kTickY) / up);
    g.beginPath();
    g.textAlign = "center";
    g.textBaseline = "top";
    const free = this.width - kRight - g.measureText(this.xName).width - 6; // left of the axis' name
    for (const v of ticks(x.low, x.high, stepX)) {
      const at = Math.round(this.x(v)) + 0.5;
      g.moveTo(at, kTop);
      g.lineTo(at, this.height - kBottom);
      const text = label(v, stepX);
      if (at + g.measureText(text).width / 2 < free) g.fillText(text, at, this.height - kBottom + 6);
    }
    g.textAlign = "right";
    g.textBaseline = "middle";
    for (const v of ticks(y.low, y.high, stepY)) {
      const at = Math.round(this.y(v)) + 0.5;
      g.moveTo(kLeft, at);
      g.lineTo(this.width - kRight, at);
      g.fillText(label(v, stepY), kLeft - 6, at);
    }
    g.stroke();
    g.fillStyle = colors.faint;
    g.textAlign = "right";
    g.textBaseline = "top";
    g.fillText(this.xName, this.width - kRight, this.height - kBottom + 6);
    if (y.low < 0 && y.high > 0) {
      g.strokeStyle = colors.axis;
      g.beginPath();
      const at = Math.round(this.y(0)) + 0.5;
      g.moveTo(kLeft, at);
      g.lineTo(this.width - kRight, at);
      g.stroke();
    }
    g.save();
    g.beginPath();
    g.rect(kLeft, kTop - 2, across + 2, up + 4);
    g.clip();
  }

  /** Nothing to draw: no axes of nothing either. */
  protected blank(colors: Palette, why: string): void {
    const g = this.pen;
    this.say("");
    g.fillStyle = colors.ground;
    g.fillRect(0, 0, this.width, this.height);
    g.fillStyle = colors.faint;
    g.font = "11px system-ui, sans-serif";
    g.textAlign = "center";
    g.textBaseline = "middle";
    g.fillText(why, this.width / 2, (this.height + kTop) / 2, this.width - 16);
  }

  protected end(): void {
    this.pen.restore();
  }

  protected line(xs: ArrayLike<number>, ys: ArrayLike<number>, color: string, width: number,
                 breaks: ReadonlySet<number> = new Set()): void {
    const g = this.pen;
    g.strokeStyle = color;
    g.lineWidth = width;
    g.lineJoin = "round";
    g.beginPath();
    for (let i = 0; i < xs.length; ++i) {
      const x = this.x(xs[i] as number);
      const y = this.y(ys[i] as number);
      if (i === 0 || breaks.has(i)) g.moveTo(x, y);
      else g.lineTo(x, y);
    }
    g.stroke();
  }

  protected dot(x: number, y: number, color: string, ground: string, r = 4): void {
    const g = this.pen;
    g.beginPath();
    g.arc(this.x(x), this.y(y), r, 0, 2 * Math.PI);
    g.fillStyle = color;
    g.fill();
    g.strokeStyle = ground;
    g.lineWidth = 1.5;
    g.stroke();
  }

  protected upright(x: number, color: string, dash: number[] = []): void {
    const g = this.pen;
    g.strokeStyle = color;
    g.lineWidth = 1;
    g.setLineDash(dash);
    g.beginPath();
    const at = Math.round(this.x(x)) + 0.5;
    g.moveTo(at, kTop);
    g.lineTo(at, this.height - kBottom);
    g.stroke();
    g.setLineDash([]);
  }
}
