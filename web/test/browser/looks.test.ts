/**
 * Every panel, light and dark, held against axe-core's rules. With KEYLINE_PICTURES=FOLDER also
 * pictures of all of them at 1440 x 900, 1280 x 800 and the size of a tablet, and tall enough for the
 * whole of the panel, for somebody to look at.
 */
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import type { Page } from "playwright-core";
import { expect, it } from "vitest";
import { onStage, settled, source, type Stage } from "./studio.ts";

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const pictures = process.env["KEYLINE_PICTURES"];
const kSizes = { wide: [1440, 900], usual: [1280, 800], tablet: [1024, 768], upright: [768, 1024], whole: [1280, 1900] } as const;

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
        await page.evaluate(async () => { // what was fitted is fitted again
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
panel("a surface wiped", ["examples/panel-b.json"], async ({ at: { page } }) => {
  await page.click("#edit-surface");
  await page.waitForSelector("#surface-outcome");
  await page.selectOption("#surface-look", "mean");
  await page.check("#surface-wipe");
  await page.waitForSelector(".wipe-bar:not([hidden])");
});
const arch = { type: "bezier", points: [[0, 0], [10, 40], [50, 40], [60, 0]] };
const shifted = { about: [30, 15], turn: 0.4, scale: 1.2, shift: [12.5, -8] };
const common = { layer: "Curves", visible: true, locked: false, color: "" };
/** Things put there, the last so many of them chosen. */
const put = async (page: Page, things: readonly object[], chosen = 1) => {
  await page.evaluate(({ entities, count }) => {
    const { store } = window.keyline;
    store.commit("Test", { unit: "mm", next: entities.length + 1, layers: [{ name: "Curves", visible: true, locked: false }], entities } as never,
      { selection: entities.map((_, i) => i + 1).slice(-count) });
  }, { entities: things.map((thing, i) => ({ ...common, id: i + 1, ...thing })), count: chosen });
  await settled(page);
};
const handles = [[80, 0], [150, 0], [170, 60]];
const drawn = [
  { kind: "compound", name: "Compound 1", points: handles, alpha: [-1, 1], ratio: 0.5 },
  { kind: "segment", name: "Segment with a name that is rather long for its row", points: [[200, 80], [240, 80], [260, 110]], alpha: 0 },
];
panel("a curve placed", [], async ({ at: { page } }) => put(page, [{ kind: "fixed", name: "arch", curve: arch, placed: shifted, held: true }]));
panel("several curves", [], async ({ at: { page } }) => {
  await put(page, [...drawn, { kind: "fixed", name: "arch", curve: arch }], 2);
  await page.keyboard.press("j");
});
panel("two curves wiped", [], async ({ at: { page } }) => {
  await put(page, [{ ...drawn[0] }, { ...drawn[0], name: "Compound 2", alpha: [0, 2], points: [[80, 0], [150, 4], [170, 60]] }], 2);
  await page.keyboard.press("w");
});
panel("compound", [], async ({ at: { page } }) => put(page, [drawn[1] as object, drawn[0] as object]));
panel("a blend", [], async ({ at: { page } }) =>
  put(page, [...drawn, { kind: "blend", name: "Blend 1\u20132", of: [1, 2], ends: ["end", "start"], order: "G2", alpha: -1 }]));
panel("quasi", [], async ({ at: { page } }) =>
  put(page, [{ kind: "quasi", name: "Quasi 1", points: handles, alpha: -1, form: "best", degree: 6 }]));
panel("a spline", [], async ({ at: { page } }) =>
  put(page, [{ kind: "spline", name: "Spline 1", points: [[0, 0], [40, 50], [90, 10], [130, 60]], alpha: -1, closed: true }]));
panel("what cannot be drawn", [], async ({ at: { page } }) => {
  await put(page, [{ kind: "segment", name: "Segment 1", points: [[0, 0], [200, 0], [200.5, 30]], alpha: 2 }]);
  await page.waitForSelector("#failure");
});
panel("nothing", [], async ({ at: { page } }) => put(page, []));
panel("traced lines", [], async ({ at: { page } }) => {
  const choosing = page.waitForEvent("filechooser");
  await page.click("#open");
  await (await choosing).setFiles(join(source, "examples/sketch.png"));
  await page.click("#trace");
  await page.waitForFunction(() => window.keyline.store.doc.entities.some((e) => e.layer === "Sketch"));
  await settled(page);
});
panel("symmetry", ["examples/bonnet-scan.csv"], async ({ at: { page } }) => {
  await page.selectOption("#symmetric", "line");
  await page.waitForSelector("#symmetry-line");
});
panel("the keys", [], async ({ at: { page } }) => {
  await page.keyboard.press("?");
  await page.waitForSelector("dialog[open]");
});
