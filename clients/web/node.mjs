/* node.mjs - for Node: load() reads the module beside this file. */
import { readFile } from 'node:fs/promises';
import { load as loadFrom } from './zraster.mjs';

export { Picture, Scene, Zraster, ZrasterError } from './zraster.mjs';

export function load(source = readFile(new URL('zraster.wasm', import.meta.url)), options) {
  return loadFrom(source, options);
}
