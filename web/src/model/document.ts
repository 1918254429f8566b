/** What is being worked on: plain values, never changed in place. */
import type {
  Curve, CurveCondition, CurveEditRequest, FairedPiece, FairFigures, FairRequest, FoundSymmetry, KeyLine, SampledComb, Surface,
  SurfaceEditRequest,
} from "../../generated/operations.ts";
import { controlsOf, withControl } from "./controls.ts";
import { before, carried, followedBy, type Placement, still } from "./placement.ts";

/** A coordinate in one space, which no variable of another takes. */
type In<Space extends string> = number & { readonly space?: Space };
/** In the model: x to the right, y up, in the document's unit. */
export type Point = [x: In<"model">, y: In<"model">];
/** On the canvas: in pixels from its upper left corner, y down. */
export type Pixel = [x: In<"canvas">, y: In<"canvas">];

interface Common {
  id: number;
  name: string;
  layer: string;
  visible: boolean;
  locked: boolean;
  color: string; // "" : by the theme
}

export interface Segment extends Common {
  kind: "segment";
  points: [Point, Point, Point];
  alpha: number;
}
export interface Compound extends Common {
  kind: "compound";
  points: [Point, Point, Point];
  alpha: [number, number];
  ratio: number;
}
export interface SShape extends Common {
  kind: "s-shape";
  /** start, a point its tangent leads to, one the end's tangent comes from, end */
  points: [Point, Point, Point, Point];
  alpha: number;
}
export interface Quasi extends Common {
  kind: "quasi";
  points: [Point, Point, Point];
  alpha: number;
  form: string;
  degree: number;
}
export interface Spline extends Common {
  kind: "spline";
  points: Point[];
  alpha: number;
  closed: boolean;
}
export interface Blend extends Common {
  kind: "blend";
  of: [number, number];
  ends: [End, End];
  order: "G1" | "G2" | "G3";
  alpha: number;
}
export interface Mirror extends Common {
  kind: "mirror";
  of: number;
  axis: [Point, Point];
}
/** A curve as a file or an operation gave it. */
export interface Fixed extends Common {
  kind: "fixed";
  curve: Curve;
  /** where a hand has put it since */
  placed?: Placement;
  /** its control points are handles */
  held?: boolean;
  /** what it was made of, to be looked at beside it */
  before?: Curve;
  /** of a traced line: the drawn strokes it stands for, by their numbers from 0 */
  members?: readonly number[];
}
/** A curve on its way to Class A: the operation slides it whenever the hand moves its place. */
export interface Sliding extends Common {
  kind: "sliding";
  given: Curve;
  /** place of the plane; null: the minimum-energy point */
  target: { alpha: number; s: number } | null;
  hold: NonNullable<CurveEditRequest["hold"]>;
  amount: number;
}
/** Measured points. */
export interface Scan extends Common {
  kind: "scan";
  line: KeyLine;
  /** points left out by hand, by their places in the line */
  strays?: readonly number[];
}
/** What fairing made of measured points or of a curve. */
export interface Faired extends Common {
  kind: "faired";
  curve: Curve;
  of: number;
  told: FairTold;
}
export interface SurfaceEntity extends Common {
  kind: "surface";
  surface: Surface;
  /** before editing, and what was asked for */
  given?: Surface;
  wishes?: SurfaceWishes;
}

export interface SurfaceWishes {
  keep: NonNullable<SurfaceEditRequest["keep"]>;
  amount: number;
  conditions: readonly CurveCondition[];
}

export type End = "start" | "end";

/** Of the answer of `fair`, what the page shows. */
export interface FairTold {
  request: FairRequest;
  spline: Curve;
  bic: number | null;
  /** stretches of monotone curvature that the spline has */
  monotone: number;
  pieces: FairedPiece[];
  length: number;
  noise: number;
  tolerance: number;
  max: number;
  rms: number;
  within: boolean;
  cancelled: boolean;
  fairness: FairFigures | null;
  /** fastest that curvature changes; null: without bound */
  rate: number | null;
  symmetry: FoundSymmetry | null;
  notes: string[];
}

export type Entity =
  | Segment | Compound | SShape | Quasi | Spline | Blend | Mirror | Fixed | Sliding | Scan | Faired | SurfaceEntity;
export type Kind = Entity["kind"];

export interface Layer {
  name: string;
  visible: boolean;
  locked: boolean;
}

export interface Doc {
  unit: string;
  next: number;
  layers: Layer[];
  entities: Entity[];
}

export type Comb = Required<Omit<SampledComb, "graphs">> & Pick<SampledComb, "graphs">;

export const emptyDoc = (): Doc => ({
  unit: "mm",
  next: 1,
  layers: [{ name: "Curves", visible: true, locked: false }],
  entities: [],
});

export const entityOf = (doc: Doc, id: number | null): Entity | undefined =>
  id === null ? undefined : doc.entities.find((e) => e.id === id);

export function withEntity(doc: Doc, entity: Entity): Doc {
  return { ...doc, entities: doc.entities.map((e) => (e.id === entity.id ? entity : e)) };
}

