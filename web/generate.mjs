// generate.mjs KEYLINE: generated/operations.ts, the operations' types and defaults as KEYLINE tells
// them. The same text again does not look new to whoever reads it at the same time.
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, readFileSync, renameSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const folder = join(dirname(fileURLToPath(import.meta.url)), "generated");
const file = join(folder, "operations.ts");
const text = execFileSync(process.argv[2], ["operations", "--format", "typescript"], { maxBuffer: 1 << 26 });
mkdirSync(folder, { recursive: true });
if (!existsSync(file) || !readFileSync(file).equals(text)) {
  const beside = `${file}.${process.pid}`;
  writeFileSync(beside, text);
  renameSync(beside, file);
}
