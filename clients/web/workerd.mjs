/* workerd.mjs - for workers at the edge, which compile no bytes: the bundler brings the compiled module. */
import module from './zraster.wasm';
import { load as loadFrom } from './zraster.mjs';

export { Picture, Scene, Zraster, ZrasterError } from './zraster.mjs';

export const compile = async (source = module) => source;

/* Such workers have 128 MB. */
export function load(source = module, { memoryMax = 100 * 2 ** 20 } = {}) {
  return loadFrom(source, { memoryMax });
}
