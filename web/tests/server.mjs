// Serves web/dist on a free port of this machine, compressed and cached as a host should do it.
import http from "node:http";
import fs from "node:fs/promises";
import path from "node:path";

const TYPES = { ".html": "text/html; charset=utf-8", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm", ".woff2": "font/woff2" };
export const dist = path.join(import.meta.dirname, "..", "dist");

/** @param {{host?: string}} [options] */
export async function serve({ host = "127.0.0.1" } = {}) {
  const sent = [];
  const server = http.createServer(async (request, response) => {
    const name = path.normalize(decodeURIComponent(new URL(request.url, "http://x").pathname)).replace(/^\//, "") || "index.html";
    const headers = { "content-type": TYPES[path.extname(name)] ?? "application/octet-stream", "cache-control": name.includes("/") ? "public, max-age=31536000, immutable" : "no-cache" };
    try {
      let bytes = await fs.readFile(path.join(dist, name));
      if (/\bbr\b/.test(request.headers["accept-encoding"] ?? "")) {
        const small = await fs.readFile(path.join(dist, `${name}.br`)).catch(() => null);
        if (small) {
          headers["content-encoding"] = "br";
          bytes = small;
        }
      }
      sent.push({ name, bytes: bytes.length });
      response.writeHead(200, headers).end(bytes);
    } catch {
      sent.push({ name, bytes: 0 });
      response.writeHead(404).end();
    }
  });
  await new Promise((resolve) => server.listen(0, host, resolve));
  return { address: `http://${host}:${server.address().port}/`, sent, close: () => { server.closeAllConnections(); server.close(); } };
}
