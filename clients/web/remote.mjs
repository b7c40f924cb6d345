/* remote.mjs - the classes of zraster.mjs in a Worker: each method is asynchronous, and the thread of the page goes on. Calls run in turn.
 * An aborted signal takes a call out of the queue; if it runs already, its Worker ends, and the next call starts another. */
import { ZrasterError } from './errors.mjs';

const refusal = (status, why) => new ZrasterError(status, why), cancelled = () => refusal('cancelled', 'the signal was aborted');

/* What a Worker can be sent: no Response, and addresses that do not depend on the page. */
async function sourceOf(source) {
  source = await source;
  if (typeof source === 'string' || source instanceof URL) return new URL(source, globalThis.document?.baseURI ?? import.meta.url).href;
  return source instanceof Response ? source.arrayBuffer() : source;
}

/* A Worker, which gets one question at a time. start(take, fail) makes it, with postMessage and terminate as everywhere. */
class Connection {
  #worker; #asked = null; #ended; #why = null;
  constructor(start, ended) {
    this.#ended = ended;
    this.#worker = start(message => this.#settle(message), text => this.end(refusal('internal', `the Worker ended: ${text}`)));
    this.#worker.unref?.(); /* it waits for no call: a program may end */
  }
  ask(name, values) {
    return new Promise((resolve, reject) => {
      if (this.#why) throw this.#why;
      try {
        this.#worker.postMessage({ name, values });
      } catch (error) {
        throw refusal('bad-request', error.message);
      }
      this.#worker.ref?.();
      this.#asked = { resolve, reject };
    });
  }
  #settle({ result, error }) {
    const asked = this.#asked;
    this.#asked = null;
    this.#worker.unref?.();
    if (error) asked?.reject(new ZrasterError(...error));
    else asked?.resolve(result);
  }
  end(error) {
    this.#why ??= error;
    this.#worker.terminate();
    this.#asked?.reject(error);
    this.#asked = null;
    this.#ended();
  }
}

/** Opens the renderer in a Worker; source and options as those of load(). */
export async function open(start, source, options) {
  const z = new Zraster(start, source, options);
  await z.reopen();
  return z;
}

export class Zraster {
  #start; #source; #options; #worker = null; #opened = null; #queue = []; #running = null; #isAtWork = false; #isClosed = false; #run = 0;
  constructor(start, source, options) {
    this.#start = start;
    this.#source = sourceOf(source);
    this.#source.catch(() => {}); /* told by #begin */
    this.#options = options;
  }

  /** Counts the Workers: objects of an earlier one are gone. */
  get run() { return this.#run; }

  async #begin() {
    const worker = this.#worker = new Connection(this.#start, () => {
      if (worker !== this.#worker) return;
      this.#worker = this.#opened = null;
      this.#run++;
    });
    try {
      Object.assign(this, await worker.ask('load', [await this.#source, this.#options]));
    } catch (error) {
      worker.end(error);
      throw error;
    }
  }
  #open() { return this.#opened ??= this.#begin(); }

  async #work() {
    if (this.#isAtWork) return;
    this.#isAtWork = true;
    while (this.#queue.length) {
      const opened = this.#open();
      try {
        await opened;
      } catch (error) {
        if (!this.#opened) this.#refuse(error);
      }
      if (opened !== this.#opened) continue; /* another Worker is there, or begins */
      const call = this.#running = this.#queue.shift();
      if (!call) continue;
      if (call.run !== null && call.run !== this.#run) call.reject(refusal('ended', 'the Worker of this object has ended'));
      else await this.#worker.ask('call', call.values).then(call.resolve, call.reject);
      this.#running = null;
    }
    this.#isAtWork = false;
  }

  #refuse(error) {
    for (const call of this.#queue.splice(0)) call.reject(error);
  }

  #stop(why) {
    this.#refuse(refusal('cancelled', why));
    this.#worker?.end(refusal('cancelled', why));
  }

  #cancel(call) {
    if (call === this.#running) return this.#worker?.end(cancelled());
    this.#queue = this.#queue.filter(other => other !== call);
    call.reject(cancelled());
  }

  /** For the other classes: calls a method of an object of the Worker; 0: the renderer. run: of the objects, or null. */
  async call(object, name, values, { signal, ...rest } = {}, run = null) {
    if (this.#isClosed) throw refusal('ended', 'zraster cannot be used: it is closed; reopen() opens it again');
    if (signal?.aborted) throw cancelled();
    return new Promise((resolve, reject) => {
      const abort = () => this.#cancel(call);
      const leaving = settle => value => {
        signal?.removeEventListener('abort', abort);
        settle(value);
      };
      const call = { values: [object, name, [...values, rest]], run, resolve: leaving(resolve), reject: leaving(reject) };
      signal?.addEventListener('abort', abort);
      this.#queue.push(call);
      this.#work();
    });
  }

  /** Ends all calls, and starts another Worker: scenes and pictures are gone. */
  async reopen() {
    this.#isClosed = false;
    this.#stop('it is opened again');
    await this.#open().catch(error => {
      if (!this.#opened) throw error;
      return this.#opened; /* of a later reopen() */
    });
  }
  async draw(body, options) { return new Picture(this, await this.call(0, 'draw', [body], options)); }
  async read(body, options) { return new Scene(this, await this.call(0, 'read', [body], options)); }
  async imageData(body, options) { return imageOf(await this.call(0, 'pixels', [body], options)); }
  references(body, type) { return this.call(0, 'references', [body, type]); }
  compare(a, b, query) { return this.call(0, 'compare', [{ object: a.id }, { object: b.id }, query], {}, a.run === b.run ? a.run : -1); }
  close() {
    this.#isClosed = true;
    this.#stop('it is closed');
  }
}

const imageOf = ({ data, shape }) => new ImageData(new Uint8ClampedArray(data.buffer), shape[1], shape[0]);

class Held {
  constructor(z, { id, ...facts }) {
    this.z = z;
    this.id = id;
    this.run = z.run;
    Object.assign(this, facts);
  }
  async call(name, values, options) { return this.z.call(this.id, name, values, options, this.run); }
  async free() {
    const isHere = !this.isFreed && this.run === this.z.run;
    this.isFreed = true;
    if (isHere) await this.call('free', []);
  }
}

export class Scene extends Held {
  async draw(change = {}, options) { return new Picture(this.z, await this.call('draw', [change], options)); }
  async imageData(change = {}, options) { return imageOf(await this.call('pixels', [change], options)); }
}

/** look, hasAlpha and warnings are there at once. */
export class Picture extends Held {
  async encode(channel) { return this.call('encode', [channel]); }
  async channel(name) { return this.call('channel', [name]); }
  async imageData() { return imageOf(await this.call('pixels', [])); }
}
