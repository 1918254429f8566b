import { type Entity, handlesOf, type Pixel, type Point } from "../model/document.ts";
import type { Viewport } from "../view/viewport.ts";
import type { Palette } from "./palette.ts";

type Pen = CanvasRenderingContext2D;

function legs(e: Entity): [number, number][] {
  switch (e.kind) {
    case "segment":
    case "compound":
    case "quasi":
      return [[0, 1], [1, 2]];
    case "s-shape":
      return [[0, 1], [2, 3]];
    case "mirror":
      return [[0, 1]];
    case "fixed":
      return handlesOf(e).slice(1).map((_, i) => [i, i + 1]);
    default:
      return [];
  }
}

/** Ends are squares, handles of direction are rings: what the curve passes, and what it only looks at. */
function isEnd(e: Entity, i: number): boolean {
  if (e.kind === "spline") return true;
  const n = handlesOf(e).length;
  return i === 0 || i === n - 1;
}

export function paintHandles(g: Pen, view: Viewport, e: Entity, colors: Palette, hot: number | null,
                             joint: Point | null): void {
  const at = handlesOf(e).map((p) => view.toScreen(p));
  g.strokeStyle = colors.handleLine;
  g.lineWidth = 1;
  if (e.kind === "mirror") g.setLineDash([8, 4, 2, 4]);
  g.beginPath();
  for (const [a, b] of legs(e)) {
    g.moveTo(...(at[a] as Pixel));
    g.lineTo(...(at[b] as Pixel));
  }
  g.stroke();
  g.setLineDash([]);
  at.forEach(([x, y], i) => {
    const r = hot === i ? 6 : 4.5;
    g.beginPath();
    if (isEnd(e, i)) g.rect(x - r, y - r, 2 * r, 2 * r);
    else g.arc(x, y, r + 0.5, 0, 2 * Math.PI);
    g.fillStyle = hot === i ? colors.handle : colors.ground;
    g.fill();
    g.strokeStyle = colors.handle;
    g.lineWidth = 2;
    g.stroke();
  });
  if (joint) paintJoint(g, view.toScreen(joint), colors);
}

/** A diamond: it slides along the curve instead of standing free. */
function paintJoint(g: Pen, [x, y]: Pixel, colors: Palette): void {
  g.beginPath();
  for (const [dx, dy] of [[0, -7], [7, 0], [0, 7], [-7, 0]] as const) g.lineTo(x + dx, y + dy);
  g.closePath();
  g.fillStyle = colors.ground;
  g.fill();
  g.strokeStyle = colors.handle;
  g.lineWidth = 2;
  g.stroke();
}
