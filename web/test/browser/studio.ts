/** A server of its own and a page in a browser, for one file of tests. */
import { type ChildProcess, spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { availableParallelism, loadavg, tmpdir } from "node:os";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { openBrowser, source, visit, type Visit } from "./open.ts";

export { openBrowser, source, visit, type Visit } from "./open.ts";

export const token = "0123456789abcdef";

/** Whether the machine has time for us alone: only then a measured time says something of us. */
export const isQuiet = (): boolean =>
  process.env["KEYLINE_TIMING"] !== undefined && (loadavg()[0] ?? 0) < 0.75 * availableParallelism();

export class Server {
  readonly state = mkdtempSync(join(tmpdir(), "keyline-state-"));
  private process: ChildProcess | null = null;
  url = "";

  async start(files: readonly string[] = [], port = 0): Promise<void> {
    const started = spawn(process.env.KEYLINE as string,
      ["studio", ...files, "--no-browser", "--token", token, "--port", String(port)],
      { cwd: source, env: { ...process.env, XDG_STATE_HOME: this.state }, stdio: ["ignore", "pipe", "inherit"] });
    this.process = started;
    this.url = await new Promise((resolve, reject) => {
      let said = "";
      started.stdout?.on("data", (text: Buffer) => {
        said += text.toString();
        const found = /(http:\S+)\n/.exec(said);
        if (found) resolve(found[1] as string);
      });
      started.on("exit", (code) => reject(new Error(`keyline studio ended with ${code}`)));
    });
  }

  get port(): number {
    return Number(new URL(this.url).port);
  }

  async end(signal: NodeJS.Signals = "SIGTERM"): Promise<number | null> {
    const process = this.process;
    this.process = null;
    if (!process || process.exitCode !== null) return null;
    return new Promise((resolve) => {
      process.on("exit", resolve);
      process.kill(signal);
    });
  }

  /** What the operation itself answers. */
  async ask<T>(op: string, request: object): Promise<T> {
    const reply = await fetch(new URL(`/api/v1/${op}`, this.url), {
      method: "POST", body: JSON.stringify(request),
      headers: { Authorization: `Bearer ${token}`, "Content-Type": "application/json" },
    });
    return ((await reply.json()) as { result: T }).result;
  }

  async remove(): Promise<void> {
    await this.end();
    rmSync(this.state, { recursive: true, force: true });
  }
}

/** Where a point of the model is on the page. */
export async function onPage(page: Page, point: readonly [number, number]): Promise<{ x: number; y: number }> {
  return page.evaluate(([x, y]) => {
    const box = (document.querySelector(".board") as HTMLElement).getBoundingClientRect();
    const at = window.keyline.view.toScreen([x, y] as [number, number]);
    return { x: box.left + at[0], y: box.top + at[1] };
  }, point);
}

export async function settled(page: Page): Promise<void> {
  await page.waitForFunction(() => window.keyline.live.settled && window.keyline.store.state.work === null);
}

/** What every file of tests has: a server, a browser, a page that was opened. */
export interface Stage {
  readonly server: Server;
  browser: Browser;
  at: Visit;
}

/** A server of its own with the files opened, a page of it, and at the end nothing it complained of. */
export function onStage(name: string, files: readonly string[], tests: (stage: Stage) => void,
                        excused: RegExp = /(?!)/): void {
  describe(name, () => {
    const stage = { server: new Server() } as Stage;
    beforeAll(async () => {
      await stage.server.start(files);
      stage.browser = await openBrowser();
      stage.at = await visit(stage.browser, stage.server.url);
    });
    afterAll(async () => {
      await stage.browser.close();
      await stage.server.remove();
    });
    tests(stage);
    it("complains of nothing", () => expect(stage.at.errors.filter((e) => !excused.test(e))).toEqual([]));
  });
}
