/** A picture that the studio is started with, and one of a kind that browsers do not show. */
import { readFileSync } from "node:fs";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import type { Browser, Page } from "playwright-core";
import { openBrowser, Server } from "./studio.ts";

/** A TIFF of one strip of eight bits (TIFF 6.0): white, with a black bar of four rows. */
function tiff(width: number, height: number): Buffer {
  const pixels = Buffer.alloc(width * height, 255);
  pixels.fill(0, width * (height / 2), width * (height / 2 + 4));
  for (let y = 0; y < height; ++y) pixels.fill(255, y * width, y * width + 10).fill(255, (y + 1) * width - 10, (y + 1) * width);
  const tags = [[256, width], [257, height], [258, 8], [259, 1], [262, 1], [273, 8], [277, 1], [278, height], [279, pixels.length]];
  const head = Buffer.from([0x49, 0x49, 42, 0, 0, 0, 0, 0]);
  head.writeUInt32LE(8 + pixels.length, 4);
  const directory = Buffer.alloc(2 + 12 * tags.length + 4);
  directory.writeUInt16LE(tags.length);
  tags.forEach(([tag = 0, value = 0], i) => {
    directory.writeUInt16LE(tag, 2 + 12 * i);
    directory.writeUInt16LE(4, 4 + 12 * i); // of 32 bits each
    directory.writeUInt32LE(1, 6 + 12 * i);
    directory.writeUInt32LE(value, 10 + 12 * i);
  });
  return Buffer.concat([head, pixels, directory]);
}

describe("a picture", () => {
  const server = new Server();
  const errors: string[] = [];
  let browser: Browser, page: Page;
  beforeAll(async () => {
    await server.start(["examples/sketch.png"]);
    browser = await openBrowser(false);
    page = await browser.newPage();
    page.on("pageerror", (e) => errors.push(e.message));
    await page.goto(server.url);
  });
  afterAll(async () => {
    await browser.close();
    await server.remove();
  });
  const under = () => page.evaluate(() => {
    const { underlay } = window.keyline.store.state;
    return underlay && { name: underlay.name, size: [underlay.width, underlay.height] };
  });
  const lines = async (): Promise<{ count: number; unit: string }> => {
    await page.click("#trace");
    await page.waitForFunction(() => window.keyline.store.doc.entities.length > 0 && window.keyline.store.state.work === null);
    return page.evaluate(() => ({ count: window.keyline.store.doc.entities.length, unit: window.keyline.store.doc.unit }));
  };

  it("given at the start lies below, as one that is dropped", async () => {
    await page.waitForFunction(() => window.keyline.store.state.underlay);
    expect((await under())?.name).toBe("sketch.png");
    expect(await page.evaluate(() => window.keyline.store.doc.entities.length)).toBe(0);
    const traced = await lines();
    expect(traced.count).toBeGreaterThan(0);
    expect(traced.unit).toBe("px");
  });

  it("is there again, as it lay, when the page is opened anew, and in a saved document", async () => {
    const place = () => page.evaluate(() => {
      const { underlay } = window.keyline.store.state;
      return underlay && [underlay.name, underlay.at, underlay.scale, underlay.opacity, underlay.width, underlay.height];
    });
    await page.evaluate(() => {
      const { store } = window.keyline;
      if (store.state.underlay) store.set({ underlay: { ...store.state.underlay, at: [3, 4], scale: 0.25, opacity: 0.75 } });
    });
    const lay = await place();
    expect(lay?.slice(0, 4)).toEqual(["sketch.png", [3, 4], 0.25, 0.75]);
    const downloading = page.waitForEvent("download");
    await page.keyboard.press("Control+s");
    const saved = await (await downloading).path();
    const remembered = () => page.evaluate(() => {
      const kept = JSON.parse(localStorage.getItem("keyline-work") ?? "null") as { picture?: { opacity: number } } | null;
      return kept?.picture?.opacity;
    });
    await expect.poll(remembered, { timeout: 60_000 }).toBe(0.75);
    await page.reload();
    await page.waitForFunction(() => window.keyline?.store.state.underlay);
    expect(await place()).toEqual(lay);
    await page.evaluate(() => window.keyline.store.set({ underlay: null }));
    const choosing = page.waitForEvent("filechooser");
    await page.click("#open");
    await (await choosing).setFiles({ name: "saved.json", mimeType: "application/json", buffer: readFileSync(saved) });
    await page.waitForFunction(() => window.keyline.store.state.underlay);
    expect(await place()).toEqual(lay);
  });

  it("that the browser cannot show is shown as tracing sees it", async () => {
    const choosing = page.waitForEvent("filechooser");
    await page.click("#open");
    await (await choosing).setFiles({ name: "bar.tif", mimeType: "image/tiff", buffer: tiff(160, 60) });
    await page.waitForFunction(() => window.keyline.store.state.underlay?.name === "bar.tif");
    expect((await under())?.size).toEqual([160, 60]);
    expect((await lines()).count).toBe(1);
  });

  it("complains of nothing", () => expect(errors).toEqual([]));
});
