/* node_worker.mjs - for Node: the renderer in a thread. */
import { Worker } from 'node:worker_threads';
import { open } from './remote.mjs';

export { Picture, Scene, Zraster } from './remote.mjs';
export { ZrasterError } from './errors.mjs';

function start(take, fail) {
  const thread = new Worker(new URL('node_worker_thread.mjs', import.meta.url));
  thread.on('message', take);
  thread.on('error', error => fail(error.message));
  return thread;
}

export const load = (source, options) => open(start, source, options);
