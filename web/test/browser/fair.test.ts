import { readFileSync } from "node:fs";
import type { Browser } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { openBrowser, Server, settled, visit, type Visit } from "./studio.ts";

describe("fairing a scan", () => {
  const server = new Server();
  let browser: Browser;
  let at: Visit;

  beforeAll(async () => {
    await server.start(["examples/bonnet-scan.csv"]);
    browser = await openBrowser();
    at = await visit(browser, server.url);
  });
  afterAll(async () => {
    await browser.close();
    await server.remove();
  });

  const kinds = () => at.page.evaluate(() => window.keyline.store.doc.entities.map((e) => e.kind));

  it("opens the file it was started with", async () => {
    expect(await kinds()).toEqual(["scan"]);
  });

  it("stops when told to", async () => {
    // The work is let go only when the word to stop is on its way: how fast either is does not matter.
    const told = at.page.waitForRequest("**/api/v1/cancel");
    await at.page.route("**/api/v1/fair", async (route) => {
      await told;
      await route.continue();
    });
    await at.page.click("#fair");
    await at.page.click("#cancel");
    await settled(at.page);
    await at.page.unroute("**/api/v1/fair");
    const verdict = at.page.locator("#verdict");
    const said = (await verdict.count()) > 0 ? await verdict.textContent() : await at.page.locator(".toast").textContent();
    expect(said).toMatch(/Stopped early|cancelled/i);
    if ((await kinds()).length > 1) await at.page.keyboard.press("Control+z");
    expect(await kinds()).toEqual(["scan"]);
  });

  it("shows before and after, and the operation's numbers", async () => {
    await at.page.locator("#entity-1").click();
    await at.page.click("#fair");
    await at.page.waitForSelector("#verdict");
    await settled(at.page);
    expect(await kinds()).toEqual(["scan", "faired"]);
    const line = await at.page.evaluate(() => {
      const scan = window.keyline.store.doc.entities[0];
      return scan?.kind === "scan" ? scan.line : null;
    });
    const answer = await server.ask<{ deviation: { max: number }; pieces: unknown[]; curve: object }>("fair", { line });
    const text = await at.page.locator(".panel").textContent();
    expect(text).toContain(`Pieces (${answer.pieces.length})`);
    expect(text).toContain(`${answer.deviation.max.toPrecision(3)} mm`);
    expect(await at.page.evaluate(() => window.keyline.live.of(2)?.curve)).toEqual(answer.curve);
    await at.page.waitForSelector("#measures .was");
  });

  it("exports STEP that reads back", async () => {
    const arriving = at.page.waitForEvent("download");
    await at.page.selectOption("#export", "step");
    const file = await (await arriving).path();
    const step = readFileSync(file, "utf8");
    expect(step).toContain("ISO-10303-21");
    expect(step).toContain("B_SPLINE_CURVE");
    const form = await fetch(new URL("/api/v1/studio/upload?name=back.step", server.url), {
      method: "POST", body: step, headers: { Authorization: "Bearer 0123456789abcdef" },
    });
    const { file: there } = (await form.json()) as { file: string };
    const read = await server.ask<{ curves: unknown[] }>("document.read", { file: there });
    expect(read.curves.length).toBe(2);
  });

  it("has all back after the server was killed", async () => {
    await at.page.waitForTimeout(600); // longer than the autosave waits
    const before = await at.page.evaluate(() => JSON.stringify(window.keyline.store.doc.entities));
    const { port } = server;
    await server.end("SIGKILL");
    await at.page.keyboard.press("k");
    await server.start(["examples/bonnet-scan.csv"], port);
    const again = await visit(browser, server.url);
    expect(await again.page.evaluate(() => JSON.stringify(window.keyline.store.doc.entities))).toBe(before);
    await again.page.reload();
    await again.page.waitForFunction(() => window.keyline?.store.doc.entities.length === 2);
    expect(await again.page.evaluate(() => JSON.stringify(window.keyline.store.doc.entities))).toBe(before);
    expect(again.errors).toEqual([]);
  });

  it("complains of nothing but the lost server", () => {
    expect(at.errors.filter((e) => !/ERR_CONNECTION|WebSocket/.test(e))).toEqual([]);
  });
});
