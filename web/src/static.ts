/** The page without a server. */
import { LocalClient } from "./api/local.ts";
import { Studio } from "./studio.ts";

const opened = new URLSearchParams(location.hash.slice(1)).get("open") ?? "";
const worker = new URL("worker.js", import.meta.url);
const client = new LocalClient(() => new Worker(worker, { type: "module" }), opened);
window.keyline = new Studio(client, document.getElementById("studio") as HTMLElement);
void window.keyline.start();
