// Keeps the page for times without a net. The builder (vite.config.ts) puts in what there is and a version that changes with
// it, so that a new page makes a new worker, and browsers fetch it at the next visit.
const VERSION = "__VERSION__";
const FILES = [/* __FILES__ */];

const PREFIX = "hyperbody-";
const OWN = PREFIX + VERSION;

addEventListener("install", (event) => {
  const take = async () => {
    const cache = await caches.open(OWN);
    await cache.addAll(FILES.map((file) => new Request(file, { cache: "no-cache" })));
    await skipWaiting();
  };
  event.waitUntil(take());
});

addEventListener("activate", (event) => {
  const tidy = async () => {
    const names = (await caches.keys()).filter((name) => name.startsWith(PREFIX) && name !== OWN);
    await Promise.all(names.map((name) => caches.delete(name)));
    await clients.claim();
  };
  event.waitUntil(tidy());
});

/** What is kept; undefined where there is nothing. */
async function kept(request) {
  return (await caches.open(OWN)).match(request, { ignoreSearch: true, ignoreVary: true });
}

/** The net first, so that an update arrives; what is kept where there is none. */
async function fresh(request, asked) {
  try {
    return await fetch(request);
  } catch (error) {
    const found = await kept(asked);
    if (found) return found;
    throw error;
  }
}

addEventListener("fetch", (event) => {
  const { request } = event;
  const address = new URL(request.url);
  const scope = new URL(registration.scope);
  if (request.method !== "GET" || address.origin !== scope.origin || !address.pathname.startsWith(scope.pathname)) return;
  const path = address.pathname.slice(scope.pathname.length);
  // Names with a hash never mean anything else.
  if (path.startsWith("assets/")) event.respondWith(kept(request).then((found) => found ?? fetch(request)));
  else event.respondWith(fresh(request, path === "" ? new URL("index.html", scope) : request));
});
