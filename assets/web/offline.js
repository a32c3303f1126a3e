// The second visit without a network: keeps the whole site once the lab has run. A host asks for it by `assets/web/build --offline`;
// without, this worker takes away what an earlier one has kept.
const SITE = {{site}};
const OURS = `motion-lab ${registration.scope} `;
const OWN = OURS + SITE?.version;

/** Deletes what earlier versions kept, but for the one before this: a page of it may still be open. */
async function tidy() {
  const others = (await caches.keys()).filter((name) => name.startsWith(OURS) && name !== OWN);
  await Promise.all((SITE ? others.slice(0, -1) : others).map((name) => caches.delete(name)));
}

/** All of the site or nothing: a page of another version than this worker's is refused by its hash. */
async function keep() {
  const cache = await caches.open(OWN);
  const pages = Object.entries(SITE.pages).map(([name, integrity]) => new Request(name, { integrity, cache: "reload" }));
  // the names of these tell their contents, so the browser's own copies are right
  const files = SITE.files.map((name) => new Request(name, { cache: "force-cache" }));
  await cache.addAll([...pages, ...files]).catch(async (error) => {
    await caches.delete(OWN);
    throw error;
  });
}

/** A page comes from the network, whose newest one it is; without a network all of it is the version kept. */
async function page(request, name) {
  const answer = await fetch(request).catch(() => null);
  if (answer && answer.status < 500) return answer;
  const kept = await caches.match(name, { cacheName: OWN });
  // a browser takes no page that a host has redirected
  return kept ? new Response(kept.body, kept) : (answer ?? Response.error());
}

/** A file is the same in each version that has its name. */
const file = async (request) => (await caches.match(request.url, { ignoreVary: true })) ?? fetch(request);

addEventListener("install", (event) => {
  event.waitUntil((SITE ? keep() : Promise.resolve()).then(() => skipWaiting()));
});
addEventListener("activate", (event) => {
  event.waitUntil(tidy().then(() => (SITE ? clients.claim() : registration.unregister())));
});
addEventListener("fetch", (event) => {
  const { request } = event;
  if (!SITE || request.method !== "GET" || !request.url.startsWith(registration.scope)) return;
  const name = request.url.slice(registration.scope.length).replace(/[?#].*$/s, "") || "index.html";
  if (Object.hasOwn(SITE.pages, name)) event.respondWith(page(request, name));
  else if (/\.[0-9a-f]{12}\.\w+$/.test(name)) event.respondWith(file(request));
});
