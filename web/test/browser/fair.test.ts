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
    const again = page.waitForRequest("**/api/v1/fair");
    await page.fill("#keep-inside", "");
    await page.press("#keep-inside", "Enter");
    await again;
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
    expect(text).toContain(answer.deviation.max.toPrecision(3));
    expect(text).toMatch(/Largest deviation\s*[\d.]+\smm/); // the table's header tells it
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

onStage("fairing what is symmetric", [], (stage) => {
  const told = () => stage.at.page.evaluate(() => {
    const e = window.keyline.store.doc.entities.find((x) => x.kind === "faired");
    return e?.kind === "faired" ? { ...e.told, id: e.id } : null;
  });

  it("is exact about the line that is found", async () => {
    const { page } = stage.at;
    // y = x^2 / 80 about x = 30, every point off by up to 0.05 of its own
    const points = Array.from({ length: 161 }, (_, i) => {
      const x = i - 80;
      const off = Math.sin(12.9898 * i) * 43758.5453;
      return `${30 + x},${(x * x) / 80 + 0.1 * (off - Math.floor(off) - 0.5)}`;
    });
    const choosing = page.waitForEvent("filechooser");
    await page.click("#open");
    await (await choosing).setFiles({ name: "bow.csv", mimeType: "text/csv", buffer: Buffer.from(points.join("\n")) });
    await page.waitForSelector("#symmetric");
    await page.selectOption("#symmetric", "auto");
    expect(await page.inputValue("#tolerance-number")).toBe(""); // none is known before
    await page.click("#fair");
    await page.waitForSelector("#verdict");
    await settled(page);
    expect(Number(await page.inputValue("#tolerance-number"))).toBeCloseTo((await told())?.tolerance ?? 0, 2);
    const { symmetry, id } = (await told()) ?? { symmetry: null, id: 0 };
    expect(symmetry?.exact).toBe(true);
    expect(await page.locator(".fact.symmetry").textContent()).toContain("Symmetric about");
    const line = symmetry?.point?.[0] ?? 0;
    expect(line).toBeCloseTo(30, 1);
    const ends = await page.evaluate((i) => {
      const comb = window.keyline.live.of(i)?.comb.points as [number, number][];
      return [comb[0], comb.at(-1)];
    }, id);
    const direction = symmetry?.direction ?? 0;
    // the end's image in the line is the other end
    const [p, q] = ends as [[number, number], [number, number]];
    const [px, py] = [p[0] - line, p[1] - (symmetry?.point?.[1] ?? 0)];
    const image = [line + Math.cos(2 * direction) * px + Math.sin(2 * direction) * py,
      (symmetry?.point?.[1] ?? 0) + Math.sin(2 * direction) * px - Math.cos(2 * direction) * py] as const;
    expect(Math.hypot(image[0] - q[0], image[1] - q[1])).toBeLessThan(1e-6);
  });

  it("follows the hand without being asked again, the newest wish alone", async () => {
    const { page } = stage.at;
    const steps = () => page.evaluate(() => window.keyline.store.state.history.past.length);
    const before = await steps();
    await page.evaluate(() => {
      const slider = document.querySelector("#smoothness") as HTMLInputElement;
      for (const value of [0.1, 0.6, 0.9]) {
        slider.valueAsNumber = value;
        slider.dispatchEvent(new Event("input", { bubbles: true }));
      }
    });
    await page.waitForFunction((n) => window.keyline.store.state.history.past.length > n, before);
    await settled(page);
    expect((await told())?.request.smoothness).toBe(0.9);
    expect(await steps()).toBe(before + 1);
    await page.fill("#tolerance-number", "0.15");
    await page.press("#tolerance-number", "Enter");
    await page.waitForFunction((n) => window.keyline.store.state.history.past.length > n, before + 1);
    await settled(page);
    expect((await told())?.request.tolerance).toBeCloseTo(0.15, 9);
    await page.selectOption("#symmetric", "line");
    await page.fill("#symmetry-line", "x=30");
    await page.press("#symmetry-line", "Enter");
    await page.waitForFunction((n) => window.keyline.store.state.history.past.length > n, before + 2);
    await settled(page);
    const asked = await told();
    expect(asked?.request.symmetric).toBe("x=30");
    expect(asked?.symmetry?.point?.[0]).toBe(30);
    const pictures = process.env["KEYLINE_PICTURES"];
    if (pictures) await page.screenshot({ path: `${pictures}/symmetric.png` });
  });
});
