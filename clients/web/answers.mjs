/* answers.mjs - the other end of remote.mjs: has the renderer, and its objects by number. */
import { ZrasterError } from './errors.mjs';
import { Picture, Scene } from './zraster.mjs';

/** A function that takes a message and posts its answer. load: of the engine. */
export function answers(load, post) {
  const objects = new Map();
  let last = 0, z;

  const given = value => (value?.object ? objects.get(value.object) : value);

  /* Returns the part of a result that the page gets, and the buffers that move there. */
  function told(result) {
    if (result instanceof Picture || result instanceof Scene) {
      const { look, hasAlpha, warnings } = result, id = ++last;
      objects.set(id, result);
      return [{ id, look, hasAlpha, warnings }];
    }
    return [result, [result?.bytes?.buffer, result?.data?.buffer].filter(Boolean)];
  }

  async function answer(name, values) {
    if (name === 'load') {
      z = await load(...values);
      return [{ version: z.version, rules: z.rules, tables: z.tables }];
    }
    const [id, method, list] = values, object = id ? objects.get(id) : z;
    if (!object) throw new ZrasterError('ended', 'this object was freed');
    if (method === 'free') objects.delete(id);
    return told(object[method](...list.map(given)));
  }

  return async ({ name, values }) => {
    try {
      const [result, moved] = await answer(name, values);
      post({ result }, moved);
    } catch (error) {
      post({ error: [error.status ?? 'internal', error.message, error.faults] });
    }
  };
}
