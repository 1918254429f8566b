/** A page in a browser, for tests and for what is no test. */
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { type Browser, type BrowserContext, chromium, type Page } from "playwright-core";

export const source = join(dirname(fileURLToPath(import.meta.url)), "../../..");
const kPatience = 120_000; // ms: how fast the machine is, is not what is asked

/**
 * `space`: with WebGL, for surfaces. Its graphics card is emulated by one of the two cores, and everything flat is
 * painted by way of it too, frames of 300 ms among them: what is timed is timed without.
 */
export async function openBrowser(space = true): Promise<Browser> {
  return chromium.launch({
    executablePath: process.env.KEYLINE_CHROMIUM as string,
    args: ["--no-sandbox", ...(space ? ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"] : [])],
  });
}

export interface Visit {
  page: Page;
  context: BrowserContext;
  /** what the page complained of */
  errors: string[];
}

export async function visit(browser: Browser, url: string, size = { width: 1280, height: 800 }): Promise<Visit> {
  const context = await browser.newContext({ viewport: size, colorScheme: "dark", acceptDownloads: true });
  const page = await context.newPage();
  page.setDefaultTimeout(kPatience);
  const errors: string[] = [];
  page.on("pageerror", (e) => errors.push(e.message));
  page.on("console", (m) => {
    if (m.type() === "error") errors.push(m.text());
  });
  await page.goto(url);
  await page.waitForFunction(() => window.keyline?.live.settled && window.keyline.store.doc.entities.length > 0);
  return { page, context, errors };
}
