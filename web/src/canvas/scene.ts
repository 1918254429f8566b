/** All that stands on the canvas, back to front. */
import type { BoxPart, TurnBox } from "../gestures/box.ts";
import { jointOf } from "../gestures/joint.ts";
import { type Comb, type Entity, entityOf, isHeld, isShown, lineOf, type Pixel, type Point } from "../model/document.ts";
import type { DeviationTold } from "../model/deviation.ts";
import type { Live } from "../model/live.ts";
import type { DrawableRegion } from "../model/region.ts";
import { docOf, type Hover, type State } from "../model/state.ts";
import type { Viewport } from "../view/viewport.ts";
import {
  paintComb, paintCurve, paintDeviation, paintEvents, paintEvolute, paintJoints, paintMark, paintPoints, paintStrays, paintStretch,
} from "./curves.ts";
import { paintBand, paintBox, paintCarrying } from "./box.ts";
import { kRuler, paintGrid, paintRulers } from "./grid.ts";
import { paintHandles } from "./handles.ts";
import { paintCard, paintCircle } from "./reading.ts";
import { readings } from "../panels/measures.ts";
import { dark, light, type Palette } from "./palette.ts";

export interface Scene {
  state: State;
  live: Live;
  view: Viewport;
  /** the spline through the points, before fairing */
  before: (id: number) => Comb | undefined;
  /** a handle under the pointer */
  hot: { entity: number; handle: number } | null;
  /** about what is chosen, and the part of it under the pointer */
  box: TurnBox | null;
  hotPart: BoxPart | null;
  cursor: Point | null;
  /** keys move the pointer: it has to be seen */
  crosshair: boolean;
  /** points clicked so far by a drawing tool, and where the next one would be */
  started: readonly Point[];
  underlay: HTMLImageElement | null;
  region: DrawableRegion;
  deviation: (id: number) => DeviationTold | undefined;
}

export const paletteOf = (state: State): Palette => (state.looks.theme === "dark" ? dark : light);

function paintUnderlay(g: CanvasRenderingContext2D, scene: Scene): void {
  const under = scene.state.underlay;
  if (!under || !scene.underlay?.complete) return;
  const [x, y] = scene.view.toScreen([under.at[0], under.at[1] + under.height * under.scale]);
  const size = under.scale * scene.view.scale;
  g.globalAlpha = under.opacity;
  g.drawImage(scene.underlay, x, y, under.width * size, under.height * size);
  g.globalAlpha = 1;
}

function paintEntity(g: CanvasRenderingContext2D, scene: Scene, e: Entity, colors: Palette): void {
  const { state, view, live } = scene;
  const selected = state.selection.includes(e.id);
  if (e.kind === "scan") {
    paintPoints(g, view, lineOf(e).points as Point[], selected ? colors.text : colors.point);
    paintStrays(g, view, (e.strays ?? []).map((i) => e.line.points[i] as Point), colors.bad);
    return;
  }
  const shown = live.of(e.id);
  if (!shown) return;
  const { looks } = state;
  if (looks.comb && looks.combScale > 0 && !live.failureOf(e.id) && (selected || looks.combOfAll))
    paintComb(g, view, shown.comb, {
      scale: looks.combScale, density: looks.combDensity, line: colors.comb, fill: colors.combFill,
      faint: !selected,
    });
  if (looks.evolute && selected) paintEvolute(g, view, shown.comb, colors.evolute);
  g.globalAlpha = live.failureOf(e.id) ? 0.35 : 1;
  paintCurve(g, view, shown.comb, e.color || (selected ? colors.selected : colors.curve), selected ? 2.25 : 1.75);
  g.globalAlpha = 1;
  if (selected) paintJoints(g, view, shown.comb, colors.curve);
  const deviation = selected && scene.deviation(e.id);
  if (deviation) paintDeviation(g, view, deviation, colors);
  if (looks.events && selected) paintEvents(g, view, shown.comb, colors);
}

/** Teeth of both combs stand equally close, however finely each is sampled. */
function beforeDensity(scene: Scene, id: number, comb: Comb): number {
  const own = scene.live.of(id)?.comb.points.length ?? comb.points.length;
  return Math.max(1, Math.round((scene.state.looks.combDensity * comb.points.length) / own));
}

