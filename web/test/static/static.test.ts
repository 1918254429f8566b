/** The page without a server, where ./dev wasm has built it. */
import { readFileSync, statSync } from "node:fs";
import type { Server } from "node:http";
import { join } from "node:path";
import { gzipSync } from "node:zlib";
import type { Browser } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { onPage, openBrowser, settled, visit, type Visit } from "../browser/studio.ts";
import { serve } from "./serve.ts";

const folder = process.env["KEYLINE_WASM_PAGE"] as string;
const pictures = process.env["KEYLINE_PICTURES"];

describe("the page without a server", () => {
  let browser: Browser;
  let server: Server;
  let url: string;
  let at: Visit;
  const shot = async (name: string) => {
    if (pictures) await at.page.screenshot({ path: join(pictures, `static-${name}.png`) });
  };

  beforeAll(async () => {
    ({ url, server } = await serve(folder));
    browser = await openBrowser();
    at = await visit(browser, url);
  });
  afterAll(async () => {
    await browser.close();
    server.close();
  });

  it("is small", () => {
    const sizes = ["keyline.wasm", "keyline.mjs", "studio.js", "worker.js"].map((file) => {
      const bytes = readFileSync(join(folder, file));
      return [file, statSync(join(folder, file)).size, gzipSync(bytes).length] as const;
    });
    for (const [file, plain, compressed] of sizes) console.log(`${file}: ${plain} bytes, ${compressed} compressed`);
    expect(sizes.reduce((sum, [, , compressed]) => sum + compressed, 0)).toBeLessThan(3e6);
  });

  it("draws by clicks, follows a dragged handle", async () => {
    const { page } = at;
    const first = await page.evaluate(() => performance.getEntriesByName("first-curve")[0]?.startTime ?? 0);
    console.log(`a curve with its comb after ${first.toFixed(0)} ms`);
    await page.evaluate(() => window.keyline.view.fit({ low: [0, -20], high: [260, 260] }, { left: 30, top: 30, right: 30, bottom: 30 }));
    await page.locator(".board").focus();
    await page.keyboard.press("l");
    for (const corner of [[20, 160], [60, 230], [150, 200]] as const) {
      const { x, y } = await onPage(page, corner);
      await page.mouse.click(x, y);
    }
    await settled(page);
    expect(await page.evaluate(() => window.keyline.store.doc.entities.map((e) => e.kind))).toEqual(["segment", "segment"]);
    await page.evaluate(() => window.keyline.store.set({ selection: [1], tool: "select" }));
    const from = await onPage(page, [230, 130]);
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    await page.evaluate(() => window.keyline.canvas.latency.forget());
    for (let i = 1; i <= 60; ++i) await page.mouse.move(from.x - i, from.y - 0.5 * i);
    await page.mouse.up();
    await settled(page);
    const { points, pieces, half, most } = await page.evaluate(() => {
      const { keyline } = window;
      return {
        points: (keyline.store.doc.entities[0] as { points: [number, number][] }).points,
        pieces: keyline.live.of(1)?.curve.pieces as { alpha: number }[],
        half: keyline.canvas.latency.within(0.5), most: keyline.canvas.latency.within(0.95),
      };
    });
    console.log(`pointer to painted curve: p50 ${half.toFixed(1)} ms, p95 ${most.toFixed(1)} ms`);
    expect(points[2]).not.toEqual([230, 130]);
    expect(pieces.map((p) => p.alpha)).toEqual([-1]);
    await shot("drawing");
  });

  it("fairs a scan beside it, stops when told to, and takes it home", async () => {
    await at.page.goto(`${url}#open=bonnet-scan.csv`);
    await at.page.evaluate(() => localStorage.clear());
    await at.page.reload();
    const { page } = at;
    await page.waitForFunction(() => window.keyline?.store.doc.entities[0]?.kind === "scan");
    // in one breath: however fast the work is, it is stopped
    await page.evaluate(() => {
      document.querySelector<HTMLButtonElement>("#fair")?.click();
      document.querySelector<HTMLButtonElement>("#cancel")?.click();
    });
    await settled(page);
    expect(await page.locator(".toast").textContent()).toContain("stopped");
    const start = Date.now();
    await page.click("#fair");
    await page.waitForSelector("#verdict");
    await settled(page);
    console.log(`694 points faired after ${Date.now() - start} ms`);
    const told = await page.evaluate(() => {
      const e = window.keyline.store.doc.entities.find((x) => x.kind === "faired");
      return e?.kind === "faired" ? { within: e.told.within, pieces: e.told.pieces.length } : null;
    });
    expect(told?.within).toBe(true);
    expect(told?.pieces).toBeGreaterThan(3);
    await shot("fairing");
    for (const [format, mark] of [["svg", "<svg"], ["dxf", "SPLINE"], ["json", "\"curves\""]] as const) {
      const arriving = page.waitForEvent("download");
      await page.selectOption("#export", format);
      expect(readFileSync(await (await arriving).path(), "utf8")).toContain(mark);
    }
  });

  it("offers nothing it has not", async () => {
    const { page } = at;
    expect(await page.locator("#export option").allTextContents()).not.toContain("STEP");
    expect(await page.locator("text=Class A").count()).toBe(0);
  });

  it("complains of nothing", () => expect(at.errors).toEqual([]));
});
