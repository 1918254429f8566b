import { join } from "node:path";
import type { Browser } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { openBrowser, Server, settled, source, visit, type Visit } from "./studio.ts";

describe("making one thing of another", () => {
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

  const endOf = (id: number) => at.page.evaluate((i) => window.keyline.live.of(i)?.comb.points.at(-1), id);

  it("mirrors a curve about its end, and the image follows", async () => {
    await at.page.click("#mirror");
    await settled(at.page);
    const end = await endOf(1);
    expect((await endOf(2))?.[0]).toBeCloseTo(end?.[0] as number, 6);
    const start = await at.page.evaluate(() => window.keyline.live.of(2)?.comb.points[0]);
    expect(start?.[0]).toBeCloseTo(2 * (end?.[0] as number), 6);
  });

  it("blends between two", async () => {
    await at.page.evaluate(() => {
      const { store } = window.keyline;
      const [first] = store.doc.entities;
      const other = { ...first, id: 7, name: "Other", points: [[400, 200], [500, 260], [560, 200]] } as typeof first;
      store.commit("Test", { ...store.doc, next: 8, entities: [first, other] as never }, { selection: [1, 7] });
    });
    await settled(at.page);
    await at.page.locator("#entity-1").click();
    await at.page.locator("#entity-7").click({ modifiers: ["Shift"] });
    await at.page.click("#blend");
    await settled(at.page);
    const blend = await at.page.evaluate(() => window.keyline.live.of(8)?.comb.points);
    const from = await endOf(1);
    expect(blend?.[0]?.[0]).toBeCloseTo(from?.[0] as number, 6);
    expect(blend?.at(-1)?.[0]).toBeCloseTo(400, 6);
  });

  it("lays a picture below and traces its lines", async () => {
    const choosing = at.page.waitForEvent("filechooser");
    await at.page.click("#open");
    await (await choosing).setFiles(join(source, "examples/sketch.png"));
    await at.page.click("#trace");
    await at.page.waitForFunction(() => window.keyline.store.doc.entities.some((e) => e.layer === "Sketch"));
    await settled(at.page);
    const strokes = await at.page.evaluate(() => window.keyline.store.doc.entities
      .filter((e) => e.layer === "Sketch").map((e) => window.keyline.live.of(e.id)?.comb.length ?? 0));
    expect(strokes.length).toBeGreaterThan(2);
    expect(Math.min(...strokes)).toBeGreaterThan(0);
  });

  it("complains of nothing", () => expect(at.errors).toEqual([]));
});
