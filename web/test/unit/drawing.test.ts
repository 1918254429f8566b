import { describe, expect, it } from "vitest";
import { colorAt, shownRange } from "../../src/surfaces/mesh.ts";
import { contour, evenLevels, type Field } from "../../src/view/contour.ts";

/** x + 2 y over a rectangle: every level line is straight and known. */
const plane: Field = {
  x: [0, 3], y: [1, 3],
  rows: [1, 2, 3].map((y) => [0, 1, 2, 3].map((x) => x + 2 * y)),
};

describe("contours", () => {
  it("lie where the field has the value", () => {
    const lines = contour(plane, 5.5);
    expect(lines.length).toBeGreaterThan(2);
    for (const [x, y] of lines.flat()) expect(x + 2 * y).toBeCloseTo(5.5, 12);
    const ends = lines.flat().map(([x]) => x);
    expect(Math.min(...ends)).toBeCloseTo(0, 12);
    expect(Math.max(...ends)).toBeCloseTo(3, 12);
  });

  it("are none outside of the values, and leave out what has none", () => {
    expect(contour(plane, 99)).toEqual([]);
    expect(contour({ ...plane, rows: [[0, NaN], [1, 2]] }, 0.5)).toEqual([]);
  });

  it("part the values evenly", () => expect(evenLevels({ ...plane, rows: [[4, 1, 3, 2]] }, 3)).toEqual([2, 3, 4]));
});

describe("colours of a surface", () => {
  it("hold the share asked for, zero in the middle", () => {
    const values = new Float32Array([...Array(99).keys()].map((i) => i / 98).concat([1000]));
    expect(shownRange([values], 0.95)[1]).toBeLessThan(2);
    expect(shownRange([values], 1)[1]).toBe(1000);
    expect(shownRange([new Float32Array([-1, 3])], 1)).toEqual([-3, 3]);
    expect(shownRange([new Float32Array([NaN])], 1)).toEqual([-1, 1]);
  });

  it("go from blue to red, ends beyond them", () => {
    const [low, , blue] = colorAt(0);
    const [red, , high] = colorAt(1);
    expect(blue).toBeGreaterThan(low);
    expect(red).toBeGreaterThan(high);
    expect(colorAt(-3)).toEqual(colorAt(0));
    expect(colorAt(7)).toEqual(colorAt(1));
  });
});
