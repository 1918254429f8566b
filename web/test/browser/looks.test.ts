/**
 * Every panel, light and dark, held against axe-core's rules. With KEYLINE_PICTURES=FOLDER also
 * pictures of all of them at 1440 x 900, 1280 x 800 and the size of a tablet, for somebody to look at.
 */
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import type { Page } from "playwright-core";
import { expect, it } from "vitest";
import { onStage, settled, source, type Stage } from "./studio.ts";

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const pictures = process.env["KEYLINE_PICTURES"];
const kSizes = { wide: [1440, 900], usual: [1280, 800], tablet: [1024, 768], upright: [768, 1024] } as const;

interface Finding {
  id: string;
  impact: string | null;
  nodes: { html: string; failureSummary?: string }[];
}

/** Nothing that axe-core calls serious or critical. */
async function sound(page: Page): Promise<void> {
  await page.evaluate(axe); // not as a script: the page's policy allows none but its own
  const found = await page.evaluate(async () => {
    const { axe: checker } = window as unknown as { axe: { run(): Promise<{ violations: Finding[] }> } };
    return (await checker.run()).violations.filter((v) => v.impact === "serious" || v.impact === "critical")
      .map((v) => `${v.id}: ${v.nodes.map((n) => n.html.slice(0, 120)).join(" | ")}`);
  });
  expect(found).toEqual([]);
}

async function looked(page: Page, name: string): Promise<void> {
  for (const theme of ["dark", "light"] as const) {
    await page.evaluate((t) => window.keyline.store.look({ theme: t }), theme);
    if (pictures)
      for (const [size, [width, height]] of Object.entries(kSizes)) {
        await page.setViewportSize({ width, height });
        await page.evaluate(async () => {
          window.keyline.fit();
          await new Promise((painted) => requestAnimationFrame(() => requestAnimationFrame(painted)));
        });
        await page.screenshot({ path: join(pictures, `${name}-${size}-${theme}.png`) });
      }
    await sound(page);
  }
}

function panel(name: string, files: readonly string[], prepare: (stage: Stage) => Promise<void>): void {
  onStage(`the look of ${name}`, files, (stage) => {
    it("has no serious fault", async () => {
      await prepare(stage);
      await settled(stage.at.page);
      await looked(stage.at.page, name);
    });
  });
}

panel("drawing", [], async ({ at: { page } }) => {
  await page.keyboard.press("e");
});
panel("class-a", ["examples/cubic.json"], async ({ at: { page } }) => {
  await page.click("#class-a-panel summary");
  await page.click("#slide");
  await page.waitForSelector("#amount");
});
panel("fairing", ["examples/bonnet-scan.csv"], async ({ at: { page } }) => {
  await page.click("#fair");
  await page.waitForSelector("#verdict");
  await page.keyboard.press("d");
});
panel("surface", ["examples/panel-c.json"], async ({ at: { page } }) => {
  await page.waitForSelector("#network-A1");
  await page.click("#network-A1");
  await page.waitForFunction(() => Number(document.querySelector<HTMLElement>(".space")?.dataset["painted"] ?? 0) > 0);
});
panel("a sketch", [], async ({ at: { page } }) => {
  const choosing = page.waitForEvent("filechooser");
  await page.click("#open");
  await (await choosing).setFiles(join(source, "examples/sketch.png"));
  await page.waitForSelector("#trace");
  await page.click("#regions summary");
  await page.click(".cell");
});
panel("symmetry", ["examples/bonnet-scan.csv"], async ({ at: { page } }) => {
  await page.selectOption("#symmetric", "line");
  await page.waitForSelector("#symmetry-line");
});
panel("the keys", [], async ({ at: { page } }) => {
  await page.keyboard.press("?");
  await page.waitForSelector("dialog[open]");
});
