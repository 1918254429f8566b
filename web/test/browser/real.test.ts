/** Real files of ../shared/data, where that is there: a scan faired, a sketch traced. */
import { existsSync } from "node:fs";
import { join } from "node:path";
import { describe, expect, it } from "vitest";
import { onStage, settled, source } from "./studio.ts";

const data = join(source, "../shared/data");
const scan = join(data, "1_profiles/airfoil/su-26m.dat");
const sketch = join(data, "2_sketches/raster/mm_wagon_hole_06_0_clean.png");

if (!existsSync(scan) || !existsSync(sketch)) describe.skip("real files", () => it("are not there", () => {}));
else
  onStage("real files", [scan], (stage) => {
    it("a scanned airfoil is faired as the operation fairs it", async () => {
      const { page } = stage.at;
      const line = await page.evaluate(() => {
        const e = window.keyline.store.doc.entities[0];
        return e?.kind === "scan" ? e.line : null;
      });
      expect(line?.points.length).toBeGreaterThan(200);
      await page.click("#fair");
      await page.waitForSelector("#verdict");
      await settled(page);
      const faired = await stage.server.ask<{ curve: object; deviation: { max: number }; tolerance: number }>("fair", { line, criterion: "least-variation" });
      const told = await page.evaluate(() => {
        const e = window.keyline.store.doc.entities.find((x) => x.kind === "faired");
        return e?.kind === "faired" ? { curve: e.curve, max: e.told.max } : null;
      });
      expect(told).toEqual({ curve: faired.curve, max: faired.deviation.max });
    });

    it("a drawn wagon is traced into lines", async () => {
      const { page } = stage.at;
      const choosing = page.waitForEvent("filechooser");
      await page.click("#open");
      await (await choosing).setFiles(sketch);
      await page.click("#trace");
      await page.waitForFunction(() => window.keyline.store.doc.entities.some((e) => e.layer === "Sketch"));
      await settled(page);
      const lengths = await page.evaluate(() => window.keyline.store.doc.entities.filter((e) => e.layer === "Sketch")
        .map((e) => window.keyline.live.of(e.id)?.comb.length ?? 0));
      expect(lengths.length).toBeGreaterThan(0);
      expect(Math.min(...lengths)).toBeGreaterThan(0);
    });
  });
