/** A folder over HTTP, as any host of static files does it. */
import { readFileSync } from "node:fs";
import { createServer, type Server } from "node:http";
import { type AddressInfo } from "node:net";
import { extname, join } from "node:path";

const types: Record<string, string> = {
  ".html": "text/html", ".js": "text/javascript", ".mjs": "text/javascript", ".wasm": "application/wasm",
  ".css": "text/css", ".svg": "image/svg+xml",
};

export async function serve(folder: string): Promise<{ url: string; server: Server }> {
  const server = createServer((request, reply) => {
    const { pathname } = new URL(request.url ?? "/", "http://here");
    try {
      const content = readFileSync(join(folder, pathname === "/" ? "index.html" : pathname));
      reply.setHeader("Content-Type", types[extname(pathname)] ?? (pathname === "/" ? "text/html" : "application/octet-stream"));
      reply.end(content);
    } catch {
      reply.statusCode = 404;
      reply.end();
    }
  });
  await new Promise<void>((resolve) => server.listen(0, "127.0.0.1", resolve));
  return { url: `http://127.0.0.1:${(server.address() as AddressInfo).port}/`, server };
}
