/* node.mjs - for Node: load() reads the module beside this file. */
import { readFile } from 'node:fs/promises';
import { compile as compileFrom, load as loadFrom } from './zraster.mjs';

export { Picture, Scene, Zraster, ZrasterError } from './zraster.mjs';

const own = () => readFile(new URL('zraster.wasm', import.meta.url));

export const compile = source => compileFrom(source ?? own());
export const load = (source, options) => loadFrom(source ?? own(), options);
