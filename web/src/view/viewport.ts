/** Where the model stands on the screen: x to the right, y up, lengths in the document's unit. */
import type { Pixel, Point } from "../model/document.ts";

export interface Box {
  low: Point;
  high: Point;
}

export interface Margins {
  left: number;
  top: number;
  right: number;
  bottom: number;
}

const kSmallest = 1e-6; // pixels per unit
const kLargest = 1e9;

export class Viewport {
  width = 800;
  height = 600;
  /** pixels per unit */
  scale = 1;
  center: Point = [0, 0];

  toScreen([x, y]: Point): Pixel {
    return [
      this.width / 2 + (x - this.center[0]) * this.scale,
      this.height / 2 - (y - this.center[1]) * this.scale,
    ];
  }

  toModel([x, y]: Pixel): Point {
    return [
      this.center[0] + (x - this.width / 2) / this.scale,
      this.center[1] - (y - this.height / 2) / this.scale,
    ];
  }

  panBy(dx: number, dy: number): void {
    this.center = [this.center[0] - dx / this.scale, this.center[1] + dy / this.scale];
  }

  /** What lies under the screen point stays there. */
  zoomAt(at: Pixel, factor: number): void {
    const under = this.toModel(at);
    this.scale = Math.min(kLargest, Math.max(kSmallest, this.scale * factor));
    const now = this.toModel(at);
    this.center = [this.center[0] + under[0] - now[0], this.center[1] + under[1] - now[1]];
  }

  fit(box: Box, margins: Margins): void {
    const room: Pixel = [
      Math.max(40, this.width - margins.left - margins.right),
      Math.max(40, this.height - margins.top - margins.bottom),
    ];
    const size: Point = [box.high[0] - box.low[0], box.high[1] - box.low[1]];
    if (!(size[0] > 0) && !(size[1] > 0)) return;
    this.scale = Math.min(room[0] / Math.max(size[0], 1e-12), room[1] / Math.max(size[1], 1e-12));
    const offset: Pixel = [(margins.left - margins.right) / 2, (margins.top - margins.bottom) / 2];
    this.center = [
      (box.low[0] + box.high[0]) / 2 - offset[0] / this.scale,
      (box.low[1] + box.high[1]) / 2 + offset[1] / this.scale,
    ];
  }
}

export function boxOf(points: Iterable<Point>): Box | null {
  let box: Box | null = null;
  for (const [x, y] of points) {
    if (!box) box = { low: [x, y], high: [x, y] };
    box.low = [Math.min(box.low[0], x), Math.min(box.low[1], y)];
    box.high = [Math.max(box.high[0], x), Math.max(box.high[1], y)];
  }
  return box;
}
