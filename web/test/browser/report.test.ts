/** The page that `keyline fair` writes: its comb and curvature plot, linked, and what is there without a script. */
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { openBrowser, source } from "./open.ts";

const pictures = process.env["KEYLINE_PICTURES"];

describe("the report of fairing", () => {
  const folder = mkdtempSync(join(tmpdir(), "keyline-report-"));
  const file = join(folder, "report.html");
  const errors: string[] = [];
  let browser: Browser;
  let page: Page;

  const data = () => page.evaluate(() => JSON.parse(document.querySelector(".explorer script")?.textContent ?? "{}") as { s: number[]; k: number[] });
  const marked = () => page.locator(".explorer").evaluate((e) => Number((e as HTMLElement).dataset["mark"]));
  const range = () => page.locator(".explorer").evaluate((e) => ((e as HTMLElement).dataset["range"] ?? "").split(" ").map(Number));
  const told = () => page.locator(".told").textContent();
  const inPlot = async (share: number) => {
    const box = await page.locator(".explorer .plot").boundingBox();
    if (!box) throw new Error("no plot");
    return { x: box.x + 64 + share * (box.width - 64 - 14), y: box.y + box.height / 2 };
  };

  beforeAll(async () => {
    execFileSync(process.env["KEYLINE"] as string, ["fair", join(source, "examples/bonnet-scan.csv"), "-o", file, "--quiet"]);
    browser = await openBrowser();
    page = await (await browser.newContext({ viewport: { width: 1280, height: 800 } })).newPage();
    page.on("console", (m) => m.type() === "error" && errors.push(m.text()));
    page.on("pageerror", (e) => errors.push(e.message));
    await page.goto(pathToFileURL(file).href);
    await page.locator(".explorer").scrollIntoViewIfNeeded();
  });
  afterAll(async () => {
    await browser.close();
    rmSync(folder, { recursive: true, force: true });
  });

  it("marks a place of the plot in the comb, with its numbers", async () => {
    const { s, k } = await data();
    const at = await inPlot(0.5);
    await page.mouse.move(at.x, at.y);
    const i = await marked();
    expect(Math.abs((s[i] as number) / (s.at(-1) as number) - 0.5)).toBeLessThan(0.01);
    const said = (await told())?.replace(/\u2212/g, "-") ?? "";
    expect(said).toContain(`s ${(s[i] as number).toPrecision(4)}`);
    expect(said).toContain(`curvature ${(k[i] as number).toFixed(2 - Math.floor(Math.log10(Math.abs(k[i] as number))))}`);
    expect(said).toMatch(/piece \d+: /);
    if (pictures) await page.screenshot({ path: join(pictures, "report-marked.png") });
  });

  it("zooms both together, and goes by keys", async () => {
    await page.locator(".explorer .plot").focus();
    const before = await marked();
    await page.keyboard.press("ArrowRight");
    expect(await marked()).toBe(before + 1);
    const [from, to] = (await range()) as [number, number];
    await page.keyboard.press("+");
    await page.keyboard.press("+");
    const [low, high] = (await range()) as [number, number];
    expect((high - low) / (to - from)).toBeCloseTo(1 / 1.6 ** 2, 6);
    const { s } = await data();
    expect(s[before] as number).toBeGreaterThan(low);
    expect(s[before] as number).toBeLessThan(high);
    // the same place of the smaller range under the same pixel
    const at = await inPlot(0.25);
    await page.mouse.move(at.x, at.y);
    expect(Math.abs((s[await marked()] as number) - (low + 0.25 * (high - low)))).toBeLessThan(0.01 * (high - low));
    if (pictures) await page.screenshot({ path: join(pictures, "report-zoomed.png") });
    await page.mouse.down();
    await page.mouse.move(at.x - 80, at.y, { steps: 3 });
    await page.mouse.up();
    expect(((await range())[0] as number)).toBeGreaterThan(low);
    await page.click(".controls button:nth-child(3)");
    expect(await range()).toEqual([from, to]);
  });

  it("shows its figures on paper and without a script", async () => {
    expect(await page.locator("figure.still").first().isVisible()).toBe(false);
    await page.emulateMedia({ media: "print" });
    expect(await page.locator("figure.still").first().isVisible()).toBe(true);
    expect(await page.locator(".explorer").isVisible()).toBe(false);
    const plain = await (await browser.newContext({ javaScriptEnabled: false })).newPage();
    await plain.goto(pathToFileURL(file).href);
    expect(await plain.locator("figure.still").count()).toBe(2);
    expect(await plain.locator("figure.still").first().isVisible()).toBe(true);
    expect(await plain.locator(".explorer").isVisible()).toBe(false);
  });

  it("runs nothing that its policy does not name", async () => {
    expect(errors).toEqual([]);
    await page.evaluate(() => {
      const script = document.createElement("script");
      script.textContent = "document.title = 'changed'";
      document.body.append(script);
    });
    expect(await page.title()).not.toBe("changed");
  });
});
