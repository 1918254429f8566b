/** Where surfaces meet, as the operation judges it: asked once for every two that come near each other. */
import type { Surface, SurfaceContinuityResult } from "../../generated/operations.ts";
import type { Client } from "../api/client.ts";

export interface SurfaceJoint {
  order: NonNullable<SurfaceContinuityResult["order"]>;
  points: readonly (readonly number[])[];
}

type Box = readonly (readonly [number, number])[];

const kMostSurfaces = 60; // more meet in more places than an eye takes in

function boxOf({ points }: Surface): Box {
  const all = points.flat() as number[][];
  return [0, 1, 2].map((axis) => {
    const values = all.map((p) => p[axis] ?? 0);
    return [Math.min(...values), Math.max(...values)] as const;
  });
}

/** Boxes no farther apart than a thousandth of the larger one's side: what is farther does not meet. */
function near(a: Box, b: Box): boolean {
  const sizes = [...a, ...b].map(([low, high]) => high - low);
  const slack = 1e-3 * Math.max(...sizes);
  return a.every(([low, high], axis) => {
    const [l, h] = b[axis] as readonly [number, number];
    return low <= h + slack && l <= high + slack;
  });
}

export class SurfaceJoints {
  private readonly known = new WeakMap<Surface, WeakMap<Surface, SurfaceJoint | null>>();
  onCame: () => void = () => {};

  constructor(private readonly client: Client) {}

  /** Those known by now. */
  of(surfaces: readonly Surface[]): SurfaceJoint[] {
    if (surfaces.length > kMostSurfaces) return [];
    const boxes = surfaces.map(boxOf);
    return surfaces.flatMap((a, i) => surfaces.slice(i + 1).flatMap((b, k) =>
      (near(boxes[i] as Box, boxes[i + 1 + k] as Box) ? this.between(a, b) ?? [] : [])));
  }

  private between(a: Surface, b: Surface): SurfaceJoint | null {
    const others = this.known.get(a) ?? new WeakMap<Surface, SurfaceJoint | null>();
    this.known.set(a, others);
    const known = others.get(b);
    if (known !== undefined) return known;
    others.set(b, null);
    void this.client.long<SurfaceContinuityResult>("surface.continuity", { surfaces: [a, b] }, () => {}).answer.then((answer) => {
      if (!answer.ok) return;
      const { order = "none", along = [] } = answer.result;
      const points = along.flatMap((place) => (place.position ? [place.position] : []));
      if (order === "none") return; // near each other, but not joined
      others.set(b, { order, points });
      this.onCame();
    });
    return null;
  }
}
