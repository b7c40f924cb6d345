// Pictures, by the daemon or by engine.js, and other requests. Addresses are relative, so that the page works below any path of a proxy.

class Refusal extends Error {
  constructor(status, detail, errors = []) {
    super(detail);
    this.status = status;
    this.errors = errors.length ? errors : [{ pointer: '', detail }];
  }
}

// Files by the names that the text has: {blob, sha256, together}. `together`: one of several that refer to each other.
const files = new Map();
const server = { token: '', keepsAssets: true, asking: null };

function askForToken() {
  const dialog = byId('token');
  if (!server.asking) {
    server.asking = new Promise((done) => {
      byId('token-form').onsubmit = (event) => {
        event.preventDefault();
        server.token = byId('token-value').value;
        server.asking = null;
        dialog.close();
        done();
      };
    });
    dialog.showModal();
  }
  return server.asking;
}

async function reason(response) {
  let problem = {};
  try {
    problem = await response.json();
  } catch {
    /* no problem+json: a proxy's page */
  }
  return new Refusal(response.status, problem.detail || response.statusText || 'refused', problem.errors || []);
}

// Fetches with the token, and again while the daemon is busy.
async function call(path, options = {}) {
  for (;;) {
    const headers = { ...options.headers };
    if (server.token) headers.Authorization = 'Bearer ' + server.token;
    let response;
    try {
      response = await fetch(path, { ...options, headers });
    } catch (error) {
      if (error.name === 'AbortError') throw error;
      throw new Refusal(0, HAS_DAEMON ? 'No answer. Is the daemon running?' : 'No answer. Is the network off?');
    }
    if (response.ok) return response;
    if (response.status === 401) {
      await askForToken();
    } else if (response.status === 429 || response.status === 503) {
      const seconds = Math.min(60, Number(response.headers.get('Retry-After')) || 1);
      say(`The daemon is busy; trying again in ${seconds} s.`);
      await pause(seconds * 1000);
      if (options.signal && options.signal.aborted) throw new DOMException('', 'AbortError');
      say('');
    } else {
      throw await reason(response);
    }
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

async function upload(file) {
  try {
    const response = await call('v1/assets', {
      method: 'POST', body: file.blob, headers: { 'Content-Type': 'application/octet-stream' },
    });
    file.sha256 = (await response.json()).sha256;
  } catch (error) {
    if (error.status === 0) throw error;
    server.keepsAssets = false;
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

// Returns the files of a text, {assets, parts}. Uploads them if the daemon keeps files.
async function prepare(text) {
  if (bundle.text === text) return bundle;
  const assets = assetsOf(text);
  await Promise.all(assets.map(({ name }) => name).filter((name) => !files.has(name)).map(find));
  const used = assets.map(({ name }) => files.get(name)).filter((file) => file && file.blob);
  const isTogether = used.some((file) => file.together);
  const isStored = HAS_DAEMON && server.keepsAssets && !isTogether;
  if (isStored) await Promise.all([...new Set(used)].filter((file) => !file.sha256).map(upload));
  let parts = [];
  if (!isStored || !server.keepsAssets) {
    const names = new Set(assets.map(({ name }) => name));
    parts = [...files].filter(([name, file]) => file.blob && (names.has(name) || (isTogether && file.together)));
  }
  bundle = { text, assets, parts };
  return bundle;
}

function multipart(text, parts) {
  const boundary = 'zraster' + Math.random().toString(36).slice(2);
  const body = [`--${boundary}\r\nContent-Disposition: form-data; name="scene"\r\n\r\n`, text, '\r\n'];
  for (const [name, file] of parts) {
    body.push(`--${boundary}\r\nContent-Disposition: form-data; name="${name}"\r\nZraster-Use: optional\r\n\r\n`, file.blob, '\r\n');
  }
  body.push(`--${boundary}--\r\n`);
  return { body: new Blob(body), type: 'multipart/form-data; boundary=' + boundary };
}

// Renders the text with other values at the top, such as {samples: 1}. Returns the bytes, times and warnings; of several
// outputs the bytes of each: parts.get('depth').
async function render(text, changes, query, signal, isRough = false) {
  if (!HAS_DAEMON) return renderHere(text, changes, query, signal, isRough);
  const { assets, parts: sent } = await prepare(text);
  const edits = sent.length ? [] : assets.filter(({ name }) => (files.get(name) || {}).sha256)
    .map(({ name, from, to }) => ({ from, to, text: `"sha256:${files.get(name).sha256}"` }));
  let body = withKeys(text, changes, edits), type = 'application/json';
  if (sent.length) ({ body, type } = multipart(body, sent));
  const began = performance.now();
  let response;
  try {
    const headers = { 'Content-Type': type, ...(changes.outputs && { Accept: 'multipart/form-data, */*;q=0.5' }) };
    response = await call('v1/render' + query, { method: 'POST', body, headers, signal });
  } catch (error) {
    if (error.status === 422 && /asset/.test(error.message) && assets.some(({ name }) => (files.get(name) || {}).sha256)) {
      // The daemon has dropped an asset: uploads and sends once more.
      for (const { name } of assets) if (files.has(name)) delete files.get(name).sha256;
      bundle = { text: null };
      if (!changes.again) return render(text, Object.defineProperty({ ...changes }, 'again', { value: true }), query, signal);
    }
    throw error;
  }
  const isForm = /^multipart/.test(response.headers.get('Content-Type'));
  const parts = isForm && await response.formData(), blob = isForm ? parts.get('color') : await response.blob();
  const drawn = /render;dur=([\d.]+)/.exec(response.headers.get('Server-Timing') || '');
  return {
    blob,
    parts,
    ms: performance.now() - began,
    drawn: drawn ? Number(drawn[1]) : 0,
    warnings: response.headers.get('Zraster-Warnings') || '',
  };
}

// The numbers of an NPY file: float32 or uint32, row by row.
async function npy(blob) {
  const bytes = await blob.arrayBuffer();
  const at = 10 + new DataView(bytes).getUint16(8, true);
  const head = new TextDecoder().decode(new Uint8Array(bytes, 10, at - 10));
  return head.includes('<u4') ? new Uint32Array(bytes.slice(at)) : new Float32Array(bytes.slice(at));
}
