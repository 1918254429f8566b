/** A module of its own, off the page's thread: what it is asked takes as long as it takes. */
import type { Question, Said } from "./api/lane.ts";

/** What Emscripten makes of bindings/wasm. */
interface Keyline {
  ccall(name: string, returns: "string", takes: string[], given: string[]): string;
  FS: { writeFile(name: string, content: Uint8Array): void; readFile(name: string): Uint8Array };
}
interface Settings {
  onProgress(fraction: number, doing: string): void;
}
type Create = (settings: Settings) => Promise<Keyline>;

const say = (said: Said) => postMessage(said);
let asked = 0;

async function load(): Promise<Keyline> {
  const made = (await import(new URL("keyline.mjs", import.meta.url).href)) as { default: Create };
  return made.default({ onProgress: (fraction, doing) => say({ kind: "progress", id: asked, fraction, doing }) });
}

const loading = load();

function answer(keyline: Keyline, question: Question): void {
  asked = question.id;
  for (const [name, content] of question.files) keyline.FS.writeFile(name, content);
  const line = keyline.ccall("keyline_answer", "string", ["string"], [question.line]);
  const { ok } = JSON.parse(line) as { ok: boolean };
  const content = ok && question.wanted ? keyline.FS.readFile(question.wanted) : null;
  say({ kind: "answer", id: question.id, line, content });
}

onmessage = async (message) => {
  const keyline = await loading;
  // not here: what goes wrong is the worker's error, which ends it
  setTimeout(() => answer(keyline, message.data as Question));
};
const keyline = await loading;
say({ kind: "ready", operations: JSON.parse(keyline.ccall("keyline_operations", "string", [], [])) as string[] });
