/* worker_thread.mjs - the Worker of worker.mjs. A browser drops messages that come before there is a listener: nothing is awaited here. */
import { answers } from './answers.mjs';
import { load } from './browser.mjs';

const take = answers(load, (message, moved) => self.postMessage(message, moved));
self.onmessage = event => take(event.data);
