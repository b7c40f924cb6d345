/* worker.mjs - the same classes in a Worker: each method is asynchronous, and the thread of the page goes on. An aborted signal
 * ends the Worker; the next call starts another. */
import { ZrasterError } from './errors.mjs';

export { ZrasterError };

const isNode = typeof process !== 'undefined' && Boolean(process.versions?.node);

async function start() {
  const url = new URL('worker_thread.mjs', import.meta.url);
  if (!isNode) return new Worker(new URL('worker_thread.mjs', import.meta.url), { type: 'module' });
  const { Worker: Thread } = await import('node:worker_threads');
  const thread = new Thread(url);
  thread.unref(); /* it waits for no call: a program may end */
  return thread;
}

function listen(worker, type, take) {
  if (isNode) worker.on(type, take);
  else worker.addEventListener(type, event => take(type === 'message' ? event.data : event.error ?? event));
}

/** Opens the renderer in a Worker; source and options as those of load(). */
export async function load(source, options) {
  const z = new Zraster(source, options);
  await z.reopen();
  return z;
}

export class Zraster {
  #source; #options; #worker = null; #calls = new Map(); #last = 0; #run = 0;
  constructor(source, options) {
    this.#source = source;
    this.#options = options;
  }

  /** Counts the Workers: objects of an earlier one are gone. */
  get run() { return this.#run; }

  async #open() {
    this.#run++;
    const worker = this.#worker = await start();
    const fail = error => this.#end(new ZrasterError('internal', `the Worker ended: ${error?.message ?? error}`), worker);
    listen(worker, 'message', ({ number, result, error }) => {
      const call = this.#calls.get(number);
      this.#calls.delete(number);
      if (isNode && !this.#calls.size) worker.unref();
      if (error) call?.reject(new ZrasterError(error.status, error.message, error.faults));
      else call?.resolve(result);
    });
    listen(worker, 'error', fail);
    Object.assign(this, await this.#send('load', [await this.#source, this.#options]));
  }

  #end(error, worker = this.#worker) {
    if (worker !== this.#worker) return;
    this.#worker?.terminate();
    this.#worker = null;
    this.#run++;
    for (const call of this.#calls.values()) call.reject(error);
    this.#calls.clear();
  }

  #send(name, values, signal) {
    return new Promise((resolve, reject) => {
      const number = ++this.#last, abort = () => this.#end(new ZrasterError('cancelled', 'the signal was aborted'));
      const leave = then => value => {
        signal?.removeEventListener('abort', abort);
        then(value);
      };
      this.#calls.set(number, { resolve: leave(resolve), reject: leave(reject) });
      signal?.addEventListener('abort', abort);
      if (isNode) this.#worker.ref();
      this.#worker.postMessage({ number, name, values });
    });
  }

  /** For the other classes: calls a method of an object of the Worker; 0: the renderer. */
  async call(object, name, values, options = {}) {
    const { signal, ...rest } = options;
    if (signal?.aborted) throw new ZrasterError('cancelled', 'the signal was aborted');
    if (!this.#worker) await this.#open();
    return this.#send('call', [object, name, [...values, rest]], signal);
  }

  async reopen() {
    this.#end(new ZrasterError('cancelled', 'it is opened again'));
    await this.#open();
  }
  async draw(body, options) { return new Picture(this, await this.call(0, 'draw', [body], options)); }
  async read(body, options) { return new Scene(this, await this.call(0, 'read', [body], options)); }
  references(body, type) { return this.call(0, 'references', [body, type]); }
  compare(a, b, query) { return this.call(0, 'compare', [{ object: a.id }, { object: b.id }, query]); }
  close() { this.#end(new ZrasterError('cancelled', 'it is closed')); }
}

class Held {
  constructor(z, { id, ...facts }) {
    this.z = z;
    this.id = id;
    this.run = z.run;
    Object.assign(this, facts);
  }
  call(name, values, options) {
    if (this.run !== this.z.run) throw new ZrasterError('ended', `the Worker of this ${this.constructor.name.toLowerCase()} has ended`);
    return this.z.call(this.id, name, values, options);
  }
  async free() { if (this.run === this.z.run) await this.call('free', []); }
}

export class Scene extends Held {
  async draw(change = {}, options) { return new Picture(this.z, await this.call('draw', [change], options)); }
}

/** look, hasAlpha and warnings are there at once. */
export class Picture extends Held {
  async encode(channel) { return this.call('encode', [channel]); }
  async channel(name) { return this.call('channel', [name]); }
  async imageData() {
    const { data, shape } = await this.channel('color');
    return new ImageData(new Uint8ClampedArray(data.buffer), shape[1], shape[0]);
  }
}
