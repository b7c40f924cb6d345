/* worker.mjs - for browsers: the renderer in a Worker. */
import { open } from './remote.mjs';

export { Picture, Scene, Zraster } from './remote.mjs';
export { ZrasterError } from './errors.mjs';

function start(take, fail) {
  const worker = new Worker(new URL('worker_thread.mjs', import.meta.url), { type: 'module' }); /* in one expression, for bundlers */
  worker.onmessage = event => take(event.data);
  worker.onerror = event => fail(event.message ?? 'worker_thread.mjs was not found beside worker.mjs');
  return worker;
}

export const load = (source, options) => open(start, source, options);
