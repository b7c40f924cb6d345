/* worker_thread.mjs - the other end of worker.mjs: has the renderer, and its objects by number. */
import { ZrasterError } from './errors.mjs';
import { Picture, Scene } from './zraster.mjs';

const isNode = typeof process !== 'undefined' && Boolean(process.versions?.node);
const port = isNode ? (await import('node:worker_threads')).parentPort : self;
const { load } = await import(isNode ? './node.mjs' : './browser.mjs');
const objects = new Map();
let last = 0, z;

const given = value => (value?.object ? objects.get(value.object) : value);

/* What the other side gets of a result, and the buffers that move there. */
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
    port.postMessage({ number, result }, moved);
  } catch (error) {
    port.postMessage({ number, error: { status: error.status ?? 'internal', message: error.message, faults: error.faults ?? [] } });
  }
}

if (isNode) port.on('message', take);
else port.onmessage = event => take(event.data);
