// Serves web/dist on a free port of this machine.
import http from "node:http";
import fs from "node:fs/promises";
import path from "node:path";

const TYPES = { ".html": "text/html; charset=utf-8", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm" };
export const dist = path.join(import.meta.dirname, "..", "dist");

export async function serve() {
  const server = http.createServer(async (request, response) => {
    const name = path.basename(new URL(request.url, "http://x").pathname) || "index.html";
    try {
      const bytes = await fs.readFile(path.join(dist, name));
      response.writeHead(200, { "content-type": TYPES[path.extname(name)] ?? "application/octet-stream" }).end(bytes);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  return { address: `http://127.0.0.1:${server.address().port}/`, close: () => server.close() };
}
