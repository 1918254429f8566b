/** Which operation makes a thing's curve, and what it is asked: the page works out nothing itself. */
import type { Curve } from "../../generated/operations.ts";
import type { Entity, Point } from "./document.ts";

export interface Recipe {
  op: string;
  request: Record<string, unknown>;
}

/** How a direction is told where an operation wants an angle. */
const heading = (from: Point, to: Point): number => Math.atan2(to[1] - from[1], to[0] - from[0]);

/** Null where there is nothing to ask yet, or nothing to ask at all. */
export function recipeOf(e: Entity, curveOf: (id: number) => Curve | undefined): Recipe | null {
  switch (e.kind) {
    case "segment":
      return { op: "lac.segment", request: { points: e.points, alpha: e.alpha } };
    case "compound":
      return { op: "lac.compound", request: { points: e.points, alpha: e.alpha, ratio: e.ratio } };
    case "quasi":
      return {
        op: "lac.quasi",
        request: { points: e.points, alpha: e.alpha, form: e.form, degree: e.degree },
      };
    case "s-shape": {
      const [start, out, back, end] = e.points;
      const directions = [heading(start, out), heading(back, end)];
      return { op: "lac.hermite", request: { start, end, directions, alpha: e.alpha } };
    }
    case "spline":
      if (e.points.length < (e.closed ? 3 : 2)) return null;
      return { op: "lac.spline", request: { points: e.points, alpha: e.alpha, closed: e.closed } };
    case "blend": {
      const curves = [curveOf(e.of[0]), curveOf(e.of[1])];
      if (!curves[0] || !curves[1]) return null;
      return {
        op: "lac.blend",
        request: { curves, at: e.ends.map((end) => (end === "start" ? 0 : 1)), order: e.order, alpha: e.alpha },
      };
    }
    case "mirror": {
      const curve = curveOf(e.of);
      return curve ? { op: "curve.mirror", request: { curve, point: e.axis[0], direction: heading(...e.axis) } } : null;
    }
    case "sliding":
      return {
        op: "curve.edit",
        request: { curve: e.given, hold: e.hold, amount: e.amount, ...(e.target ? { target: e.target } : {}) },
      };
    case "fixed":
      return e.placed ? { op: "curve.transform", request: { curve: e.curve, ...e.placed } }
        : { op: "curve.show", request: { curve: e.curve } };
    case "faired":
      return { op: "curve.show", request: { curve: e.curve } };
    case "scan":
    case "surface":
      return null;
  }
}
