// The daemon: its token, uploads, and pictures.

const server = { token: '', keepsAssets: true, asking: null, limits: null };

// Asks once whether the daemon keeps files.
async function askForLimits() {
  try {
    server.limits ??= call('v1/limits').then((response) => response.json());
    if ((await server.limits).keepsAssets === false) server.keepsAssets = false;
  } catch {
    server.limits = null;
  }
}

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

function withToken(options) {
  return server.token ? { ...options, headers: { ...options.headers, Authorization: 'Bearer ' + server.token } } : options;
}

// Waits for the token, or until a busy daemon has time. Returns false if another request is useless.
async function isWorthAnother(response, options) {
  if (response.status === 401) {
    await askForToken();
    return true;
  }
  if (response.status !== 429 && response.status !== 503) return false;
  const seconds = Math.min(60, Number(response.headers.get('Retry-After')) || 1);
  say(`The daemon is busy; trying again in ${seconds} s.`);
  await pause(seconds * 1000);
  if (options.signal && options.signal.aborted) throw new DOMException('', 'AbortError');
  say('');
  return true;
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

function multipart(text, parts) {
  const boundary = 'zraster' + Math.random().toString(36).slice(2);
  const body = [`--${boundary}\r\nContent-Disposition: form-data; name="scene"\r\n\r\n`, text, '\r\n'];
  for (const [name, file] of parts) {
    body.push(`--${boundary}\r\nContent-Disposition: form-data; name="${name}"\r\nZraster-Use: optional\r\n\r\n`, file.blob, '\r\n');
  }
  body.push(`--${boundary}--\r\n`);
  return { body: new Blob(body), type: 'multipart/form-data; boundary=' + boundary };
}

async function renderThere(text, changes, query, signal) {
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
      if (!changes.again) return renderThere(text, Object.defineProperty({ ...changes }, 'again', { value: true }), query, signal);
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

// Reads a text that is not valid JSON, for its faults.
const readThere = (body) => call('v1/render' + FACTS, { method: 'POST', body, headers: { 'Content-Type': 'application/json' } });

function copyCurl() {
  const names = copiedNames(), address = quoted(new URL('v1/render' + pictureQuery(), location.href.replace(/#.*/, '')).href);
  const token = server.token ? ' \\\n  -H "Authorization: Bearer $ZRASTER_TOKEN"' : '';
  if (!names.length) return `curl -s ${address} -o picture.png${token} \\\n  -H 'Content-Type: application/json' --data-binary @- <<'END'\n${copiedScene()}END\n`;
  const parts = names.map((name) => ` \\\n  -F ${quoted(`${name}=@${name}`)}`).join('');
  return `${downloads(names)}curl -s ${address} -o picture.png${token}${parts} \\\n  -F 'scene=<-;type=application/json' <<'END'\n${copiedScene()}END\n`;
}
