// The page without a network: all files of one build are stored; names with a hash never change, and the index is asked for first.
const FILES = [/* files */];
const CACHE = `affinor ${[...new Set(FILES.map((name) => name.split("/")[0]))].join(" ")}`;

self.addEventListener("install", (event) => {
  event.waitUntil(caches.open(CACHE).then((cache) => cache.addAll(["./", "paper.html", ...FILES])).then(() => self.skipWaiting()));
});
self.addEventListener("activate", (event) => {
  event.waitUntil(caches.keys().then((names) => Promise.all(names.filter((name) => name !== CACHE).map((name) => caches.delete(name)))).then(() => self.clients.claim()));
});
self.addEventListener("fetch", (event) => {
  const { request } = event, address = new URL(request.url);
  if (request.method !== "GET" || address.origin !== location.origin) return;
  const hashed = /\/(page|engine)-[^/]+\//.test(address.pathname);
  const stored = () => caches.match(request.mode === "navigate" && !address.pathname.endsWith("paper.html") ? "./" : request, { ignoreSearch: true });
  event.respondWith(hashed ? stored().then((found) => found ?? fetch(request)) : fetch(request).catch(async () => await stored() ?? Response.error()));
});
