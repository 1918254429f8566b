/** The control points of a curve of a file, as one list: where curves of a path meet, one point for both. */
import type { Curve } from "../../generated/operations.ts";
import type { Point } from "./document.ts";

const kMost = 200; // more are no handles any more

type Held = { curve: number; point: number }[];

const membersOf = (curve: Curve): Curve[] => (curve.type === "path" ? (curve["curves"] as Curve[]) : [curve]);
const isHeld = (c: Curve): boolean => ["bezier", "bspline", "polyline"].includes(c.type);
const pointsOf = (c: Curve): Point[] => c["points"] as Point[];
const same = (a: Point | undefined, b: Point | undefined): boolean => a !== undefined && b !== undefined && a[0] === b[0] && a[1] === b[1];

/** What each handle holds; empty where a curve is not held by points, or by too many. */
function holds(curve: Curve): Held[] {
  const members = membersOf(curve);
  if (!members.every(isHeld)) return [];
  const all: Held[] = [];
  members.forEach((c, k) => pointsOf(c).forEach((p, i) => {
    const last = all.at(-1);
    const before = i === 0 && k > 0 ? pointsOf(members[k - 1] as Curve).at(-1) : undefined;
    if (last && same(before, p)) last.push({ curve: k, point: i });
    else all.push([{ curve: k, point: i }]);
  }));
  const first = pointsOf(members[0] as Curve)[0];
  const end = pointsOf(members.at(-1) as Curve).at(-1);
  if (all.length > 2 && same(first, end)) all[0]?.push(...(all.pop() ?? [])); // closed
  return all.length <= kMost ? all : [];
}

const at = (curve: Curve, held: Held): Point => {
  const [{ curve: k, point: i }] = held as [Held[number]];
  return pointsOf(membersOf(curve)[k] as Curve)[i] as Point;
};

export const controlsOf = (curve: Curve): Point[] => holds(curve).map((held) => at(curve, held));

/** The curve with one of them elsewhere. */
export function withControl(curve: Curve, index: number, to: Point): Curve {
  const held = holds(curve)[index] ?? [];
  const members = membersOf(curve).map((c, k) => {
    const moved = held.filter((place) => place.curve === k).map((place) => place.point);
    return moved.length === 0 ? c : { ...c, points: pointsOf(c).map((p, i) => (moved.includes(i) ? to : p)) };
  });
  return curve.type === "path" ? { ...curve, curves: members } : members[0] as Curve;
}
