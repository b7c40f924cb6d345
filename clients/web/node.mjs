/* node.mjs - for Node: load() reads the module beside this file. */
import { readFile } from 'node:fs/promises';
import { compile as compileFrom, load as loadFrom } from './zraster.mjs';

export { Picture, Scene, Zraster, ZrasterError } from './zraster.mjs';

/* Node's fetch has no files. */
async function given(source = new URL('zraster.wasm', import.meta.url)) {
  source = await source;
  const url = typeof source === 'string' && source.startsWith('file:') ? new URL(source) : source;
  return url instanceof URL && url.protocol === 'file:' ? readFile(url) : source;
}

export const compile = source => compileFrom(given(source));
export const load = (source, options) => loadFrom(given(source), options);
