import { expect, it } from "vitest";
import { onPage, onStage, settled } from "./studio.ts";

interface Edited {
  curve: object;
  after: { type: number; cav: number; alpha: number | null };
}

onStage("sliding a curve to Class A", ["examples/cubic.json"], (stage) => {
  const given = { type: "bezier", points: [[0, 0], [1, 2], [2.2374368670764584, 0.2], [3, 1]] };
  const sliding = () => stage.at.page.evaluate(() => window.keyline.store.doc.entities.find((e) => e.kind === "sliding"));

  it("tells its value and its plane", async () => {
    const { page } = stage.at;
    await page.click("#class-a-panel summary");
    await page.waitForSelector("#class-a-type");
    const curve = await page.evaluate(() => window.keyline.live.of(1)?.curve);
    const told = await stage.server.ask<{ type: number; cav: number }>("curve.cav", { curve: curve ?? given });
    expect(await page.locator("#class-a-type").textContent()).toContain(String(told.type));
    expect(await page.locator("#class-a").textContent()).toContain(told.cav.toPrecision(4));
  });

  it("slides to least energy as the operation does", async () => {
    const { page } = stage.at;
    const curve = await page.evaluate(() => window.keyline.live.of(1)?.curve);
    await page.click("#slide");
    await page.waitForSelector("#amount");
    await settled(page);
    const edited = await stage.server.ask<Edited>("curve.edit", { curve, hold: "ends-and-tangent", amount: 1 });
    expect(await page.evaluate(() => window.keyline.live.of(1)?.curve)).toEqual(edited.curve);
    expect(edited.after.type).toBeLessThanOrEqual(2);
    await page.waitForFunction(() => /^[12] /.test(document.querySelector("#class-a-type")?.textContent ?? ""));
  });

  it("follows its point in the plane, and goes back", async () => {
    const { page } = stage.at;
    const before = await page.evaluate(() => JSON.stringify(window.keyline.live.of(1)?.curve));
    const plane = page.locator(".plane canvas");
    await plane.scrollIntoViewIfNeeded();
    const box = await plane.boundingBox();
    if (!box) throw new Error("no plane");
    await page.mouse.move(box.x + 0.6 * box.width, box.y + 0.3 * box.height);
    await page.mouse.down();
    await page.mouse.move(box.x + 0.62 * box.width, box.y + 0.28 * box.height, { steps: 4 });
    await page.mouse.up();
    await settled(page);
    const e = await sliding();
    expect(e?.kind === "sliding" && e.target?.alpha).toBeGreaterThan(0.2);
    expect(await page.evaluate(() => JSON.stringify(window.keyline.live.of(1)?.curve))).not.toBe(before);
    await page.keyboard.press("Control+z");
    await settled(page);
    expect(await page.evaluate(() => JSON.stringify(window.keyline.live.of(1)?.curve))).toBe(before);
  });
});

onStage("what cannot be drawn", [], (stage) => {
  it("is shaded while a handle is dragged, the nearest that can be shown", async () => {
    const { page } = stage.at;
    await page.evaluate(() => {
      const { store } = window.keyline;
      store.commit("Test", { ...store.doc, entities: store.doc.entities.map((e) => ({ ...e, alpha: 2 }) as typeof e) }, { selection: [1] });
    });
    await settled(page);
    const from = await onPage(page, [180, 0]);
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    const far = await onPage(page, [20, 0]);
    await page.mouse.move(far.x, far.y, { steps: 3 });
    await page.waitForFunction(() => window.keyline.region.nearest !== null);
    const region = await page.evaluate(() => window.keyline.region.outlines.map((o) => o.length));
    expect(region.length).toBe(2);
    await page.mouse.up();
    await page.waitForFunction(() => window.keyline.region.outlines.length === 0);
    await page.keyboard.press("Control+z");
  });
});