function paintBefore(g: CanvasRenderingContext2D, scene: Scene, colors: Palette): void {
  const { state, view } = scene;
  if (!state.looks.before) return;
  for (const id of state.selection) {
    const comb = scene.before(id);
    if (!comb) continue;
    if (state.looks.comb)
      paintComb(g, view, comb, {
        scale: state.looks.combScale, density: beforeDensity(scene, id, comb), line: colors.before,
        fill: colors.beforeFill, faint: true,
      });
    paintCurve(g, view, comb, colors.before, 1);
  }
}

/** With a wipe, what is left of it shows before and what is right of it after. */
function clipped(g: CanvasRenderingContext2D, scene: Scene, left: boolean, paint: () => void): void {
  const { wipe } = scene.state.looks;
  if (wipe === null) return paint();
  const at = wipe * scene.view.width;
  g.save();
  g.beginPath();
  if (left) g.rect(0, 0, at, scene.view.height);
  else g.rect(at, 0, scene.view.width - at, scene.view.height);
  g.clip();
  paint();
  g.restore();
}

/** Of two chosen curves that have nothing before them, the one the wipe shows on its left. */
function wipedAway({ state, before }: Scene): number | null {
  if (state.looks.wipe === null || state.selection.length < 2) return null;
  return state.selection.some((id) => before(id)) ? null : state.selection[0] ?? null;
}

function paintWipe(g: CanvasRenderingContext2D, scene: Scene, colors: Palette): void {
  const { wipe } = scene.state.looks;
  if (wipe === null) return;
  const away = wipedAway(scene);
  const nameOf = (id: number | null | undefined) => entityOf(docOf(scene.state), id ?? null)?.name ?? "";
  const at = Math.round(wipe * scene.view.width) + 0.5;
  g.strokeStyle = colors.handle;
  g.lineWidth = 1;
  g.beginPath();
  g.moveTo(at, kRuler);
  g.lineTo(at, scene.view.height);
  g.stroke();
  g.fillStyle = colors.faint;
  g.font = "11px system-ui, sans-serif";
  g.textBaseline = "top";
  g.textAlign = "right";
  g.fillText(away === null ? "before" : nameOf(away), at - 8, kRuler + 8);
  g.textAlign = "left";
  g.fillText(away === null ? "after" : nameOf(scene.state.selection.at(-1)), at + 8, kRuler + 8);
}

/** Where the handle in hand may stand; the nearest curve that can be drawn, where it stands elsewhere. */
function paintRegion(g: CanvasRenderingContext2D, scene: Scene, colors: Palette): void {
  const { region, view } = scene;
  if (!scene.state.dragged) return;
  g.beginPath();
  for (const outline of region.outlines) {
    outline.forEach((p, i) => (i === 0 ? g.moveTo(...view.toScreen(p)) : g.lineTo(...view.toScreen(p))));
    g.closePath();
  }
  g.fillStyle = colors.region;
  g.fill();
  if (!region.nearest) return;
  g.setLineDash([6, 4]);
  paintCurve(g, view, region.nearest, colors.handle, 1.75);
  g.setLineDash([]);
}

/** The line that the chosen faired curve mirrors in: dashed where only the points nearly do. */
function paintSymmetry(g: CanvasRenderingContext2D, { state, view }: Scene, colors: Palette): void {
  const e = entityOf(docOf(state), state.selection.at(-1) ?? null);
  const found = e?.kind === "faired" ? e.told.symmetry : null;
  if (!found?.point) return;
  const [x, y] = view.toScreen(found.point as Point);
  const far = view.width + view.height + Math.hypot(x, y);
  const along: Pixel = [Math.cos(found.direction ?? 0) * far, -Math.sin(found.direction ?? 0) * far];
  g.strokeStyle = colors.evolute;
  g.lineWidth = found.exact ? 1.25 : 1;
  g.setLineDash(found.exact ? [14, 4, 3, 4] : [3, 5]);
  g.beginPath();
  g.moveTo(x - along[0], y - along[1]);
  g.lineTo(x + along[0], y + along[1]);
  g.stroke();
  g.setLineDash([]);
}

