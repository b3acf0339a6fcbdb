// Keeps the files of this build in the browser, so that the salon opens without a connection after the first visit.

const PREFIX = "frisure-salon-";
const CACHE = PREFIX + "{{build}}";
const FILES = [
  "index.html",
  ...["icon.svg", "page.css", "start.js", "notice.js", "worker.js", "salon.js", "salon_bg.wasm"].map((name) => `${name}?v={{build}}`),
];

self.addEventListener("install", (event) => {
  event.waitUntil((async () => {
    const cache = await caches.open(CACHE);
    await cache.addAll(FILES);
    await self.skipWaiting();
  })());
});

self.addEventListener("activate", (event) => {
  event.waitUntil((async () => {
    const old = (await caches.keys()).filter((name) => name.startsWith(PREFIX) && name !== CACHE);
    await Promise.all(old.map((name) => caches.delete(name)));
    await self.clients.claim();
  })());
});

/** The page comes from the server, as long as there is one: a new build is found at once. Its files are those of one build. */
async function answer(request) {
  const cache = await caches.open(CACHE);
  if (request.mode !== "navigate") return (await cache.match(request)) ?? fetch(request);
  try {
    return await fetch(request);
  } catch (error) {
    const page = await cache.match("index.html");
    if (page) return page;
    throw error;
  }
}

self.addEventListener("fetch", (event) => {
  const { method, url } = event.request;
  if (method === "GET" && url.startsWith(self.registration.scope)) event.respondWith(answer(event.request));
});
