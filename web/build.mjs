// build.mjs OUT [MODULE]: the page as static files in OUT. three.js is a chunk of its own, loaded when
// a surface is shown. With MODULE, the folder of keyline.mjs and keyline.wasm, the page needs no server.
import { build } from "esbuild";
import { cpSync, mkdirSync, rmSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const out = process.argv[2] ?? join(here, "dist");
const module = process.argv[3];

rmSync(out, { recursive: true, force: true });
mkdirSync(out, { recursive: true });
await build({
  entryPoints: {
    studio: join(here, module ? "src/static.ts" : "src/main.ts"),
    style: join(here, "src/style.css"),
    ...(module && { worker: join(here, "src/worker.ts") }),
  },
  bundle: true,
  splitting: true,
  format: "esm",
  target: ["es2022"],
  minify: true,
  charset: "utf8",
  legalComments: "none",
  chunkNames: "chunk-[hash]",
  outdir: out,
  logLevel: "warning",
});
cpSync(join(here, "src/index.html"), join(out, "index.html"));
cpSync(join(here, "src/icon.svg"), join(out, "icon.svg"));
if (module) {
  for (const file of ["keyline.mjs", "keyline.wasm"]) cpSync(join(module, file), join(out, file));
  cpSync(join(here, "../examples/bonnet-scan.csv"), join(out, "bonnet-scan.csv")); // index.html#open=bonnet-scan.csv
}
