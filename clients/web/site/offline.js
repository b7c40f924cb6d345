/* offline.js - a service worker: keeps the page, the renderer and the examples, so that they work without a network. Pages of the manual are kept
 * when they are read. Other copies of the page on one origin have caches of their own. VERSION and FILES come from build.sh. */
const OWN = `zraster ${registration.scope} `, NAME = OWN + VERSION;

async function answer(request) {
  const cache = await caches.open(NAME), kept = await cache.match(request, { ignoreSearch: true });
  if (kept) return kept;
  const response = await fetch(request);
  if (response.ok) await cache.put(request, response.clone());
  return response;
}

addEventListener('install', event => {
  const files = FILES.map(file => new Request(file, { cache: 'reload' }));
  event.waitUntil(caches.open(NAME).then(cache => cache.addAll(files)).then(() => skipWaiting()));
});

addEventListener('activate', event => {
  const old = names => names.filter(name => name.startsWith(OWN) && name !== NAME);
  event.waitUntil(caches.keys().then(names => Promise.all(old(names).map(name => caches.delete(name)))).then(() => clients.claim()));
});

addEventListener('fetch', event => {
  const { method, url } = event.request;
  if (method === 'GET' && url.startsWith(registration.scope)) event.respondWith(answer(event.request));
});
