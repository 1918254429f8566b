import { describe, expect, it } from "vitest";
import type { Comb, Point } from "../../src/model/document.ts";
import { nearestIndex, nearestSample } from "../../src/view/nearest.ts";
import { label, measure, readable, roundStep, ticks } from "../../src/view/ticks.ts";
import { boxOf, Viewport } from "../../src/view/viewport.ts";

describe("viewport", () => {
  it("goes to the screen and back", () => {
    const view = new Viewport();
    view.scale = 3;
    view.center = [10, -4];
    expect(view.toScreen([10, -4])).toEqual([400, 300]);
    expect(view.toScreen([11, -3])).toEqual([403, 297]);
    const [x, y] = view.toModel(view.toScreen([7.25, 9.5]));
    expect(x).toBeCloseTo(7.25, 12);
    expect(y).toBeCloseTo(9.5, 12);
  });

  it("takes no place of the canvas for one of the model", () => {
    const view = new Viewport();
    const place: Point = [1, 2];
    const pixel = view.toScreen(place);
    // @ts-expect-error: seen by the compiler, not here
    view.toScreen(pixel);
    // @ts-expect-error
    view.zoomAt(place, 2);
    // @ts-expect-error
    view.center = [pixel[0], place[1]];
  });

  it("zooms about the place under the cursor", () => {
    const view = new Viewport();
    const under = view.toModel([120, 77]);
    view.zoomAt([120, 77], 2.5);
    const now = view.toModel([120, 77]);
    expect(now[0]).toBeCloseTo(under[0], 9);
    expect(now[1]).toBeCloseTo(under[1], 9);
    expect(view.scale).toBe(2.5);
  });

  it("fits a box between its margins", () => {
    const view = new Viewport();
    view.fit({ low: [0, 0], high: [100, 10] }, { left: 100, top: 0, right: 0, bottom: 50 });
    expect(view.toScreen([0, 5])[0]).toBeCloseTo(100, 9);
    expect(view.toScreen([100, 5])[0]).toBeCloseTo(800, 9);
    expect(view.toScreen([0, 5])[1]).toBeCloseTo(275, 9);
  });

  it("has no box around nothing", () => expect(boxOf([])).toBeNull());
});

describe("a sentence", () => {
  it("has no more digits than one reads", () => {
    expect(readable("slope 1.6 turning by 0.457550099 rad, -1.2092487e-7 off")).toBe("slope 1.6 turning by 0.4576 rad, \u22121.209e-7 off");
    expect(readable("no more than 3 of 12.25 mm")).toBe("no more than 3 of 12.25 mm");
  });
});

describe("ticks", () => {
  it("end where steps are lost in rounding", () => {
    expect(ticks(1e17, 1e17 + 64, 1)).toEqual([]);
    expect(ticks(0, 1, NaN)).toEqual([]);
    expect(ticks(0, 1, 1e-9)).toEqual([]);
  });
  it("takes steps of 1, 2 and 5", () => {
    expect([0.9, 1, 1.1, 2.5, 6, 0.03].map(roundStep)).toEqual([1, 1, 2, 5, 10, 0.05].map((v) => expect.closeTo(v, 12)));
    expect(ticks(-1, 1, 0.5)).toEqual([-1, -0.5, 0, 0.5, 1].map((v) => expect.closeTo(v, 12)));
  });

  it("writes numbers as they are read", () => {
    expect(label(0.30000000000000004, 0.1)).toBe("0.3");
    expect(label(-20, 10)).toBe("\u221220");
    expect(measure(1234.567)).toBe("1235");
    expect(measure(0.0123456)).toBe("0.01235");
    expect(measure(Infinity)).toBe("\u221e");
  });
});

describe("nearest", () => {
  it("finds the index of a value", () => {
    expect(nearestIndex([0, 1, 1, 4], 2.4)).toBe(2);
    expect(nearestIndex([0, 1, 1, 4], 2.6)).toBe(3);
    expect(nearestIndex([0, 1], -5)).toBe(0);
  });

  it("measures to the drawn line, not to its samples alone", () => {
    const view = new Viewport();
    const points: Point[] = [[0, 0], [100, 0], [200, 0]];
    const comb = { points } as unknown as Comb;
    const near = nearestSample(view, comb, view.toScreen([60, 3]));
    expect(near?.distance).toBeCloseTo(3, 9);
    expect(near?.sample).toBe(1);
  });
});
