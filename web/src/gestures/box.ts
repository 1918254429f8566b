/** The box about what is chosen, with places to turn and scale it by, on the screen. */
import { entityOf, handlesOf, isHeld, isMovable, isShown, type Pixel, type Point } from "../model/document.ts";
import type { Live } from "../model/live.ts";
import type { Store } from "../model/state.ts";
import { boxOf, type Viewport } from "../view/viewport.ts";

const kMargin = 12; // pixels about the curves, so that their own ends stay free
const kStem = 26; // pixels from the box to the place it is turned by
const kLeastArm = 16; // pixels from the pivot: a corner nearer than that scales nothing

export interface TurnBox {
  /** in the model, counter-clockwise from the lower left */
  corners: readonly Point[];
  pivot: Point;
}

interface Seen {
  store: Store;
  live: Live;
  view: Viewport;
}

/** The things that move when a hand moves what is chosen. */
export function movable(store: Store): number[] {
  const doc = store.doc;
  return store.state.selection.filter((id) => {
    const e = entityOf(doc, id);
    return e && isMovable(e) && isShown(doc, e) && !isHeld(doc, e);
  });
}

/** What is drawn of the things, and what they are held by. */
export function placesOf({ store, live }: Seen, ids: readonly number[]): Point[] {
  return ids.flatMap((id) => {
    const e = entityOf(store.doc, id);
    return [...((live.of(id)?.comb.points ?? []) as Point[]), ...(e && e.kind !== "mirror" ? handlesOf(e) : [])];
  });
}

export function middleOf(points: readonly Point[]): Point {
  const box = boxOf(points);
  return box ? [(box.low[0] + box.high[0]) / 2, (box.low[1] + box.high[1]) / 2] : [0, 0];
}

/** Null where handles of its own say all there is, or nothing can be moved. */
export function turnBox(seen: Seen): TurnBox | null {
  const { store, view } = seen;
  const { state } = store;
  const ids = movable(store);
  const ofFile = ids.some((id) => {
    const e = entityOf(store.doc, id);
    return e?.kind === "fixed" && !e.held;
  });
  if (!state.looks.box || state.tool !== "select" || !(ofFile || ids.length > 1)) return null;
  const points = placesOf(seen, ids);
  const box = boxOf(points);
  if (!box) return null;
  const away = kMargin / view.scale;
  const [left, low, right, high] = [box.low[0] - away, box.low[1] - away, box.high[0] + away, box.high[1] + away];
  const own = state.pivot && state.pivot.of === state.selection ? state.pivot.at : null;
  return { corners: [[left, low], [right, low], [right, high], [left, high]], pivot: own ?? middleOf(points) };
}

/** On the screen: a stem upwards from the middle of the upper edge. */
export function turnerOf(view: Viewport, corners: readonly Point[]): { foot: Pixel; at: Pixel } {
  const [a, b] = [view.toScreen(corners[3] as Point), view.toScreen(corners[2] as Point)];
  const foot: Pixel = [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
  const along: Pixel = [b[0] - a[0], b[1] - a[1]];
  const length = Math.hypot(...along) || 1;
  return { foot, at: [foot[0] + (along[1] / length) * kStem, foot[1] - (along[0] / length) * kStem] };
}

export type BoxPart = "turn" | "pivot" | 0 | 1 | 2 | 3;

export function boxPartAt(view: Viewport, box: TurnBox, at: Pixel, reach: number): BoxPart | null {
  const near = (p: Pixel) => Math.hypot(p[0] - at[0], p[1] - at[1]) <= reach;
  if (near(turnerOf(view, box.corners).at)) return "turn";
  const pivot = view.toScreen(box.pivot);
  for (const i of [0, 1, 2, 3] as const) {
    const corner = view.toScreen(box.corners[i] as Point);
    if (near(corner) && Math.hypot(corner[0] - pivot[0], corner[1] - pivot[1]) > kLeastArm) return i;
  }
  return near(pivot) ? "pivot" : null;
}
