// door.ts PAGE < REQUESTS: lines of JSON in, what the page without a server in the folder PAGE makes of
// them in Chromium as lines of JSON out.
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { openBrowser, source, visit } from "../browser/open.ts";
import { serve } from "./serve.ts";

type Request = { op: string; file?: string };

const folder = process.argv[2] as string;
const requests = readFileSync(0, "utf8").trim().split("\n").map((line) => JSON.parse(line) as Request);
const { url, server } = await serve(folder);
const browser = await openBrowser();
const { page } = await visit(browser, url);
for (const request of requests) {
  const given = typeof request.file === "string" && existsSync(join(source, request.file))
    ? readFileSync(join(source, request.file)).toString("base64") : "";
  // as text: what JSON cannot hold must not get lost on the way
  const answer = await page.evaluate(async ([text, content]) => {
    const { client } = window.keyline;
    const { op, ...fields } = JSON.parse(text as string) as { op: string; file?: string };
    if (content) {
      const bytes = Uint8Array.from(atob(content), (c) => c.charCodeAt(0));
      const kept = await client.upload(fields.file as string, new Blob([bytes]));
      if (kept.ok) fields.file = kept.result;
    }
    const said = await client.long(op, fields, () => {}).answer;
    return JSON.stringify(said.ok ? said : { ok: false, message: said.error.message });
  }, [JSON.stringify(request), given]);
  console.log(answer);
}
await browser.close();
server.close();
