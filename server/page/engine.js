// The renderer in this browser: zraster.wasm in two Workers, one for rough pictures and one for all else. Beside a daemon, there is only the first.

const engine = { opening: null, rough: null, whole: null };

// No other scripts become Workers.
if (window.trustedTypes) {
  const allowed = ['engine/worker_thread.mjs', 'offline.js'].map((name) => new URL(name, document.baseURI).href);
  const createScriptURL = (url) => {
    if (!allowed.includes(new URL(url, document.baseURI).href)) throw new TypeError('no script of this page: ' + url);
    return url;
  };
  trustedTypes.createPolicy('default', { createScriptURL });
}

const refusalOf = (error) => error.status === 'cancelled' ? new DOMException('', 'AbortError') : new Refusal(422, error.message, error.faults || []);

// A Worker with the scene that it read last, without its view. One picture after the other.
class Drawer {
  constructor(z) {
    this.z = z;
    this.last = Promise.resolve();
    this.text = null;
    this.scene = null;
  }

  next(act) {
    const result = this.last.then(act);
    this.last = result.catch(() => {});
    return result;
  }

  async read(text, parts, signal) {
    const blobs = parts.map(([, file]) => file.blob), isSame = this.text === text && this.scene?.run === this.z.run &&
      this.blobs.length === blobs.length && blobs.every((blob, i) => blob === this.blobs[i]);
    if (isSame) return this.scene;
    if (this.scene) await this.scene.free();
    this.scene = null;
    this.view = parsed(text).view;
    this.scene = await this.z.read(withKeys(text, { view: undefined }), { parts: await bytesOf(parts), signal });
    this.text = text;
    this.blobs = blobs;
    return this.scene;
  }

  async picture(text, changes, query, parts, signal) {
    const options = { query, signal };
    if (Object.values(changes).includes(undefined))
      return this.z.draw(withKeys(text, changes), { ...options, parts: await bytesOf(parts) });
    const scene = await this.read(text, parts, signal);
    return scene.draw({ ...(this.view !== undefined && { view: this.view }), ...changes }, options);
  }
}

// The bytes of files, as the parts of a request.
async function bytesOf(parts) {
  const read = async ([name, file]) => [name, { data: new Uint8Array(await file.blob.arrayBuffer()), optional: true }];
  return Object.fromEntries(await Promise.all(parts.map(read)));
}

// Opens the module once; the Workers share it.
function openEngine() {
  engine.opening ??= (async () => {
    const [{ compile }, { load }] = await Promise.all(['browser', 'worker'].map((name) => import(new URL(`engine/${name}.mjs`, document.baseURI))));
    const module = await compile();
    [engine.rough, engine.whole] = (await Promise.all((HAS_DAEMON ? [1] : [1, 2]).map(() => load(module)))).map((z) => new Drawer(z));
  })().catch((error) => {
    engine.opening = null;
    throw error;
  });
  return engine.opening;
}

// Draws as render() does. A rough picture has an image, and no blob.
async function drawHere(text, changes, query, signal, isRough) {
  const { all: parts } = await prepare(text), began = performance.now(), drawer = isRough ? engine.rough : engine.whole;
  const given = new URLSearchParams(query), channels = changes.outputs ? changes.outputs.map(({ channel }) => channel) : [given.get('channel') || 'color'];
  given.delete('render');
  const answer = { blob: null, image: null, parts: new Map(), warnings: '' };
  await drawer.next(async () => {
    const picture = await drawer.picture(text, changes, String(given), parts, signal);
    answer.drawn = performance.now() - began;
    answer.warnings = picture.warnings.join('; ');
    if (isRough) answer.image = await picture.imageData();
    for (const channel of isRough ? [] : channels) {
      const { bytes, type } = await picture.encode(channel);
      answer.parts.set(channel, new Blob([bytes], { type }));
    }
    await picture.free();
  });
  answer.blob = answer.parts.get(channels[0]);
  answer.ms = performance.now() - began;
  return answer;
}

// Acts again, three times at most, while other requests end the Worker. After a fault of the module itself, another is opened.
async function tryHere(act, signal, isRough) {
  for (let tries = 1; ; tries++) {
    try {
      await openEngine();
      return await act();
    } catch (error) {
      if (error.status === 'internal' && engine.opening) await (isRough ? engine.rough : engine.whole).z.reopen();
      const isOfOther = (error.status === 'cancelled' || error.status === 'ended') && !signal?.aborted;
      if (!isOfOther || tries > 3) throw refusalOf(error);
    }
  }
}

// Does as readThere() does.
const readHere = (text) => tryHere(() => engine.whole.next(() => engine.whole.z.read(text, { type: 'application/json' })));
