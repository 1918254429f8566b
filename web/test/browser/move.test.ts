/** Curves of a file moved by hand: band, drag, snap, turn, scale, nudge, numbers; undone, kept, exported. */
import { readFileSync } from "node:fs";
import type { Page } from "playwright-core";
import { expect, it } from "vitest";
import type { Point } from "../../src/model/document.ts";
import { onPage, onStage, settled } from "./studio.ts";

const arch = { type: "bezier", points: [[0, 0], [10, 40], [50, 40], [60, 0]] };
const chain = {
  type: "log-aesthetic", start: [90, 0], direction: 0.2,
  pieces: [{ alpha: -1, length: 50, curvature: [0.04, 0.01] }, { alpha: 1, length: 40, curvature: [0.01, 0.03] }],
};
const line = { type: "polyline", points: [[0, 70], [60, 70]] };
const file = { curves: [{ name: "arch", curve: arch }, { name: "chain", curve: chain }, { name: "line", curve: line }] };

onStage("moving curves of a file", [], (stage) => {
  const named = (name: string) => stage.at.page.evaluate((n) => {
    const e = window.keyline.store.state.history.now.entities.find((x) => x.name === n);
    const shown = e && window.keyline.live.of(e.id);
    return { id: e?.id ?? 0, placed: e?.kind === "fixed" ? e.placed ?? null : null, curve: shown?.curve, start: shown?.comb.points[0], ends: shown?.comb.points.at(-1) };
  }, name);
  const steps = () => stage.at.page.evaluate(() => window.keyline.store.state.history.past.length);
  const chosen = () => stage.at.page.evaluate(() => window.keyline.store.state.selection.map((id) =>
    window.keyline.store.doc.entities.find((e) => e.id === id)?.name));
  const choose = (...names: string[]) => stage.at.page.evaluate((all) => {
    const { store } = window.keyline;
    store.set({ selection: store.doc.entities.filter((e) => all.includes(e.name)).map((e) => e.id) });
  }, names);

  async function drag(page: Page, from: { x: number; y: number }, to: { x: number; y: number }, finish = true): Promise<void> {
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    await page.mouse.move((from.x + to.x) / 2, (from.y + to.y) / 2, { steps: 3 });
    await page.mouse.move(to.x, to.y, { steps: 3 });
    if (!finish) return;
    await page.mouse.up();
    await settled(page);
  }
  const dragModel = async (from: Point, to: Point, finish = true) =>
    drag(stage.at.page, await onPage(stage.at.page, from), await onPage(stage.at.page, to), finish);

  it("opens them and chooses by band: within to the right, touched to the left", async () => {
    const { page } = stage.at;
    const choosing = page.waitForEvent("filechooser");
    await page.click("#open");
    await (await choosing).setFiles({ name: "three.json", mimeType: "application/json", buffer: Buffer.from(JSON.stringify(file)) });
    await page.waitForFunction(() => window.keyline.store.doc.entities.length === 3);
    await settled(page);
    await page.evaluate(() => window.keyline.view.fit({ low: [-30, -60], high: [220, 120] }, { left: 20, top: 20, right: 20, bottom: 20 }));
    await dragModel([-15, -20], [80, 80]);
    expect(await chosen()).toEqual(["arch", "line"]);
    await dragModel([-20, 40], [70, 80]);
    expect(await chosen()).toEqual(["line"]);
    await dragModel([100, 60], [30, 20]);
    expect(await chosen()).toEqual(["arch"]);
    await page.keyboard.down("Shift");
    await dragModel([150, 30], [112, 5]);
    await page.keyboard.up("Shift");
    expect(await chosen()).toEqual(["arch", "chain"]);
    expect(await steps()).toBe(2); // the example, the file
  });

  it("drags a curve, chosen or not, as one step; Escape puts it back", async () => {
    const { page } = stage.at;
    await choose();
    await dragModel([30, 30], [50, 15], false);
    await page.keyboard.press("Escape");
    await page.mouse.up();
    await settled(page);
    expect((await named("arch")).placed).toBeNull();
    await choose();
    await dragModel([30, 30], [50, 15]);
    expect(await chosen()).toEqual(["arch"]);
    const { placed, curve, start } = await named("arch");
    expect(placed?.shift[0]).toBeCloseTo(20, 0);
    expect(placed?.shift[1]).toBeCloseTo(-15, 0);
    expect(curve).toEqual((await stage.server.ask<{ curve: object }>("curve.transform", { curve: arch, ...placed })).curve);
    expect(start?.[0]).toBeCloseTo(placed?.shift[0] ?? 0, 9);
    expect(await steps()).toBe(3);
    await page.keyboard.press("Control+z");
    await settled(page);
    expect((await named("arch")).curve).toEqual(arch);
  });

  it("snaps an end to an end of another", async () => {
    const { page } = stage.at;
    await page.keyboard.press("n");
    const near: Point = [90 - 60 + 1, 1.5]; // the arch's end comes to lie beside the chain's start
    await dragModel([30, 30], [30 + near[0], 30 + near[1]]);
    await page.keyboard.press("n");
    const { ends } = await named("arch");
    expect(ends?.[0]).toBeCloseTo(90, 9);
    expect(ends?.[1]).toBeCloseTo(0, 9);
    await page.keyboard.press("Control+z");
    await settled(page);
  });

  const parts = () => stage.at.page.evaluate(() => {
    const box = (document.querySelector(".board") as HTMLElement).getBoundingClientRect();
    const onScreen = (p: number[]) => ({ x: box.left + (p[0] ?? 0), y: box.top + (p[1] ?? 0) });
    const seen = window.keyline.canvas.parts();
    return seen && { corners: seen.corners.map(onScreen), turner: onScreen(seen.turner), pivot: onScreen(seen.pivot) };
  });

  it("turns about the pivot, which can be put elsewhere", async () => {
    const { page } = stage.at;
    await choose("chain");
    const seen = await parts();
    if (!seen) throw new Error("no box");
    await drag(page, seen.pivot, await onPage(page, [91, 1])); // drawn to the curve's start
    expect(await steps()).toBe(2); // the pivot is no part of the document
    const at = await parts();
    if (!at) throw new Error("no box");
    const start = await onPage(page, [90, 0]);
    expect(Math.hypot(at.pivot.x - start.x, at.pivot.y - start.y)).toBeLessThan(0.5);
    const arm = { x: at.turner.x - start.x, y: at.turner.y - start.y };
    await page.keyboard.down("Shift");
    // a little more than a quarter turn, clockwise on the screen: caught at 90 degrees
    await drag(page, at.turner, { x: start.x - arm.y + 0.05 * arm.x, y: start.y + arm.x + 0.05 * arm.y });
    await page.keyboard.up("Shift");
    const { placed, curve } = await named("chain");
    expect(placed?.turn).toBeCloseTo(-Math.PI / 2, 12);
    const made = curve as unknown as typeof chain;
    expect(made.start[0]).toBeCloseTo(90, 9);
    expect(made.start[1]).toBeCloseTo(0, 9);
    expect(Math.sin(made.direction - (0.2 - Math.PI / 2))).toBeCloseTo(0, 12);
    expect(made.pieces.map((p) => p.length)).toEqual([50, 40]);
  });

  it("scales by a corner, several together, mirror images with them", async () => {
    const { page } = stage.at;
    await choose("arch", "line");
    const seen = await parts();
    if (!seen) throw new Error("no box");
    const corner = seen.corners[1] as { x: number; y: number };
    await page.keyboard.down("Shift");
    await drag(page, corner, { x: seen.pivot.x + 1.49 * (corner.x - seen.pivot.x), y: seen.pivot.y + 1.49 * (corner.y - seen.pivot.y) });
    await page.keyboard.up("Shift");
    const [one, other] = [await named("arch"), await named("line")];
    expect(one.placed?.scale).toBeCloseTo(1.5, 12);
    expect(other.placed?.scale).toBeCloseTo(1.5, 12);
    // about the middle of both, (30, 35): the ends of the line by hand
    expect(other.start?.[0]).toBeCloseTo(30 - 45, 6);
    expect(other.ends?.[0]).toBeCloseTo(30 + 45, 6);
    expect(other.start?.[1]).toBeCloseTo(35 + 1.5 * 35, 6);
    await page.keyboard.press("Control+z");
    await settled(page);
    expect((await named("line")).placed).toBeNull();
  });

  it("nudges by arrows and takes numbers", async () => {
    const { page } = stage.at;
    await choose("line");
    const before = await steps();
    await page.locator(".board").focus();
    await page.keyboard.down("Alt");
    for (let i = 0; i < 4; ++i) await page.keyboard.down("ArrowRight"); // held down: repeats
    await page.keyboard.up("ArrowRight");
    await page.keyboard.up("Alt");
    await settled(page);
    expect(await steps()).toBe(before + 1);
    const scale = await page.evaluate(() => window.keyline.view.scale);
    expect((await named("line")).placed?.shift[0]).toBeCloseTo(4 / scale, 9);
    for (const [field, value] of [["x", "12,5"], ["y", "\u22123"], ["turn", "30"], ["scale", "2"]] as const) {
      await page.fill(`#place-${field}`, value);
      await page.keyboard.press("Tab");
      await settled(page);
    }
    const { placed } = await named("line");
    expect(placed).toEqual({ about: [30, 70], shift: [12.5, -3], turn: Math.PI / 6, scale: 2 });
    await page.fill("#place-scale", "0");
    await page.keyboard.press("Tab");
    expect(await page.inputValue("#place-scale")).toBe("2");
  });

  it("is held by its control points after a double click", async () => {
    const { page } = stage.at;
    const there = await onPage(page, [30, 30]);
    await page.mouse.dblclick(there.x, there.y);
    await settled(page);
    expect(await page.isChecked("#control-points")).toBe(true);
    await dragModel([10, 40], [20, 45]);
    const { curve } = await named("arch");
    const [start, moved, ...rest] = (curve as unknown as typeof arch).points;
    expect([start, ...rest]).toEqual([[0, 0], [50, 40], [60, 0]]);
    expect(moved?.[0]).toBeCloseTo(20, 0);
    expect(moved?.[1]).toBeCloseTo(45, 0);
    const length = (await stage.server.ask<{ comb: { length: number } }>("curve.show", { curve, comb: { samples: 11 } })).comb.length;
    expect(await page.evaluate(() => window.keyline.live.of(window.keyline.store.state.selection[0] ?? 0)?.comb.length)).toBeCloseTo(length, 9);
    await page.keyboard.press("Control+z");
    await page.keyboard.press("Control+z");
    await settled(page);
    expect((await named("arch")).curve).toEqual(arch);
  });

  it("is kept, and exported as it stands", async () => {
    const { page, context } = stage.at;
    const wanted = await Promise.all(["arch", "chain", "line"].map(named));
    await page.selectOption("#export", "json");
    const download = page.waitForEvent("download");
    const text = readFileSync(await (await download).path(), "utf8");
    const written = (JSON.parse(text) as { curves: { name: string; curve: object }[] }).curves;
    expect(written.map((c) => c.curve)).toEqual(wanted.map((w) => w.curve));
    await page.waitForFunction(() => window.keyline.autosave.settled);
    const again = await context.newPage();
    await again.goto(stage.server.url);
    await again.waitForFunction(() => window.keyline?.live.settled && window.keyline.store.doc.entities.length === 3);
    const there = await again.evaluate(() => window.keyline.store.doc.entities.map((e) => (e.kind === "fixed" ? e.placed : null) ?? null));
    expect(there).toEqual(wanted.map((w) => w.placed));
    await again.close();
    await choose("line");
    await page.click("#put-back");
    await settled(page);
    expect((await named("line")).curve).toEqual(line);
  });

  it("follows the hand with many at once, and what is made of them", async () => {
    const { page } = stage.at;
    await choose("arch");
    await page.click("#mirror");
    await settled(page);
    await choose("arch", "chain", "line");
    await dragModel([30, 30], [40, 20]);
    const image = await page.evaluate(() => {
      const { store, live } = window.keyline;
      const e = store.doc.entities.find((x) => x.kind === "mirror");
      const of = store.doc.entities.find((x) => x.name === "arch");
      return { image: live.of(e?.id ?? 0)?.comb.points[0], start: live.of(of?.id ?? 0)?.comb.points[0] };
    });
    // the axis stands upright where the arch ended, at x = 60
    expect(image.image?.[0]).toBeCloseTo(120 - (image.start?.[0] ?? 0), 9);
    expect(image.image?.[1]).toBeCloseTo(image.start?.[1] ?? 0, 9);
    // let go, the image stays where it is and has a place of its own
    await page.evaluate(() => {
      const { store } = window.keyline;
      store.set({ selection: store.doc.entities.filter((e) => e.kind === "mirror").map((e) => e.id) });
    });
    await page.click("#let-go");
    await page.fill("#place-x", "7");
    await page.keyboard.press("Tab");
    await settled(page);
    const own = await page.evaluate(() => {
      const { store, live } = window.keyline;
      const id = store.state.selection[0] ?? 0;
      return { kind: store.doc.entities.find((e) => e.id === id)?.kind, start: live.of(id)?.comb.points[0] };
    });
    expect(own.kind).toBe("fixed");
    expect(own.start?.[0]).toBeCloseTo((image.image?.[0] ?? 0) + 7, 9);
  });

  it("lists sixty curves beside what belongs to the chosen one", async () => {
    const { page } = stage.at;
    const curves = Array.from({ length: 60 }, (_, i) => ({
      name: `a name too long for the list ${i}`, curve: { type: "polyline", points: [[20 * i, 900], [20 * i, 1000]] },
    }));
    const choosing = page.waitForEvent("filechooser");
    await page.click("#open");
    await (await choosing).setFiles({ name: "sixty.json", mimeType: "application/json", buffer: Buffer.from(JSON.stringify({ curves })) });
    await page.waitForFunction(() => window.keyline.store.doc.entities.length >= 60);
    await settled(page);
    // the first of them came before the last, but all are in sight
    const board = await page.locator(".board").boundingBox();
    for (const end of [[0, 900], [1180, 1000]] as const) {
      const { x, y } = await onPage(page, end);
      expect(x > (board?.x ?? 0) && x < (board?.x ?? 0) + (board?.width ?? 0)).toBe(true);
      expect(y > (board?.y ?? 0) && y < (board?.y ?? 0) + (board?.height ?? 0)).toBe(true);
    }
    const shown = (name: string) => page.evaluate((n) => {
      const id = window.keyline.store.doc.entities.find((e) => e.name === n)?.id;
      const row = document.getElementById(`entity-${id}`);
      const list = document.querySelector("#things")?.getBoundingClientRect(), at = row?.getBoundingClientRect();
      const end = row?.querySelector(".shortened :last-child")?.getBoundingClientRect();
      return {
        listed: !!list && !!at && at.top >= list.top - 1 && at.bottom <= list.bottom + 1,
        number: !!end && !!at && end.width > 0 && end.right <= at.right + 1,
        place: (document.querySelector("#place-x")?.getBoundingClientRect().bottom ?? Infinity) < window.innerHeight,
      };
    }, name);
    const last = "a name too long for the list 59", before = "a name too long for the list 58";
    await choose(last);
    expect(await shown(last)).toEqual({ listed: true, number: true, place: true });
    // what is done to another row leaves the list where it is
    await page.click(`[aria-label="Hide ${before}"]`);
    expect(await shown(last)).toEqual({ listed: true, number: true, place: true });
    await choose("a name too long for the list 0");
    expect((await shown("a name too long for the list 0")).listed).toBe(true);
    expect((await shown(last)).listed).toBe(false);
  });
});
