import { describe, expect, it } from "vitest";
import {
  added, emptyDoc, type Entity, handlesOf, lineOf, moved, type Point, type Scan, type Spline, toggledStray, withHandle, without, withoutPoint,
  withPoint,
} from "../../src/model/document.ts";
import { recipeOf } from "../../src/model/recipe.ts";
import { carried, carriedComb, followedBy, type Placement, shiftedBy, still } from "../../src/model/placement.ts";
import { controlsOf, withControl } from "../../src/model/controls.ts";
import { crosses, taken } from "../../src/gestures/band.ts";
import { isKept, ownDocument } from "../../src/model/autosave.ts";
import { noticeOf, withFile } from "../../src/model/open.ts";

const points: [Point, Point, Point] = [[0, 0], [2, 0], [3, 1]];

function two() {
  const one = added(emptyDoc(), { kind: "segment", name: "a", points, alpha: -1 });
  return added(one.doc, { kind: "mirror", name: "b", of: one.id, axis: [[0, 0], [0, 1]] });
}

describe("a spline's points", () => {
  const spline = { kind: "spline", points: [[0, 0], [1, 1], [2, 0]], closed: false } as unknown as Spline;
  it("come and go, but not the last two", () => {
    expect(withPoint(spline, 1, [0.5, 0.7]).points).toEqual([[0, 0], [0.5, 0.7], [1, 1], [2, 0]]);
    expect(withoutPoint(withPoint(spline, 1, [0.5, 0.7]), 1)).toEqual(spline);
    const two = withoutPoint(spline, 0);
    expect(two.points).toEqual([[1, 1], [2, 0]]);
    expect(withoutPoint(two, 1)).toBe(two);
    expect(withoutPoint({ ...spline, closed: true }, 1).points).toHaveLength(3);
  });
});

describe("document", () => {
  it("numbers things and never twice", () => {
    const { doc, id } = two();
    expect(doc.entities.map((e) => e.id)).toEqual([1, 2]);
    expect(added(without(doc, [id]), { kind: "segment", name: "c", points, alpha: 0 }).id).toBe(3);
  });

  it("takes along what was made of a thing that goes", () => {
    expect(without(two().doc, [1]).entities).toEqual([]);
    expect(without(two().doc, [2]).entities.length).toBe(1);
  });

  it("leaves points out, and what belongs to them", () => {
    const line = { points: [[0, 0], [1, 9], [2, 0], [3, 0]] as Point[], weights: [1, 2, 3, 4], corners: [1, 2], closed: false };
    const scan = added(emptyDoc(), { kind: "scan", name: "s", line }).doc.entities[0] as Scan;
    const without = toggledStray(scan, 1);
    expect(lineOf(without)).toEqual({ points: [[0, 0], [2, 0], [3, 0]], weights: [1, 3, 4], corners: [1], closed: false });
    expect(lineOf(toggledStray(without, 1))).toEqual(line);
  });

  it("moves one handle, or all of them", () => {
    const [segment] = two().doc.entities;
    if (!segment) throw new Error();
    expect(handlesOf(withHandle(segment, 1, [5, 5]))).toEqual([[0, 0], [5, 5], [3, 1]]);
    expect(handlesOf(moved(segment, shiftedBy([1, -1]), [0, 0]))).toEqual([[1, -1], [3, -1], [4, 0]]);
    expect(handlesOf(segment)).toEqual(points);
  });

  it("asks the operation that makes a thing", () => {
    const [segment, mirror] = two().doc.entities;
    if (!segment || !mirror) throw new Error();
    expect(recipeOf(segment, () => undefined)).toEqual({ op: "lac.segment", request: { points, alpha: -1 } });
    expect(recipeOf(mirror, () => undefined)).toBeNull();
    const curve = { type: "bezier", points: [] };
    expect(recipeOf(mirror, () => curve)).toEqual({
      op: "curve.mirror", request: { curve, point: [0, 0], direction: Math.PI / 2 },
    });
  });

  it("places a curve of a file by the operation, however often it was moved", () => {
    const curve = { type: "bezier", points: [] };
    const fixed = added(emptyDoc(), { kind: "fixed", name: "f", curve }).doc.entities[0] as Entity;
    expect(recipeOf(fixed, () => undefined)).toEqual({ op: "curve.show", request: { curve } });
    const turned = moved(fixed, { about: [0, 0], turn: Math.PI / 2, scale: 2, shift: [0, 0] }, [3, 1]);
    const shifted = moved(turned, shiftedBy([5, 6]), [99, 99]);
    const { op, request } = recipeOf(shifted, () => undefined) ?? {};
    const { about, turn, scale, shift } = request as unknown as Placement;
    expect([op, request?.["curve"], about, turn, scale]).toEqual(["curve.transform", curve, [3, 1], Math.PI / 2, 2]);
    // 2i (3 + i) = -2 + 6i, less 3 + i, and 5 + 6i on top
    expect(shift[0]).toBeCloseTo(0, 12);
    expect(shift[1]).toBeCloseTo(11, 12);
  });

  it("slides a curve by the operation, to the place or to least energy", () => {
    const given = { type: "bezier", points: [] };
    const sliding = { kind: "sliding", name: "s", given, hold: "ends", amount: 0.5 } as const;
    const made = (target: { alpha: number; s: number } | null) =>
      recipeOf(added(emptyDoc(), { ...sliding, target }).doc.entities[0] as Entity, () => undefined);
    expect(made(null)).toEqual({ op: "curve.edit", request: { curve: given, hold: "ends", amount: 0.5 } });
    expect(made({ alpha: 0.3, s: 1.2 })?.request["target"]).toEqual({ alpha: 0.3, s: 1.2 });
  });

  it("knows its own file from others", async () => {
    const file = (name: string, text: string) => Object.assign(new Blob([text]), { name });
    const own = JSON.stringify({ format: "keyline-studio", version: 1, saved: 0, files: [], doc: two().doc });
    expect((await ownDocument(file("a.keyline.json", own)))?.doc.entities.length).toBe(2);
    for (const other of [file("a.json", '{"type":"bezier"}'), file("a.json", "{"), file("a.csv", own)])
      expect(await ownDocument(other)).toBeNull();
  });

  it("takes back only what it kept itself", () => {
    expect(isKept({ format: "keyline-studio", version: 1, saved: 0, files: [], doc: emptyDoc() })).toBe(true);
    for (const other of [null, 3, {}, { format: "keyline-studio", version: 2 }, { format: "x", doc: emptyDoc() }])
      expect(isKept(other)).toBe(false);
  });
});

