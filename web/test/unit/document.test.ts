import { describe, expect, it } from "vitest";
import {
  added, emptyDoc, type Entity, handlesOf, lineOf, moved, type Point, type Scan, type Spline, toggledStray, withHandle, without, withoutPoint,
  withPoint,
} from "../../src/model/document.ts";
import { recipeOf } from "../../src/model/recipe.ts";
import { isKept, ownDocument } from "../../src/model/autosave.ts";

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
    expect(handlesOf(moved(segment, [1, -1]))).toEqual([[1, -1], [3, -1], [4, 0]]);
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
