/**
 * Where a hand has put a curve of a file, told as curve.transform is asked for it. The page moves
 * points, for handles and for what is drawn until the answer comes; the curve is moved by the operation.
 */
import type { Comb, Point } from "./document.ts";

/** Turned (counter-clockwise, radians) and scaled about a point, then shifted. */
export interface Placement {
  about: Point;
  turn: number;
  scale: number;
  shift: Point;
}

export const still = (about: Point): Placement => ({ about, turn: 0, scale: 1, shift: [0, 0] });

export const isStill = (m: Placement): boolean => m.turn === 0 && m.scale === 1 && m.shift[0] === 0 && m.shift[1] === 0;

export const shiftedBy = (by: Point): Placement => ({ ...still([0, 0]), shift: by });

export function carried({ about, turn, scale, shift }: Placement, [x, y]: Point): Point {
  const [c, s] = [scale * Math.cos(turn), scale * Math.sin(turn)];
  const [dx, dy] = [x - about[0], y - about[1]];
  return [about[0] + c * dx - s * dy + shift[0], about[1] + s * dx + c * dy + shift[1]];
}

/** Where the point was before it was carried there. */
export function before(m: Placement, p: Point): Point {
  const { about, turn, scale, shift } = m;
  return carried({ about, turn: -turn, scale: 1 / scale, shift: [0, 0] }, [p[0] - shift[0], p[1] - shift[1]]);
}

/** The one after the other, told about the point of the first. */
export function followedBy(first: Placement, next: Placement): Placement {
  const { about } = first;
  const to = carried(next, carried(first, about));
  return { about, turn: first.turn + next.turn, scale: first.scale * next.scale, shift: [to[0] - about[0], to[1] - about[1]] };
}

/** What leads from one placement of a thing to another of the same thing. */
function between(from: Placement, to: Placement): Placement {
  const [start, end] = [carried(from, from.about), carried(to, from.about)];
  return { about: start, turn: to.turn - from.turn, scale: to.scale / from.scale, shift: [end[0] - start[0], end[1] - start[1]] };
}

/** What is drawn of a curve at one placement, at another. */
export function carriedComb(comb: Comb, from: Placement, to: Placement): Comb {
  const by = between(from, to);
  const at = (p: number[]): Point => carried(by, p as Point);
  const turned = carried.bind(null, { ...still([0, 0]), turn: by.turn });
  const { graphs } = comb;
  const moved: Comb = { ...comb, points: comb.points.map(at) };
  if (by.turn !== 0) moved.normals = comb.normals.map((n) => turned(n as Point));
  if (by.scale !== 1) {
    moved.length = comb.length * by.scale;
    moved.arc_length = comb.arc_length.map((s) => s * by.scale);
    moved.curvature = comb.curvature.map((k) => k / by.scale);
  }
  if (graphs)
    moved.graphs = {
      ...graphs,
      ...(graphs.centers && { centers: graphs.centers.map(at) }),
      ...(graphs.events && { events: graphs.events.map((e) => ({ ...e, ...(e.point && { point: at(e.point) }) })) }),
    };
  return moved;
}
