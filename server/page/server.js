// Requests, and pictures by daemon.js or engine.js. Addresses are relative, so that the page works below any path of a proxy.

class Refusal extends Error {
  constructor(status, detail, errors = []) {
    super(detail);
    this.status = status;
    this.errors = errors.length ? errors : [{ pointer: '', detail }];
  }
}

// Files by the names that the text has: {blob, sha256, together}. `together`: one of several that refer to each other.
const files = new Map();

async function reason(response) {
  let problem = {};
  try {
    problem = await response.json();
  } catch {
    /* no problem+json: a proxy's page */
  }
  return new Refusal(response.status, problem.detail || response.statusText || 'refused', problem.errors || []);
}

// Fetches; of a daemon with the token, and again while it is busy.
async function call(path, options = {}) {
  for (;;) {
    let response;
    try {
      response = await fetch(path, HAS_DAEMON ? withToken(options) : options);
    } catch (error) {
      if (error.name === 'AbortError') throw error;
      throw new Refusal(0, HAS_DAEMON ? 'No answer. Is the daemon running?' : 'No answer. Is the network off?');
    }
    if (response.ok) return response;
    if (!HAS_DAEMON || !await isWorthAnother(response, options)) throw await reason(response);
  }
}

// A file of an example, for a name that the text has.
async function find(name) {
  files.set(name, { missing: true });
  try {
    const response = await call('v1/examples/' + encodeURIComponent(name));
    files.set(name, { blob: await response.blob(), isExample: true });
  } catch (error) {
    if (error.status !== 404) files.delete(name);
  }
}

// The files that a text names, as edits of it: {name, from, to}.
function assetsOf(text) {
  const found = [];
  for (const [pointer, place] of placesOf(text)) {
    if (!pointer.endsWith('/asset') || text[place.from] !== '"') continue;
    const name = JSON.parse(text.slice(place.from, place.to));
    if (!name.startsWith('sha256:')) found.push({ name, from: place.from, to: place.to });
  }
  return found;
}

let bundle = { text: null };

// Returns the files of a text: `assets` that it names, `all` that are here, and `parts` to send. Uploads them if the daemon keeps files.
async function prepare(text) {
  if (bundle.text === text) return bundle;
  const assets = assetsOf(text);
  if (HAS_DAEMON && assets.length) await askForLimits();
  await Promise.all(assets.map(({ name }) => name).filter((name) => !files.has(name)).map(find));
  const used = assets.map(({ name }) => files.get(name)).filter((file) => file && file.blob);
  const isTogether = used.some((file) => file.together);
  const isStored = HAS_DAEMON && server.keepsAssets && !isTogether;
  if (isStored) await Promise.all([...new Set(used)].filter((file) => !file.sha256).map(upload));
  const names = new Set(assets.map(({ name }) => name));
  const all = [...files].filter(([name, file]) => file.blob && (names.has(name) || (isTogether && file.together)));
  bundle = { text, assets, all, parts: isStored && server.keepsAssets ? [] : all };
  return bundle;
}

// Renders the text with other values at the top, such as {samples: 1}. Returns the bytes, times and warnings; of several
// outputs the bytes of each: parts.get('depth').
async function render(text, changes, query, signal, isRough = false) {
  const isHere = HAS_ENGINE && (!HAS_DAEMON || isRough && motion.is && engine.rough);
  try {
    if (isHere) return await tryHere(() => drawHere(text, changes, query, signal, isRough), signal, isRough);
  } catch (error) {
    if (!HAS_DAEMON || error.name === 'AbortError') throw error;
  }
  return renderThere(text, changes, query, signal);
}

// The numbers of an NPY file: float32 or uint32, row by row.
async function npy(blob) {
  const bytes = await blob.arrayBuffer();
  const at = 10 + new DataView(bytes).getUint16(8, true);
  const head = new TextDecoder().decode(new Uint8Array(bytes, 10, at - 10));
  return head.includes('<u4') ? new Uint32Array(bytes.slice(at)) : new Float32Array(bytes.slice(at));
}
