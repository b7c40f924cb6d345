/* browser.mjs - for browsers: load() fetches the module beside this file, or the one without SIMD where the engine has none. */
import { compile as compileFrom, load as loadFrom } from './zraster.mjs';

export { Picture, Scene, Zraster, ZrasterError } from './zraster.mjs';

/* A function with i8x16.splat. */
const WITH_SIMD = Uint8Array.of(0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 8, 1, 6, 0, 65, 0, 253, 15, 11);

/* Both spelled out, for bundlers. */
const own = () => (WebAssembly.validate(WITH_SIMD) ? new URL('zraster.wasm', import.meta.url) : new URL('zraster-scalar.wasm', import.meta.url));

export const compile = source => compileFrom(source ?? own());
export const load = (source, options) => loadFrom(source ?? own(), options);
