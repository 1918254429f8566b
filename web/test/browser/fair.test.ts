import { readFileSync } from "node:fs";
import { expect, it } from "vitest";
import { onPage, onStage, settled, visit } from "./studio.ts";

onStage("fairing a scan", ["examples/bonnet-scan.csv"], (stage) => {
  const kinds = () => stage.at.page.evaluate(() => window.keyline.store.doc.entities.map((e) => e.kind));

  it("opens the file it was started with", async () => {
    expect(await kinds()).toEqual(["scan"]);
  });

  it("stops when told to", async () => {
    // The work is let go only when the word to stop is on its way: how fast either is does not matter.
    const told = stage.at.page.waitForRequest("**/api/v1/cancel");
    await stage.at.page.route("**/api/v1/fair", async (route) => {
      await told;
      await route.continue();
    });
    await stage.at.page.click("#fair");
    await stage.at.page.click("#cancel");
    await settled(stage.at.page);
    await stage.at.page.unroute("**/api/v1/fair");
    const verdict = stage.at.page.locator("#verdict");
    const said = (await verdict.count()) > 0 ? await verdict.textContent() : await stage.at.page.locator(".toast").textContent();
    expect(said).toMatch(/Stopped early|cancelled/i);
    if ((await kinds()).length > 1) await stage.at.page.keyboard.press("Control+z");
    expect(await kinds()).toEqual(["scan"]);
  });

  it("leaves out what is clicked and keeps to a side", async () => {
    const { page } = stage.at;
    const scan = () => page.evaluate(() => {
      const e = window.keyline.store.doc.entities[0];
      return e?.kind === "scan" ? { points: e.line.points as [number, number][], strays: e.strays ?? [] } : null;
    });
    await page.locator("#entity-1").click();
    await page.click("#strays");
    const { points } = (await scan()) ?? { points: [] };
    for (const index of [100, 300, 300]) { // the second time it comes back
      const { x, y } = await onPage(page, points[index] as [number, number]);
      await page.mouse.click(x, y);
    }
    expect((await scan())?.strays).toEqual([100]);
    await page.click("#strays");
    await page.fill("#keep-inside", "y>=-1000000");
    const asked = page.waitForRequest("**/api/v1/fair");
    await page.click("#fair");
    const request = (await asked).postDataJSON() as { line: { points: unknown[] }; keep_inside: string };
    expect(request.line.points).toEqual(points.filter((_, i) => i !== 100));
    expect(request.keep_inside).toBe("y>=-1000000");
    await page.waitForSelector("#verdict");
    await settled(page);
    await page.fill("#keep-inside", "");
    await page.press("#keep-inside", "Enter");
    await settled(page);
    while ((await kinds()).length > 1 || ((await scan())?.strays.length ?? 0) > 0) await page.keyboard.press("Control+z");
  });

  it("shows before and after, and the operation's numbers", async () => {
    await stage.at.page.locator("#entity-1").click();
    let events = ""; // what the operation answers, on its way to the page
    await stage.at.page.route("**/api/v1/fair", async (route) => {
      const response = await route.fetch({ timeout: 0 });
      events = await response.text();
      await route.fulfill({ response, body: events });
    });
    await stage.at.page.click("#fair");
    await stage.at.page.waitForSelector("#verdict");
    await stage.at.page.unroute("**/api/v1/fair");
    const { result: answer } = JSON.parse(events.slice(events.indexOf("event: answer\ndata: ") + 20)) as {
      result: { deviation: { max: number }; pieces: unknown[]; curve: object; fairness: { fair: boolean } };
    };
    await settled(stage.at.page);
    expect(await kinds()).toEqual(["scan", "faired"]);
    const text = await stage.at.page.locator(".panel").textContent();
    expect(text).toContain(`Pieces (${answer.pieces.length})`);
    expect(text).toContain(`${answer.deviation.max.toPrecision(3)} mm`);
    expect(await stage.at.page.evaluate(() => window.keyline.live.of(2)?.curve)).toEqual(answer.curve);
    await stage.at.page.waitForSelector("#measures .was");
    // near enough and calm enough, as the operation has it, and the points' deviation along the curve
    expect(await stage.at.page.locator("#fairness").textContent()).toMatch(answer.fairness.fair ? /^Fair/ : /^Not fair/);
    await stage.at.page.locator(".board").focus();
    await stage.at.page.keyboard.press("d");
    const told = stage.at.page.locator("figure.graph:visible", { hasText: "Deviation" }).locator(".note");
    await stage.at.page.waitForFunction(() => [...document.querySelectorAll(".note")].some((n) => n.textContent?.startsWith("largest")));
    expect(await told.textContent()).toContain(`largest ${answer.deviation.max.toPrecision(3)}`);
    await stage.at.page.keyboard.press("d");
  });

  it("exports STEP that reads back", async () => {
    const arriving = stage.at.page.waitForEvent("download");
    await stage.at.page.selectOption("#export", "step");
    const file = await (await arriving).path();
    const step = readFileSync(file, "utf8");
    expect(step).toContain("ISO-10303-21");
    expect(step).toContain("B_SPLINE_CURVE");
    const form = await fetch(new URL("/api/v1/studio/upload?name=back.step", stage.server.url), {
      method: "POST", body: step, headers: { Authorization: "Bearer 0123456789abcdef" },
    });
    const { file: there } = (await form.json()) as { file: string };
    const read = await stage.server.ask<{ curves: unknown[] }>("document.read", { file: there });
    expect(read.curves.length).toBe(2);
  });

  it("has all back after the server was killed", async () => {
    await stage.at.page.waitForFunction(() => window.keyline.autosave.settled);
    const before = await stage.at.page.evaluate(() => JSON.stringify(window.keyline.store.doc.entities));
    const { port } = stage.server;
    await stage.server.end("SIGKILL");
    await stage.at.page.keyboard.press("k");
    await stage.server.start(["examples/bonnet-scan.csv"], port);
    const again = await visit(stage.browser, stage.server.url);
    expect(await again.page.evaluate(() => JSON.stringify(window.keyline.store.doc.entities))).toBe(before);
    await again.page.reload();
    await again.page.waitForFunction(() => window.keyline?.store.doc.entities.length === 2);
    expect(await again.page.evaluate(() => JSON.stringify(window.keyline.store.doc.entities))).toBe(before);
    expect(again.errors).toEqual([]);
  });
}, /ERR_CONNECTION|WebSocket/); // the server was killed
