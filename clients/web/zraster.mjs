/* zraster.mjs - the renderer as an ES module. load() opens zraster.wasm; see README.md and zraster.d.ts. */
import { ZrasterError } from './errors.mjs';
import { CHECKED, split } from './options.mjs';

export { ZrasterError };

const STATUS = ['ok', 'bad-syntax', 'bad-type', 'bad-request', 'bad-scene', 'no-memory', 'cancelled', 'internal'];
const PAGE = 65536, INITIAL_PAGES = 128, LEAST = 2 ** 24, AGAIN = '; reopen() opens it again', MAXIMUM = 65536 * PAGE, OPTIONAL = 2;
const utf8 = new TextEncoder(), text = new TextDecoder();
/* By the numbers of zraster.h: bytes, f4, f8, u1, i4, u4, i8, u8. */
const ARRAYS = [Uint8Array, Float32Array, Float64Array, Uint8Array, Int32Array, Uint32Array, BigInt64Array, BigUint64Array];
const TYPES = new Map([[Float32Array, 1], [Float64Array, 2], [Uint8Array, 3], [Int32Array, 4], [Uint32Array, 5], [BigInt64Array, 6], [BigUint64Array, 7]]);
/* Sizes of structs of zraster.h in 32 bits. */
const OPTIONS_SIZE = 48, REQUEST_SIZE = 40, PART_SIZE = 36, BYTES_SIZE = 12, ARRAY_SIZE = 28;

/* Numbers that JSON does not have: those of typed arrays, and long ones. */
const isOwn = value => typeof value === 'bigint' || (ArrayBuffer.isView(value) && !(value instanceof DataView));
const hasOwn = value => isOwn(value) || (value !== null && typeof value === 'object' && Object.values(value).some(hasOwn));
/* A Buffer has a form of its own in JSON, so the value is taken from its object. */
function plain(key) {
  const value = this[key];
  return !isOwn(value) ? arguments[1] : typeof value === 'bigint' ? Number(value) : Array.from(value, Number);
}

function bytesOf(value) {
  if (typeof value === 'string') return utf8.encode(value);
  if (value instanceof ArrayBuffer) return new Uint8Array(value);
  if (ArrayBuffer.isView(value)) return new Uint8Array(value.buffer, value.byteOffset, value.byteLength);
  if (value?.then || value?.arrayBuffer) throw new ZrasterError('bad-request', 'the body is a promise, a Blob or a Response: await its bytes');
  return utf8.encode(hasOwn(value) ? JSON.stringify(value, plain) : JSON.stringify(value));
}

const isDocument = value => value !== null && typeof value === 'object' && !(value instanceof ArrayBuffer) && !ArrayBuffer.isView(value);