function paintHover(g: CanvasRenderingContext2D, scene: Scene, hover: Hover, colors: Palette): void {
  const { state, view } = scene;
  const shown = scene.live.of(hover.entity);
  const at = shown?.comb.points[hover.sample] as Point | undefined;
  if (!shown || !at) return;
  const { comb } = shown;
  if (state.looks.circle) paintCircle(g, view, comb, hover.sample, colors);
  paintMark(g, view, comb, hover.sample, state.looks.comb ? state.looks.combScale : 0, colors);
  const [nx, ny] = comb.normals[hover.sample] as Point;
  const side = (comb.curvature[hover.sample] ?? 0) > 0 ? -1 : 1;
  const doc = docOf(state);
  paintCard(g, view, at, [side * nx, side * ny], readings(entityOf(doc, hover.entity), shown, hover.sample, doc.unit), colors);
}

function paintStarted(g: CanvasRenderingContext2D, scene: Scene, colors: Palette): void {
  if (scene.started.length === 0) return;
  g.strokeStyle = colors.handleLine;
  g.lineWidth = 1;
  g.setLineDash([4, 4]);
  g.beginPath();
  [...scene.started, ...(scene.cursor ? [scene.cursor] : [])].forEach((p, i) => {
    const at = scene.view.toScreen(p);
    if (i === 0) g.moveTo(...at);
    else g.lineTo(...at);
  });
  g.stroke();
  g.setLineDash([]);
  g.fillStyle = colors.handle;
  for (const p of scene.started) {
    const [x, y] = scene.view.toScreen(p);
    g.fillRect(x - 3.5, y - 3.5, 7, 7);
  }
}

function paintCrosshair(g: CanvasRenderingContext2D, { crosshair, cursor, view }: Scene, colors: Palette): void {
  if (!crosshair || !cursor) return;
  const [x, y] = view.toScreen(cursor);
  g.strokeStyle = colors.handle;
  g.lineWidth = 1;
  g.beginPath();
  for (const [dx, dy] of [[1, 0], [0, 1]] as const) {
    g.moveTo(x - 14 * dx, y - 14 * dy);
    g.lineTo(x + 14 * dx, y + 14 * dy);
  }
  g.stroke();
}

export function paintScene(g: CanvasRenderingContext2D, scene: Scene): void {
  const { state, view } = scene;
  const doc = docOf(state);
  const colors = paletteOf(state);
  g.fillStyle = colors.ground;
  g.fillRect(0, 0, view.width, view.height);
  if (state.looks.grid) paintGrid(g, view, colors);
  paintUnderlay(g, scene);
  const visible = doc.entities.filter((e) => isShown(doc, e));
  paintRegion(g, scene, colors);
  for (const e of visible) if (e.kind === "scan") paintEntity(g, scene, e, colors);
  const away = wipedAway(scene);
  clipped(g, scene, true, () => {
    paintBefore(g, scene, colors);
    for (const e of visible) if (e.id === away) paintEntity(g, scene, e, colors);
  });
  clipped(g, scene, false, () => {
    for (const e of visible) if (e.kind !== "scan" && e.id !== away) paintEntity(g, scene, e, colors);
  });
  paintSymmetry(g, scene, colors);
  for (const id of state.selection) {
    const e = entityOf(doc, id);
    if (!e || !isShown(doc, e) || isHeld(doc, e)) continue;
    paintHandles(g, view, e, colors, scene.hot?.entity === id ? scene.hot.handle : null, jointOf(scene, e));
  }
  if (scene.box && !state.carrying) paintBox(g, view, scene.box, scene.hotPart, colors);
  paintCarrying(g, view, state, colors);
  paintBand(g, view, state.band, colors);
  if (state.stretch) {
    const comb = scene.live.of(state.stretch.entity)?.comb;
    if (comb) paintStretch(g, view, comb, state.stretch, colors.handle);
  }
  if (state.hover) {
    paintHover(g, scene, state.hover, colors);
  }
  paintStarted(g, scene, colors);
  paintCrosshair(g, scene, colors);
  paintWipe(g, scene, colors);
  paintRulers(g, view, colors, doc.unit, scene.cursor ? view.toScreen(scene.cursor) : null);
}
