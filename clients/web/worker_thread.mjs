/* worker_thread.mjs - the other end of worker.mjs: has the renderer, and its objects by number. */
import { ZrasterError } from './errors.mjs';
import { Picture, Scene } from './zraster.mjs';

const isNode = typeof process !== 'undefined' && Boolean(process.versions?.node);
/* A browser drops messages that come before there is a listener: nothing is awaited before it. */
const port = isNode ? import('node:worker_threads').then(threads => threads.parentPort) : self;
const objects = new Map();
let last = 0, z;

const given = value => (value?.object ? objects.get(value.object) : value);

/* Returns the part of a result that the page gets, and the buffers that move there. */
function told(result) {
  if (result instanceof Picture || result instanceof Scene) {
    const id = ++last;
    objects.set(id, result);
    if (result instanceof Scene) return [{ id }, []];
    return [{ id, look: result.look, hasAlpha: result.hasAlpha, warnings: result.warnings }, []];
  }
  return [result, [result?.bytes?.buffer, result?.data?.buffer].filter(Boolean)];
}

async function answer(name, values) {
  if (name === 'load') {
    const { load } = await (isNode ? import('./node.mjs') : import('./browser.mjs'));
    z = await load(...values);
    return [{ version: z.version, rules: z.rules, tables: z.tables }, []];
  }
  const [id, method, list] = values, object = id ? objects.get(id) : z;
  if (!object) throw new ZrasterError('ended', 'this object was freed');
  if (method === 'free') objects.delete(id);
  return told(object[method](...list.map(given)));
}

async function take({ number, name, values }) {
  try {
    const [result, moved] = await answer(name, values);
    (await port).postMessage({ number, result }, moved);
  } catch (error) {
    (await port).postMessage({ number, error: { status: error.status ?? 'internal', message: error.message, faults: error.faults ?? [] } });
  }
}

if (isNode) (await port).on('message', take);
else self.onmessage = event => take(event.data);
