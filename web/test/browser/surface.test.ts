import { expect, it } from "vitest";
import { onStage, settled } from "./studio.ts";

interface Edited {
  surface: object;
  after: { sav: number };
}

onStage("a patch", ["examples/panel-b.json"], (stage) => {
  const painted = () => stage.at.page.evaluate(() => Number(document.querySelector<HTMLElement>(".space")?.dataset["painted"] ?? 0));
  const shows = async (value: number) =>
    stage.at.page.waitForFunction((wanted) => {
      const shown = Number(document.querySelector("#sav-value")?.textContent?.split(" ").at(-1)?.replace("\u2212", "-"));
      return Math.abs(shown - wanted) <= 1e-3 * Math.abs(wanted);
    }, value);
  const surface = () => stage.at.page.evaluate(() => {
    const e = window.keyline.store.doc.entities[0];
    return e?.kind === "surface" ? e.surface : null;
  });

  it("is shown in space with its value", async () => {
    const { page } = stage.at;
    const told = await stage.server.ask<{ sav: number; curves: unknown[] }>("surface.sav", { surface: await surface() });
    await shows(told.sav);
    expect(await page.locator("#sav tbody tr").count()).toBe(told.curves.length);
    await page.waitForFunction(() => Number(document.querySelector<HTMLElement>(".space")?.dataset["painted"] ?? 0) > 0);
  });

  it("shows what light and curvature show, and turns by keyboard", async () => {
    const { page } = stage.at;
    for (const look of ["mean", "reflection"]) {
      const before = await painted();
      await page.selectOption("#surface-look", look);
      await page.waitForFunction((n) => Number(document.querySelector<HTMLElement>(".space")?.dataset["painted"] ?? 0) > n, before);
    }
    const before = await painted();
    await page.locator(".space").focus();
    await page.keyboard.press("ArrowLeft");
    await page.waitForFunction((n) => Number(document.querySelector<HTMLElement>(".space")?.dataset["painted"] ?? 0) > n, before);
  });

  it("is edited to Class A as the operation edits it", async () => {
    const { page } = stage.at;
    await page.click("#network-A2");
    expect(await page.locator("#network-A2").getAttribute("aria-pressed")).toBe("true");
    const given = await surface();
    await page.click("#edit-surface");
    await page.waitForSelector("#surface-outcome");
    await settled(page);
    const edited = await stage.server.ask<Edited>("surface.edit", { surface: given, keep: "corners" });
    expect(await surface()).toEqual(edited.surface);
    await shows(edited.after.sav);
    await page.keyboard.press("Control+z");
    expect(await surface()).toEqual(given);
  });

  it("wipes between the patch as opened and as edited", async () => {
    const { page } = stage.at;
    await page.click("#edit-surface");
    await page.waitForSelector("#surface-outcome");
    await settled(page);
    const box = await page.locator(".space").boundingBox();
    if (!box) throw new Error("no view");
    /** Pictures of both sides, from 80 pixels off the middle on: the bar and its words stand there. */
    const sides = async (change: () => Promise<unknown>) => {
      const before = await painted();
      await change();
      await page.waitForFunction((n) => Number(document.querySelector<HTMLElement>(".space")?.dataset["painted"] ?? 0) > n, before);
      await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
      const half = { y: box.y, width: box.width / 2 - 80, height: box.height };
      const at = async (x: number) => (await page.screenshot({ clip: { ...half, x } })).toString("base64");
      return { left: await at(box.x), right: await at(box.x + box.width / 2 + 80) };
    };
    await page.mouse.move(5, 795);
    const after = await sides(() => page.selectOption("#surface-look", "zebra"));
    const before = await sides(() => page.check("#surface-before"));
    expect(before.left).not.toBe(after.left);
    expect(before.right).not.toBe(after.right);
    await sides(() => page.uncheck("#surface-before"));
    const bar = page.locator(".wipe-bar");
    expect(await bar.isVisible()).toBe(false);
    const wiped = await sides(() => page.keyboard.press("w"));
    expect(wiped.left).toBe(before.left);
    expect(wiped.right).toBe(after.right);
    await bar.focus();
    await page.keyboard.press("Home");
    expect(await bar.getAttribute("aria-valuenow")).toBe("0");
    await page.keyboard.press("Shift+ArrowRight");
    await page.keyboard.press("ArrowRight");
    expect(await bar.getAttribute("aria-valuenow")).toBe("11");
    const grip = await page.locator(".wipe-bar .grip").boundingBox();
    if (!grip) throw new Error("no grip");
    await page.mouse.move(grip.x + grip.width / 2, grip.y + grip.height / 2);
    await page.mouse.down();
    await page.mouse.move(box.x + 0.75 * box.width, box.y + 100, { steps: 3 });
    await page.mouse.up();
    expect(await bar.getAttribute("aria-valuenow")).toBe("75");
    await page.uncheck("#surface-wipe");
    expect(await bar.isVisible()).toBe(false);
    await page.click("#restore-surface");
    await settled(page);
  });

  it("puts a network curve where a hand puts it in its plane", async () => {
    const { page } = stage.at;
    await page.waitForSelector("#network-A1");
    if ((await page.locator("#network-A1").getAttribute("aria-pressed")) !== "true") await page.click("#network-A1");
    const plane = page.locator("#network-plane canvas");
    await plane.scrollIntoViewIfNeeded();
    await page.waitForFunction(() => {
      const canvas = document.querySelector<HTMLCanvasElement>("#network-plane canvas");
      const pixels = canvas?.getContext("2d")?.getImageData(0, 0, canvas.width, canvas.height).data ?? [];
      return new Set(pixels).size > 40; // contours are there
    });
    const box = await plane.boundingBox();
    if (!box) throw new Error("no plane");
    const asked = page.waitForRequest("**/api/v1/surface.edit");
    await page.mouse.move(box.x + 0.45 * box.width, box.y + 0.45 * box.height);
    await page.mouse.down();
    await page.mouse.move(box.x + 0.5 * box.width, box.y + 0.4 * box.height, { steps: 3 });
    await page.mouse.up();
    const { conditions } = (await asked).postDataJSON() as { conditions: { curve: string; alpha: [number, number]; s: [number, number] }[] };
    const [condition] = conditions.filter((c) => c.curve === "A1");
    expect(condition?.alpha[0]).toBeGreaterThan(0.3);
    expect(condition?.alpha[0]).toBe(condition?.alpha[1]);
    await page.waitForSelector("#surface-outcome");
    await settled(page);
    await page.keyboard.press("Control+z");
  });

  it("draws where patches meet, and how well", async () => {
    const { page } = stage.at;
    // another patch that goes on over the first row: mirrored at each of its points, so that no fold is there
    const pair = await page.evaluate(() => {
      const { store } = window.keyline;
      const e = store.doc.entities[0];
      if (e?.kind !== "surface") throw new Error("no surface");
      const [first] = e.surface.points as number[][][];
      const points = (e.surface.points as number[][][]).map((row) =>
        row.map((p, j) => p.map((v, k) => 2 * ((first?.[j] as number[])[k] as number) - v)));
      const other = { ...e, id: 2, name: "other", surface: { ...e.surface, points } } as typeof e;
      store.commit("Test", { ...store.doc, next: 3, entities: [...store.doc.entities, other] });
      return [e.surface, other.surface];
    });
    const told = await stage.server.ask<{ order: string }>("surface.continuity", { surfaces: pair });
    expect(["G1", "G2", "G3"]).toContain(told.order);
    await page.waitForFunction(() => (window.keyline as unknown as { surfaces: { joints: unknown[] } }).surfaces.joints.length > 0);
    const drawn = await page.evaluate(() =>
      (window.keyline as unknown as { surfaces: { joints: { order: string }[] } }).surfaces.joints.map((joint) => joint.order));
    expect(drawn).toEqual([told.order]);
    await page.uncheck("#surface-joints");
    expect(await page.evaluate(() => (window.keyline as unknown as { surfaces: { joints: unknown[] } }).surfaces.joints.length)).toBe(0);
    if (process.env["KEYLINE_PICTURES"]) {
      await page.check("#surface-joints");
      await page.screenshot({ path: `${process.env["KEYLINE_PICTURES"]}/joints.png` });
    }
    await page.keyboard.press("Control+z");
  });
});

onStage("a skin of several patches", ["examples/skin.json"], (stage) => {
  it("lists the curves of one patch at a time, the worst first", async () => {
    const { page } = stage.at;
    const surface = await page.evaluate(() => {
      const e = window.keyline.store.doc.entities[0];
      return e?.kind === "surface" ? e.surface : null;
    });
    interface Value { curves: { name: string; cav: number; patch: number[] }[]; patches: { patch: number[]; sav: number }[]; worst_patch: number[] }
    const told = await stage.server.ask<Value>("surface.sav", { surface });
    const listed = () => page.locator("#sav tbody tr").evaluateAll((rows) => rows.map((row) =>
      [row.children[0]?.textContent, Number(row.children[2]?.textContent)]));
    const expected = (patch: number[]) => told.curves.filter((c) => String(c.patch) === String(patch))
      .map((c) => [c.name, Number(c.cav.toPrecision(3))]);
    await page.waitForSelector("#patch");
    expect(await listed()).toEqual(expected(told.worst_patch));
    const least = [...told.patches].sort((a, b) => a.sav - b.sav)[0]?.patch ?? [];
    await page.selectOption("#patch", least.join(", "));
    expect(await listed()).toEqual(expected(least));
    expect(told.patches.length).toBe(6);
  });
});