describe("a placement", () => {
  const first: Placement = { about: [2, -1], turn: 0.7, scale: 1.5, shift: [3, 4] };
  const next: Placement = { about: [-5, 8], turn: -2.1, scale: 0.4, shift: [-1, 0.5] };
  const near = (a: Point, b: Point) => expect(Math.hypot(a[0] - b[0], a[1] - b[1])).toBeLessThan(1e-12);

  it("is a turn, a factor and a shift", () => {
    near(carried(first, [2, -1]), [5, 3]);
    near(carried({ ...still([1, 1]), turn: Math.PI / 2 }, [3, 1]), [1, 3]);
    near(carried({ ...still([1, 1]), scale: 3 }, [3, 2]), [7, 4]);
  });

  it("follows another as one", () => {
    for (const p of [[0, 0], [1, 7], [-3, 2]] as Point[]) near(carried(followedBy(first, next), p), carried(next, carried(first, p)));
    expect(followedBy(first, next).about).toEqual(first.about);
  });

  it("carries what is drawn until the answer comes", () => {
    // a circle of radius 2 at its lowest place, and what becomes of it
    const comb = {
      length: 4, points: [[0, 0]] as Point[], normals: [[0, 1]] as Point[], arc_length: [4], curvature: [0.5], joints: [],
      graphs: { centers: [[0, 2]], events: [{ point: [0, 0] as Point }] },
    };
    const at = carriedComb(comb, still([0, 0]), { about: [0, 0], turn: Math.PI / 2, scale: 3, shift: [10, 0] });
    near(at.points[0] as Point, [10, 0]);
    near(at.normals[0] as Point, [-1, 0]);
    near(at.graphs?.centers?.[0] as Point, [4, 0]);
    near(at.graphs?.events?.[0]?.point as Point, [10, 0]);
    expect([at.length, at.arc_length[0], at.curvature[0]]).toEqual([12, 12, 0.5 / 3]);
    const moved = carriedComb(at, { about: [0, 0], turn: Math.PI / 2, scale: 3, shift: [10, 0] }, next);
    near(moved.points[0] as Point, carried(next, [0, 0]));
  });
});

