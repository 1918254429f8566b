import { describe, expect, it } from "vitest";
import { committed, redone, started, undone } from "../../src/model/history.ts";

describe("history", () => {
  it("goes back and forth through every step", () => {
    let h = started("a");
    h = committed(h, "to b", "b");
    h = committed(h, "to c", "c");
    expect(undone(h).now).toBe("b");
    expect(undone(undone(h)).now).toBe("a");
    expect(undone(undone(undone(h))).now).toBe("a");
    expect(redone(undone(h)).now).toBe("c");
    expect(redone(h)).toBe(h);
  });

  it("forgets what was undone once something else is done", () => {
    const h = committed(undone(committed(started("a"), "to b", "b")), "to c", "c");
    expect(h.future).toEqual([]);
    expect(undone(h).now).toBe("a");
  });

  it("remembers no step that changes nothing", () => {
    const h = started("a");
    expect(committed(h, "nothing", "a")).toBe(h);
  });

  it("does not grow without end", () => {
    let h = started(0);
    for (let i = 1; i <= 2000; ++i) h = committed(h, "step", i);
    expect(h.past.length).toBe(500);
    expect(undone(h).now).toBe(1999);
  });
});
