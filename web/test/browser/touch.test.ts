/** Fingers: one drags a handle it need not hit exactly, two zoom what lies between them. */
import type { CDPSession } from "playwright-core";
import { expect, it } from "vitest";
import { onPage, onStage, settled } from "./studio.ts";

interface Finger {
  x: number;
  y: number;
  id: number;
}

onStage("fingers", [], (stage) => {
  let fingers: CDPSession;
  const touch = (type: "touchStart" | "touchMove" | "touchEnd", touchPoints: Finger[]) =>
    fingers.send("Input.dispatchTouchEvent", { type, touchPoints });

  it("drag a handle from beside it", async () => {
    const { page, context } = stage.at;
    await page.setViewportSize({ width: 768, height: 1024 });
    await page.evaluate(async () => {
      const painted = () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
      await painted(); // the board has its new size
      window.keyline.fit();
      await painted();
    });
    fingers = await context.newCDPSession(page);
    await fingers.send("Emulation.setTouchEmulationEnabled", { enabled: true, maxTouchPoints: 2 });
    const { x, y } = await onPage(page, [180, 0]);
    const at = (dx: number, dy: number): Finger[] => [{ x: x + 14 + dx, y: y + 14 + dy, id: 1 }];
    await touch("touchStart", at(0, 0));
    for (let i = 1; i <= 6; ++i) await touch("touchMove", at(-8 * i, -5 * i));
    await touch("touchEnd", []);
    await settled(page);
    const moved = await page.evaluate(() => (window.keyline.store.doc.entities[0] as { points: [number, number][] }).points[1]);
    const to = await onPage(page, moved as [number, number]);
    expect(Math.hypot(to.x - (x + 14 - 48), to.y - (y + 14 - 30))).toBeLessThan(1);
    expect(await page.evaluate(() => window.keyline.store.state.history.past.at(-1)?.label)).toBe("Move handle");
  });

  it("zoom what lies between them", async () => {
    const { page } = stage.at;
    const box = await page.locator(".board").boundingBox();
    if (!box) throw new Error("no board");
    const middle = { x: box.x + box.width / 2, y: box.y + box.height / 2 };
    const apart = (d: number): Finger[] => [{ x: middle.x - d, y: middle.y, id: 1 }, { x: middle.x + d, y: middle.y, id: 2 }];
    const seen = () => page.evaluate(() => ({ scale: window.keyline.view.scale, center: window.keyline.view.center }));
    const before = await seen();
    await touch("touchStart", apart(40));
    for (let d = 50; d <= 120; d += 10) await touch("touchMove", apart(d));
    await touch("touchEnd", []);
    const after = await seen();
    expect(after.scale / before.scale).toBeGreaterThan(2);
    expect(after.scale / before.scale).toBeLessThan(3.5);
    expect(Math.hypot(after.center[0] - before.center[0], after.center[1] - before.center[1]) * before.scale).toBeLessThan(12);
    expect(await page.evaluate(() => window.keyline.store.state.history.past.length)).toBe(2);
  });
});