/** A thing without its number and standing, as tools and files make it. */
export type Fresh<E extends Entity = Entity> = E extends Entity
  ? Omit<E, "id" | "layer" | "visible" | "locked" | "color"> & Partial<Common>
  : never;

export function added(doc: Doc, fresh: Fresh): { doc: Doc; id: number } {
  const id = doc.next;
  const layer = fresh.layer || doc.layers[0]?.name || "Curves";
  const entity = { visible: true, locked: false, color: "", ...fresh, layer, id } as Entity;
  const layers = doc.layers.some((l) => l.name === layer)
    ? doc.layers
    : [...doc.layers, { name: layer, visible: true, locked: false }];
  return { doc: { ...doc, layers, next: id + 1, entities: [...doc.entities, entity] }, id };
}

/** Without the things, and without what was made of them. */
export function without(doc: Doc, ids: readonly number[]): Doc {
  const gone = new Set(ids);
  const needs = (e: Entity): number[] =>
    e.kind === "blend" ? e.of : e.kind === "mirror" ? [e.of] : [];
  for (let before = -1; before !== gone.size;) {
    before = gone.size;
    for (const e of doc.entities) if (needs(e).some((id) => gone.has(id))) gone.add(e.id);
  }
  return { ...doc, entities: doc.entities.filter((e) => !gone.has(e.id)) };
}

export function toggledStray(e: Scan, index: number): Scan {
  const strays = e.strays ?? [];
  const others = strays.filter((i) => i !== index);
  return { ...e, strays: others.length < strays.length ? others : [...strays, index].sort((a, b) => a - b) };
}

/** What is measured without the points left out. */
export function lineOf(e: Scan): KeyLine {
  const out = new Set(e.strays ?? []);
  if (out.size === 0) return e.line;
  const stays = (_: unknown, i: number) => !out.has(i);
  const places = e.line.points.map((_, i) => i).filter((i) => !out.has(i));
  const { weights, sources, corners } = e.line;
  return {
    ...e.line,
    points: e.line.points.filter(stays),
    ...(weights && { weights: weights.filter(stays) }),
    ...(sources && { sources: sources.filter(stays) }),
    ...(corners && { corners: corners.flatMap((i) => (out.has(i) ? [] : [places.indexOf(i)])) }),
  };
}

const layerOf = (doc: Doc, e: Entity) => doc.layers.find((l) => l.name === e.layer);
export const isShown = (doc: Doc, e: Entity): boolean => e.visible && layerOf(doc, e)?.visible !== false;
export const isHeld = (doc: Doc, e: Entity): boolean => e.locked || layerOf(doc, e)?.locked === true;

/** The points a hand can take hold of. */
export function handlesOf(e: Entity): readonly Point[] {
  switch (e.kind) {
    case "segment":
    case "compound":
    case "quasi":
    case "s-shape":
    case "spline":
      return e.points;
    case "mirror":
      return e.axis;
    case "fixed":
      return e.held ? controlsOf(e.curve).map((p) => (e.placed ? carried(e.placed, p) : p)) : [];
    default:
      return [];
  }
}

export function withHandle(e: Entity, index: number, at: Point): Entity {
  const put = <T extends Point[]>(points: T): T => points.map((p, i) => (i === index ? at : p)) as T;
  switch (e.kind) {
    case "segment":
    case "compound":
    case "quasi":
    case "s-shape":
    case "spline":
      return { ...e, points: put(e.points) } as Entity;
    case "mirror":
      return { ...e, axis: put(e.axis) };
    case "fixed":
      return { ...e, curve: withControl(e.curve, index, e.placed ? before(e.placed, at) : at) };
    default:
      return e;
  }
}

/** A spline that passes one point more, before the one of that index. */
export const withPoint = (e: Spline, index: number, at: Point): Spline =>
  ({ ...e, points: [...e.points.slice(0, index), at, ...e.points.slice(index)] });

/** A spline without the point; itself where too few would be left. */
export function withoutPoint(e: Spline, index: number): Spline {
  const points = e.points.filter((_, i) => i !== index);
  return points.length < (e.closed ? 3 : 2) ? e : { ...e, points };
}

/** Whether a hand can move the whole of it. */
export const isMovable = (e: Entity): boolean => e.kind === "fixed" || handlesOf(e).length > 0;

/** All of it moved, turned, scaled; things made of others go with them. A curve of a file is placed about its middle. */
export function moved(e: Entity, by: Placement, middle: Point): Entity {
  if (e.kind === "fixed") return { ...e, placed: followedBy(e.placed ?? still(middle), by) };
  return handlesOf(e).reduce<Entity>((to, p, i) => withHandle(to, i, carried(by, p)), e);
}

/** The curve of a file as something else made it: where it was put is in the curve now. */
export function recast(e: Fixed, curve: Curve, before: Curve): Fixed {
  const { placed: _placed, ...rest } = e;
  return { ...rest, curve, before };
}
