import { readFileSync } from "node:fs";
import { join } from "node:path";
import { expect, it } from "vitest";
import { onStage, settled, source } from "./studio.ts";

onStage("making one thing of another", [], (stage) => {
  const endOf = (id: number) => stage.at.page.evaluate((i) => window.keyline.live.of(i)?.comb.points.at(-1), id);

  it("mirrors a curve about its end, and the image follows", async () => {
    await stage.at.page.click("#mirror");
    await settled(stage.at.page);
    const end = await endOf(1);
    expect((await endOf(2))?.[0]).toBeCloseTo(end?.[0] as number, 6);
    const start = await stage.at.page.evaluate(() => window.keyline.live.of(2)?.comb.points[0]);
    expect(start?.[0]).toBeCloseTo(2 * (end?.[0] as number), 6);
  });

  it("blends between two", async () => {
    await stage.at.page.evaluate(() => {
      const { store } = window.keyline;
      const [first] = store.doc.entities;
      const other = { ...first, id: 7, name: "Other", points: [[400, 200], [500, 260], [560, 200]] } as typeof first;
      store.commit("Test", { ...store.doc, next: 8, entities: [first, other] as never }, { selection: [1, 7] });
    });
    await settled(stage.at.page);
    await stage.at.page.locator("#entity-1").click();
    await stage.at.page.locator("#entity-7").click({ modifiers: ["Shift"] });
    await stage.at.page.click("#blend");
    await settled(stage.at.page);
    const blend = await stage.at.page.evaluate(() => window.keyline.live.of(8)?.comb.points);
    const from = await endOf(1);
    expect(blend?.[0]?.[0]).toBeCloseTo(from?.[0] as number, 6);
    expect(blend?.at(-1)?.[0]).toBeCloseTo(400, 6);
  });

  it("lays a picture below and traces its lines", async () => {
    const choosing = stage.at.page.waitForEvent("filechooser");
    await stage.at.page.click("#open");
    await (await choosing).setFiles(join(source, "examples/sketch.png"));
    await stage.at.page.click("#trace");
    await stage.at.page.waitForFunction(() => window.keyline.store.doc.entities.some((e) => e.layer === "Sketch"));
    await settled(stage.at.page);
    const strokes = await stage.at.page.evaluate(() => window.keyline.store.doc.entities
      .filter((e) => e.layer === "Sketch").map((e) => window.keyline.live.of(e.id)?.comb.length ?? 0));
    expect(strokes.length).toBeGreaterThan(2);
    expect(Math.min(...strokes)).toBeGreaterThan(0);
    // every stage can be looked at
    const stages = await stage.at.page.locator("#stage option").allTextContents();
    expect(stages).toContain("binary");
    await stage.at.page.selectOption("#stage", "binary");
    expect(await stage.at.page.evaluate(() => window.keyline.store.state.underlay?.stage)).toBe("binary");
  });

  it("tells which strokes a line stands for, and makes one line of two", async () => {
    const { page } = stage.at;
    const members = () => page.evaluate(() => window.keyline.store.doc.entities
      .flatMap((e) => (e.kind === "fixed" && e.members ? [[...e.members]] : [])));
    const choose = (wanted: readonly string[]) => page.evaluate((which) => {
      const { store } = window.keyline;
      store.set({ selection: store.doc.entities
        .filter((e) => e.kind === "fixed" && which.includes(String(e.members))).map((e) => e.id) });
    }, wanted);
    await page.check("#trace-consolidate");
    await page.click("#trace");
    await settled(page);
    expect(await members()).not.toContainEqual([4, 5]);
    await choose(["4", "5"]);
    expect(await page.locator("#members").textContent()).toContain("strokes 4, 5");
    await page.click("#join-strokes");
    await settled(page);
    expect(await members()).toContainEqual([4, 5]);
    await choose(["4,5"]);
    await page.click("#decide-anew");
    await settled(page);
    expect(await members()).toEqual(expect.arrayContaining([[4], [5]]));
    // as it was for what follows
    await page.uncheck("#trace-consolidate");
    await page.click("#trace");
    await settled(page);
  });

  it("drives a stroke to a curvature drawn by hand", async () => {
    const { page } = stage.at;
    const stroke = await page.evaluate(() => {
      const { store } = window.keyline;
      const e = store.doc.entities.find((x) => x.layer === "Sketch");
      store.set({ selection: e ? [e.id] : [] });
      return e?.kind === "fixed" ? { id: e.id, curve: JSON.stringify(e.curve) } : null;
    });
    await page.click("#draw-target");
    const box = await page.locator(".graph canvas").first().boundingBox();
    if (!box || !stroke) throw new Error("no graph");
    await page.mouse.move(box.x + 70, box.y + 0.5 * box.height);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width - 30, box.y + 0.45 * box.height, { steps: 12 });
    await page.mouse.up();
    await page.waitForFunction(({ id, curve }) => {
      const e = window.keyline.store.doc.entities.find((x) => x.id === id);
      return e?.kind === "fixed" && e.before !== undefined && JSON.stringify(e.before) === curve;
    }, stroke);
    await settled(page);
    await page.locator(".board").focus();
    await page.keyboard.press("Control+z");
  });

  it("splits a stroke and joins the parts", async () => {
    const { page } = stage.at;
    const count = () => page.evaluate(() => window.keyline.store.doc.entities.length);
    const before = await count();
    await page.evaluate(() => {
      const { store, live } = window.keyline;
      const e = store.doc.entities.find((x) => x.layer === "Sketch");
      if (e) store.set({ selection: [e.id], hover: { entity: e.id, sample: Math.floor((live.of(e.id)?.comb.points.length ?? 2) / 2) } });
    });
    await page.keyboard.press("x");
    await page.waitForFunction((n) => window.keyline.store.doc.entities.length === n, before + 1);
    await settled(page);
    await page.evaluate(() => {
      const { store } = window.keyline;
      store.set({ selection: store.doc.entities.slice(-2).map((e) => e.id) });
    });
    await page.click("#join");
    await page.waitForFunction((n) => window.keyline.store.doc.entities.length === n, before);
    await settled(page);
  });

  it("saves its document and opens it again", async () => {
    const { page } = stage.at;
    const arriving = page.waitForEvent("download");
    await page.click("#save");
    const download = await arriving;
    expect(download.suggestedFilename()).toMatch(/\.keyline\.json$/);
    const file = await download.path();
    const before = await page.evaluate(() => JSON.stringify(window.keyline.store.doc.entities));
    await page.evaluate(() => window.keyline.store.commit("Test", { ...window.keyline.store.doc, entities: [] }));
    const choosing = page.waitForEvent("filechooser");
    await page.click("#open");
    await (await choosing).setFiles({ name: "work.keyline.json", mimeType: "application/json", buffer: readFileSync(file) });
    await page.waitForFunction((n) => JSON.stringify(window.keyline.store.doc.entities) === n, before);
  });

});
