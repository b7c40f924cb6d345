/* node_worker_thread.mjs - the thread of node_worker.mjs. */
import { parentPort } from 'node:worker_threads';
import { answers } from './answers.mjs';
import { load } from './node.mjs';

parentPort.on('message', answers(load, (message, moved) => parentPort.postMessage(message, moved)));