/* Whether keys of scenes apply to a body, and not parameters of models. */
function isScene(body, type, tables) {
  if (isDocument(body)) return true;
  const row = type && tables.formats.find(row => row.suffix === type || row.types.split(' ').includes(type));
  if (row) return Boolean(row.isScene);
  const start = text.decode(bytesOf(typeof body === 'string' ? body.slice(0, 4096) : body).subarray(0, 4096)).replace(/^[\ufeff\s]+/, '');
  return /^[{[]/.test(start) && !/"asset"\s*:\s*\{[^}]*"version"/.test(start);
}

/** Compiles a module, of which load() opens any number: a URL, a Response, bytes, or a promise of one. */
export async function compile(source) {
  source = await source;
  if (source instanceof WebAssembly.Module) return source;
  if (source instanceof URL || typeof source === 'string') source = await fetch(source);
  if (typeof Response !== 'undefined' && source instanceof Response) {
    if (!source.ok) throw new ZrasterError('internal', `zraster.wasm: status ${source.status}`);
    /* Some servers give another type, which compileStreaming refuses; a page instead of the module is a wrong address. */
    const type = source.headers.get('Content-Type') ?? '', isWasm = type === 'application/wasm';
    if (type.startsWith('text/html')) throw new ZrasterError('internal', `${source.url}: a page, and no module; see "Bundlers" in the README of zraster`);
    return isWasm ? WebAssembly.compileStreaming(source) : WebAssembly.compile(await source.arrayBuffer());
  }
  return WebAssembly.compile(source);
}

/* The module asks for nothing but its memory: no files, no clock. */
function importsOf(module, memory) {
  const imports = { env: { memory } };
  for (const { module: from, name, kind } of WebAssembly.Module.imports(module)) {
    if (kind !== 'function') continue;
    imports[from] ??= {};
    imports[from][name] = name === 'proc_exit' ? code => { throw new Error(`exit ${code}`); } : () => 52; /* ENOSYS */
  }
  return imports;
}

/** Compiles and opens the module: a URL, a Response, bytes, a WebAssembly.Module, or a promise of one. */
export async function load(source, { memoryMax = 2 ** 30, ...others } = {}) {
  for (const name in others) throw new ZrasterError('bad-request', `unknown option: ${name}`);
  if (!(memoryMax >= LEAST && memoryMax <= MAXIMUM))
    throw new ZrasterError('bad-request', `memoryMax: ${memoryMax} is not between 16 MiB and 4 GiB`);
  const renderer = new Zraster(await compile(source), memoryMax);
  await renderer.reopen();
  return renderer;
}

export class Zraster {
  #module; #memoryMax; #memory; #exports; #renderer = 0; #tables; #ended = 'it is not open';
  /* Rises with each opening: objects of an earlier one are gone. */
  #opening = 0;
  #closings = 0;

  constructor(module, memoryMax) {
    this.#module = module;
    this.#memoryMax = memoryMax;
  }

  /** Opens the module anew, with empty memory: after a trap, or to return memory, which never shrinks. Scenes and pictures are gone. */
  async reopen() {
    this.#ended = 'it is being opened';
    this.#opening++;
    const memory = new WebAssembly.Memory({ initial: INITIAL_PAGES, maximum: Math.floor(this.#memoryMax / PAGE) });
    const closings = this.#closings, instance = await WebAssembly.instantiate(this.#module, importsOf(this.#module, memory));
    if (closings !== this.#closings) return;
    this.#memory = memory;
    this.#exports = instance.exports;
    this.#ended = '';
    this.call('_initialize');
    const most = Math.min(this.#memoryMax, 2 ** 32 - 1);
    this.#renderer = this.within(hold => {
      const options = hold(this.room(OPTIONS_SIZE)), out = hold(this.room(4)), view = this.view();
      view.setUint32(options, OPTIONS_SIZE, true);
      view.setUint32(options + 4, most, true);
      view.setUint32(options + 12, 1, true);
      const status = this.call('zraster_open', options, out);
      if (status) throw new ZrasterError(STATUS[status] ?? 'internal', 'zraster_open failed');
      return this.view().getUint32(out, true);
    });
  }

  /** Why it cannot be used, or ''. */
  get ended() { return this.#ended; }
  get module() { return this.#module; }
  get memoryMax() { return this.#memoryMax; }
  /** Bytes that the module has taken. */
  get memory() { return this.#memory.buffer.byteLength; }
  get version() { return this.string(this.call('zraster_version')); }
  /** Rises when the same scene gets other pixels. */
  get rules() { return this.call('zraster_rules'); }
  /** Parameters, keys, looks, channels, encodings, formats and limits. */
  get tables() { return this.#tables ??= JSON.parse(this.string(this.call('zraster_tables', this.#renderer))); }

  /** Draws a model (bytes) or a scene (object, JSON). */
  draw(body, options = {}) {
    const { keys, request } = split(this.tables, options, isScene(body, options.type, this.tables));
    if (!Object.keys(keys).length) return new Picture(this, this.request(body, request, 'zraster_draw', this.#renderer));
    if (isDocument(body)) return this.draw({ ...body, ...keys }, { ...request, [CHECKED]: true });
    const scene = this.read(body, { ...request, [CHECKED]: true });
    try { return scene.draw(keys, { [CHECKED]: true }); } finally { scene.free(); }
  }

  /** Draws the colours for a canvas. */
  imageData(body, options) { return imageOf(this.pixels(body, options)); }
  pixels(body, options) { return taken(this.draw(body, options)); }

  /** Reads a scene once, to draw it many times. */
  read(body, options = {}) {
    const isOne = isScene(body, options.type, this.tables), { keys, request } = split(this.tables, options, isOne);
    if (Object.keys(keys).length && !isDocument(body))
      throw new ZrasterError('bad-request', `${Object.keys(keys).join(', ')}: for the drawing of this scene`);
    return new Scene(this, this.request(isDocument(body) ? { ...body, ...keys } : body, request, 'zraster_scene_read', this.#renderer), isOne);
  }

  /** Names of the files that a file refers to, which a request needs as parts. */
  references(body, type) {
    return this.within(hold => {
      const bytes = bytesOf(body), at = hold(this.put(bytes)), typeAt = type ? hold(this.put(utf8.encode(type), 1)) : 0;
      const size = this.call('zraster_references', at, bytes.length, typeAt, 0, 0), names = hold(this.room(size || 1));
      this.call('zraster_references', at, bytes.length, typeAt, names, size);
      return [...new Set(text.decode(this.bytes().slice(names, names + size)).split('\0').filter(Boolean))];
    });
  }

  /** Compares two scenes: the numbers of "Comparing models". */
  compare(a, b, query = '') {
    for (const scene of [a, b])
      if (!(scene instanceof Scene && scene.z === this)) throw new ZrasterError('bad-request', 'compare() takes two scenes that this renderer has read');
    return this.within(hold => {
      const queryAt = query ? hold(this.put(utf8.encode(queryText(query)), 1)) : 0, out = hold(this.room(8));
      this.check(this.call('zraster_compare', a.at, b.at, queryAt, 0, out, out + 4), out + 4);
      const comparison = this.view().getUint32(out, true);
      const numbers = JSON.parse(this.string(this.call('zraster_comparison_json', comparison)));
      this.call('zraster_comparison_free', comparison);
      return numbers;
    });
  }

  close() {
    this.#closings++;
    if (!this.#ended) this.call('zraster_close', this.#renderer);
    this.#ended = `it is closed${AGAIN}`;
    this.#memory = { buffer: new ArrayBuffer(0) };
    this.#exports = null;
  }

  /* ---- for the other classes ---- */

  get opening() { return this.#opening; }

  /** Calls a function of the module. An exception there is a trap: the module's memory is undefined then, so it ends. */
  call(name, ...numbers) {
    if (this.#ended) throw new ZrasterError('ended', `zraster cannot be used: ${this.#ended}`);
    try {
      return this.#exports[name](...numbers);
    } catch (error) {
      this.#ended = `it ended with a fault (${error.message ?? error})${AGAIN}`;
      throw Object.assign(new ZrasterError('internal', `zraster: ${this.#ended}`), { cause: error });
    }
  }
  bytes() { return new Uint8Array(this.#memory.buffer); }
  view() { return new DataView(this.#memory.buffer); }
  string(at) {
    if (!at) return null;
    const bytes = this.bytes();
    return text.decode(bytes.subarray(at, bytes.indexOf(0, at)));
  }
  /** Bytes in the module. */
  allocate(size) {
    const at = this.call('malloc', size || 1) >>> 0;
    if (!at) throw new ZrasterError('no-memory', `${size} bytes exceed memoryMax, ${this.#memoryMax} bytes`);
    return at;
  }
  /** The same, zeroed. */
  room(size) {
    const at = this.allocate(size);
    this.bytes().fill(0, at, at + size);
    return at;
  }
  put(bytes, zeros = 0) {
    const at = this.allocate(bytes.length + zeros), all = this.bytes();
    all.set(bytes, at);
    all.fill(0, at + bytes.length, at + bytes.length + zeros);
    return at;
  }
  /** Frees the object of f. */
  within(f) {
    const held = [];
    try {
      return f(at => (held.push(at), at));
    } finally {
      if (!this.#ended) for (const at of held) this.call('free', at);
    }
  }

  /** Calls a function with (object, request, out, error), and returns the object that it made. */
  request(body, { type, query, parts, signal } = {}, name, object) {
    if (signal?.aborted) throw new ZrasterError('cancelled', 'the signal was aborted');
    return this.within(hold => {
      const given = body == null ? null : bytesOf(body), bodyAt = given ? hold(this.put(given)) : 0;
      const typeAt = type ? hold(this.put(utf8.encode(type), 1)) : 0, asked = query ? queryText(query) : '';
      const queryAt = asked ? hold(this.put(utf8.encode(asked), 1)) : 0;
      const list = Object.entries(parts ?? {}), partsAt = list.length ? hold(this.room(PART_SIZE * list.length)) : 0;
      list.forEach(([name, part], i) => this.putPart(hold, partsAt + PART_SIZE * i, name, part));
      const at = hold(this.room(REQUEST_SIZE)), out = hold(this.room(8)), view = this.view();
      [REQUEST_SIZE, bodyAt, given?.length ?? 0, typeAt, queryAt, partsAt, list.length].forEach((x, i) => view.setUint32(at + 4 * i, x, true));
      this.check(this.call(name, object, at, out, out + 4), out + 4);
      return this.view().getUint32(out, true);
    });
  }
  putPart(hold, at, name, part) {
    const data = part.data ?? part, bytes = bytesOf(data), shape = part.shape ?? [bytes.length];
    const type = part.shape ? TYPES.get(data.constructor) : 0;
    if (type === undefined) throw new ZrasterError('bad-request', `parts: ${name}: ${data.constructor.name} is no array of a part`);
    if (part.shape && shape.reduce((x, y) => x * y, 1) !== data.length)
      throw new ZrasterError('bad-request', `parts: ${name}: ${data.length} numbers have not the shape ${shape.join(' x ')}`);
    const numbers = [hold(this.put(utf8.encode(name), 1)), hold(this.put(bytes)), type, shape.length], view = this.view();
    numbers.forEach((x, i) => view.setUint32(at + 4 * i, x, true));
    shape.forEach((x, k) => view.setUint32(at + 16 + 4 * k, x, true));
    view.setUint32(at + 32, part.optional ? OPTIONAL : 0, true);
  }
  check(status, at) {
    if (!status) return;
    const error = this.view().getUint32(at, true), faults = [];
    const count = error ? this.call('zraster_error_count', error) : 0;
    for (let i = 0; i < count; i++)
      faults.push({ pointer: this.string(this.call('zraster_error_pointer', error, i)), detail: this.string(this.call('zraster_error_detail', error, i)) });
    let message = error ? this.string(this.call('zraster_error_text', error)) : '';
    if (STATUS[status] === 'no-memory') message += `; memoryMax is ${this.#memoryMax} bytes, and free() and reopen() return memory`;
    if (error) this.call('zraster_error_free', error);
    throw new ZrasterError(STATUS[status] ?? 'internal', message, faults);
  }
}

function queryText(query) {
  return typeof query === 'string' ? query : new URLSearchParams(query).toString();
}

function imageOf({ data, shape }) {
  if (typeof ImageData === 'undefined') throw new ZrasterError('bad-request', "there is no ImageData here; channel('color') has the colours");
  return new ImageData(new Uint8ClampedArray(data.buffer), shape[1], shape[0]);
}

/* The colours of a picture, which is freed. */
function taken(picture) {
  try { return picture.pixels(); } finally { picture.free(); }
}

/* An object of the module, which is freed once, and gone with it. */
class Held {
  #at; #opening; #free;
  constructor(z, at, free) {
    this.z = z;
    this.#at = at;
    this.#opening = z.opening;
    this.#free = free;
  }
  get at() {
    if (!this.#at || this.#opening !== this.z.opening) throw new ZrasterError('ended', `this ${this.constructor.name.toLowerCase()} was freed`);
    return this.#at;
  }
  free() {
    if (this.#at && this.#opening === this.z.opening && !this.z.ended) this.z.call(this.#free, this.#at);
    this.#at = 0;
  }
  [Symbol.dispose ?? Symbol.for('Symbol.dispose')]() { this.free(); }
}

export class Scene extends Held {
  #isOne;
  constructor(z, at, isOne) {
    super(z, at, 'zraster_scene_free');
    this.#isOne = isOne; /* not a bare model */
  }
  /** Draws it with other keys, such as { view, look, poses }. */
  draw(change = {}, options = {}) {
    const { keys, request } = split(this.z.tables, options, this.#isOne);
    const body = { ...change, ...keys };
    return new Picture(this.z, this.z.request(Object.keys(body).length ? body : null, { type: 'json', ...request }, 'zraster_scene_draw', this.at));
  }
  /** Draws the colours for a canvas. */
  imageData(change, options) { return imageOf(this.pixels(change, options)); }
  pixels(change, options) { return taken(this.draw(change, options)); }
  get memory() { return this.z.call('zraster_scene_memory', this.at); }
}

export class Picture extends Held {
  constructor(z, at) { super(z, at, 'zraster_picture_free'); }
  /** The answer of POST /v1/render, or the file of one output: { bytes, type }. */
  encode(channel) {
    const { z } = this;
    return z.within(hold => {
      const name = channel ? hold(z.put(utf8.encode(channel), 1)) : 0, out = hold(z.room(BYTES_SIZE + 4));
      z.check(z.call('zraster_picture_encode', this.at, name, out, out + BYTES_SIZE), out + BYTES_SIZE);
      const view = z.view(), data = view.getUint32(out, true), size = view.getUint32(out + 4, true);
      return { bytes: z.bytes().slice(data, data + size), type: z.string(view.getUint32(out + 8, true)) };
    });
  }
  /** A copy of the numbers of an output, or null: { data, shape }; row 0 is the top. */
  channel(name = 'color') {
    const { z } = this;
    return z.within(hold => {
      const nameAt = hold(z.put(utf8.encode(name), 1)), out = hold(z.room(ARRAY_SIZE));
      if (!z.call('zraster_picture_channel', this.at, nameAt, out)) return null;
      const view = z.view(), at = view.getUint32(out, true), type = ARRAYS[view.getUint32(out + 4, true)];
      const shape = Array.from({ length: view.getUint32(out + 8, true) }, (_, i) => view.getUint32(out + 12 + 4 * i, true));
      const bytes = shape.reduce((x, y) => x * y, type.BYTES_PER_ELEMENT);
      return { data: new type(z.bytes().slice(at, at + bytes).buffer), shape };
    });
  }
  /** The colours for a canvas. */
  imageData() { return imageOf(this.pixels()); }
  pixels() {
    const colours = this.channel('color');
    if (!colours) throw new ZrasterError('bad-request', 'the picture has no colours');
    return colours;
  }
  get hasAlpha() { return this.z.call('zraster_picture_has_alpha', this.at) !== 0; }
  get look() { return this.z.string(this.z.call('zraster_picture_look', this.at)); }
  get warnings() {
    const all = [];
    for (let line; (line = this.z.string(this.z.call('zraster_picture_warning', this.at, all.length))) !== null;) all.push(line);
    return all;
  }
}