describe("control points", () => {
  const half: Point[] = [[0, 0], [1, 2], [3, 2], [4, 0]];
  const other: Point[] = [[4, 0], [5, -1], [0, 0]];
  const path = { type: "path", closed: true, curves: [{ type: "bezier", points: half }, { type: "bezier", points: other }] };

  it("are one where curves of a path meet", () => {
    expect(controlsOf(path)).toEqual([[0, 0], [1, 2], [3, 2], [4, 0], [5, -1]]);
    expect(withControl(path, 3, [9, 9])).toEqual({
      ...path, curves: [{ type: "bezier", points: [...half.slice(0, 3), [9, 9]] }, { type: "bezier", points: [[9, 9], ...other.slice(1)] }],
    });
    const ends = withControl(path, 0, [7, 7]) as typeof path;
    expect([ends.curves[0]?.points[0], ends.curves[1]?.points[2]]).toEqual([[7, 7], [7, 7]]);
  });

  it("are none of a curve that has none", () => {
    expect(controlsOf({ type: "log-aesthetic", pieces: [] })).toEqual([]);
    expect(controlsOf({ type: "polyline", points: Array.from({ length: 300 }, (_, i) => [i, 0]) })).toEqual([]);
  });

  it("are moved where they are seen", () => {
    const placed: Placement = { about: [1, 1], turn: 0.8, scale: 2.5, shift: [3, -4] };
    const e = added(emptyDoc(), { kind: "fixed", name: "f", curve: { type: "bezier", points: half }, placed, held: true }).doc.entities[0] as Entity;
    const to = withHandle(e, 1, [20, 30]);
    const seen = handlesOf(to)[1] as Point;
    expect(Math.hypot(seen[0] - 20, seen[1] - 30)).toBeLessThan(1e-12);
    expect(handlesOf(to)[2]).toEqual(carried(placed, half[2] as Point));
  });
});

describe("a band", () => {
  const line: Point[] = [[0, 0], [10, 0]];
  it("takes to the right what lies within it, to the left what it touches", () => {
    expect(taken(line, [-1, -1], [11, 1])).toBe(true);
    expect(taken(line, [-1, -1], [9, 1])).toBe(false);
    expect(taken(line, [9, 1], [-1, -1])).toBe(true);
    expect(taken(line, [6, 1], [4, -1])).toBe(true); // between the drawn places
    expect(taken(line, [6, 2], [4, 1])).toBe(false);
    expect(taken([], [0, 0], [1, 1])).toBe(false);
  });
  it("knows lines that miss a corner", () => {
    const rect = { low: [0, 0] as Point, high: [2, 2] as Point };
    expect(crosses(rect, [-1, 1.5], [1.5, 4])).toBe(false);
    expect(crosses(rect, [-1, 0.5], [1, 2.5])).toBe(true);
    expect(crosses(rect, [1, 1], [1, 1.5])).toBe(true);
    expect(crosses(rect, [3, -1], [3, 3])).toBe(false);
  });
});

describe("a file", () => {
  it("gives the document its unit, or none", () => {
    const read = (unit: string) => withFile(emptyDoc(), "a.csv", { curves: [], surfaces: [], unit, skipped: [], notes: [] });
    expect(read("in").doc.unit).toBe("in");
    expect(read("").doc.unit).toBe("");
  });
});

describe("the notice of a file", () => {
  it("tells both that a mesh was cut and what of it was skipped", () => {
    const both = noticeOf("car.stl", ["line 4: no number"]);
    expect(both.what).toContain("plane of symmetry");
    expect(both.more).toContain("line 4: no number");
    expect(noticeOf("car.stl", []).more).not.toContain("kipped");
    expect(noticeOf("points.csv", ["line 4: no number"])).toEqual({ what: "skipped", more: "line 4: no number" });
    expect(noticeOf("points.csv", []).what).toBe("");
    expect(noticeOf("points.csv", ["a", "b", "c", "d", "e", "f", "g"]).more).toBe("a; b; c; d; e; and 2 more");
  });
});
