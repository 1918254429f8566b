import type { Browser } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { isQuiet, onPage, openBrowser, Server, settled, visit, type Visit } from "./studio.ts";

interface Made {
  curve: { pieces: { length: number; curvature: [number, number] }[] };
}

describe("drawing", () => {
  const server = new Server();
  let browser: Browser;
  let at: Visit;

  beforeAll(async () => {
    await server.start();
    browser = await openBrowser();
    at = await visit(browser, server.url);
  });
  afterAll(async () => {
    await browser.close();
    await server.remove();
  });

  const points = () => at.page.evaluate(() =>
    (window.keyline.store.doc.entities[0] as { points: [number, number][] }).points);
  const fact = (name: string) => at.page.locator("#measures .fact", { has: at.page.locator("dt", { hasText: name }) })
    .locator("dd").last().textContent();

  it("shows a first curve at once, its comb and graphs", async () => {
    const entry = await at.page.waitForFunction(() => performance.getEntriesByName("first-contentful-paint")[0]?.startTime);
    const paint = await entry.jsonValue() as number;
    console.log(`first contentful paint after ${paint.toFixed(0)} ms`);
    if (isQuiet()) expect(paint).toBeLessThan(1000);
    expect(await at.page.evaluate(() => window.keyline.store.state.looks.combScale)).toBeGreaterThan(0);
  });

  it("follows a dragged handle, with the numbers of the operation", async () => {
    const before = await points();
    const from = await onPage(at.page, before[2] as [number, number]);
    await at.page.mouse.move(from.x, from.y);
    await at.page.mouse.down();
    await at.page.mouse.move(from.x - 60, from.y - 30, { steps: 12 });
    await at.page.mouse.up();
    await settled(at.page);
    const now = await points();
    expect(now[2]).not.toEqual(before[2]);
    expect(now.slice(0, 2)).toEqual(before.slice(0, 2));
    const made = await server.ask<Made>("lac.segment", { points: now, alpha: -1 });
    const piece = made.curve.pieces[0];
    expect(await fact("Length")).toBe(`${piece?.length.toFixed(2)} mm`);
    const shown = await at.page.evaluate(() => window.keyline.live.of(1)?.curve);
    expect(shown).toEqual(made.curve);
  });

  it("takes a slope from the slider's stops and undoes every step", async () => {
    await at.page.click("text=involute");
    await settled(at.page);
    expect(await at.page.inputValue("#alpha-number")).toBe("2.000");
    const alpha = await at.page.evaluate(() => (window.keyline.live.of(1)?.curve.pieces as { alpha: number }[])[0]?.alpha);
    expect(alpha).toBe(2);
    const moved = await points();
    await at.page.keyboard.press("Control+z");
    await at.page.keyboard.press("Control+z");
    await settled(at.page);
    expect(await points()).toEqual([[0, 0], [150, 0], [230, 130]]);
    await at.page.keyboard.press("Control+Shift+z");
    expect(await points()).toEqual(moved);
  });

  it("marks a hovered place in curve and graphs alike", async () => {
    const graph = await at.page.locator(".graph canvas").first().boundingBox();
    if (!graph) throw new Error("no graph");
    await at.page.mouse.move(graph.x + graph.width / 2, graph.y + graph.height / 2);
    const hover = await at.page.evaluate(() => window.keyline.store.state.hover);
    expect(hover?.entity).toBe(1);
    expect(await at.page.locator("#reading").textContent()).toMatch(/s .*ρ .*κ .*α/);
    const comb = await at.page.evaluate(() => window.keyline.live.of(1)?.comb.points.length);
    expect(Math.abs((hover?.sample ?? 0) - (comb ?? 0) / 2)).toBeLessThan((comb ?? 0) / 8);
  });

  it("draws by clicks, and says why where nothing can be drawn", async () => {
    await at.page.locator(".board").focus();
    await at.page.evaluate(() => window.keyline.view.fit({ low: [0, -100], high: [240, 260] }, { left: 30, top: 30, right: 30, bottom: 30 }));
    for (const [key, clicks] of [["l", 3], ["c", 3], ["s", 4], ["q", 3]] as const) {
      await at.page.keyboard.press(key);
      const corners = [[20, 160], [60, 230], [150, 200], [190, 240]] as const;
      for (const corner of corners.slice(0, clicks)) {
        const { x, y } = await onPage(at.page, corner);
        await at.page.mouse.click(x, y);
      }
      await settled(at.page);
    }
    await at.page.keyboard.press("p");
    for (const corner of [[20, -60], [60, -20], [120, -70], [160, -30]] as const) {
      const { x, y } = await onPage(at.page, corner);
      await at.page.mouse.click(x, y);
    }
    await at.page.keyboard.press("Enter");
    await settled(at.page);
    const kinds = await at.page.evaluate(() => window.keyline.store.doc.entities.map((e) => e.kind));
    expect(kinds).toEqual(["segment", "segment", "compound", "s-shape", "quasi", "spline"]);
    const made = await at.page.evaluate(() =>
      window.keyline.store.doc.entities.map((e) => window.keyline.live.of(e.id) !== undefined));
    expect(made).toEqual(kinds.map(() => true));
    // beyond the drawable region: alpha 2 and a triangle no such curve fits
    await at.page.evaluate(() => {
      const { store } = window.keyline;
      store.commit("Test", { ...store.doc, entities: store.doc.entities.map((e) =>
        e.id === 1 ? ({ ...e, alpha: 2, points: [[0, 0], [200, 0], [200.5, 30]] } as typeof e) : e) }, { selection: [1] });
    });
    await settled(at.page);
    await at.page.waitForSelector("#failure");
    expect((await at.page.locator("#failure").textContent())?.length).toBeGreaterThan(20);
    await at.page.keyboard.press("Control+z");
  });

  it("keeps up with the hand", async () => {
    await at.page.evaluate(() => {
      const { store } = window.keyline;
      store.commit("Test", { ...store.doc, entities: store.doc.entities.slice(0, 1) }, { selection: [1] });
      window.keyline.fit();
    });
    await settled(at.page);
    const from = await onPage(at.page, (await points())[1] as [number, number]);
    await at.page.mouse.move(from.x, from.y);
    await at.page.mouse.down();
    await at.page.evaluate(() => window.keyline.canvas.latency.forget());
    for (let i = 0; i < 240; ++i) {
      await at.page.mouse.move(from.x + 50 * Math.sin(i / 12), from.y + 35 * Math.cos(i / 9) - 35);
    }
    await at.page.mouse.up();
    await settled(at.page);
    const { count, half, most } = await at.page.evaluate(() => {
      const { latency } = window.keyline.canvas;
      return { count: latency.count, half: latency.within(0.5), most: latency.within(0.95) };
    });
    console.log(`pointer to painted curve, comb and graphs: p50 ${half.toFixed(1)} ms, p95 ${most.toFixed(1)} ms of ${count}`);
    expect(count).toBeGreaterThan(50);
    if (isQuiet()) expect(most).toBeLessThanOrEqual(16);
  });

  it("complains of nothing", () => expect(at.errors).toEqual([]));
});
