/* options.mjs - options of a call, by the rows of the renderer: parameters of the query, and keys of the scene. */
import { ZrasterError } from './errors.mjs';

/** Marks options that were split before. */
export const CHECKED = Symbol('checked');

const OWN = new Set(['type', 'query', 'parts', 'signal']);
const camel = name => name.replace(/_([a-z])/g, (_, letter) => letter.toUpperCase());
const rows = new WeakMap();

/* { name of an option: { parameter or null, pointer, isMesh } } */
function rowsOf(tables) {
  if (!rows.has(tables)) {
    const made = new Map(tables.keys.map(key => [key.name, { parameter: null, pointer: `/${key.name}`, isMesh: false }]));
    for (const row of tables.parameters) made.set(row.name, { parameter: row.name, pointer: row.key, isMesh: row.bodies === 'mesh' });
    rows.set(tables, made);
  }
  return rows.get(tables);
}

const isObject = value => value !== null && typeof value === 'object' && !Array.isArray(value);
const hasObjects = value => isObject(value) || (Array.isArray(value) && value.some(isObject));
const textOf = value => (Array.isArray(value) ? value.map(textOf).join(',') : String(value));

/* Sets the key at a JSON Pointer, in copies of the objects around it. */
function set(keys, pointer, value) {
  const path = pointer.split('/').slice(1), last = path.pop();
  let at = keys;
  path.forEach((name, i) => {
    const isList = /^\d+$/.test(path[i + 1] ?? last);
    at[name] = isList ? [...(at[name] ?? [{}])] : { ...at[name] };
    at = at[name];
  });
  at[last] = value;
}

function setKey(keys, row, name, value) {
  if (row.pointer === '/query/projection') return set(keys, `/view/${value}`, {});
  if (row.pointer.startsWith(`/${row.parameter}/`) && hasObjects(value)) return set(keys, `/${row.parameter}`, value);
  set(keys, row.pointer.replace('/query/', '/'), value);
  if (row.pointer.startsWith('/lights/0/')) keys.lights[0].type ??= 'directional';
}

function sizeOf(size, given) {
  const sides = ArrayBuffer.isView(size) ? [...size] : [size].flat(), [width, height = width] = sides;
  if (!sides.length || sides.length > 2 || 'width' in given || 'height' in given)
    throw new ZrasterError('bad-request', 'size: a number, or a width and a height, without width and height beside it');
  return { width, height };
}

/** Splits the options of a body: { keys, request }. isScene: of a scene, whose keys replace parameters of models. */
export function split(tables, options, isScene) {
  const { size, channels, [CHECKED]: isChecked, ...given } = options, keys = {}, request = {}, query = {};
  if (isChecked) return { keys, request: given };
  const all = { ...given, ...(size == null ? {} : sizeOf(size, given)) };
  for (const [option, value] of Object.entries(all)) {
    const name = camel(option), row = rowsOf(tables).get(name);
    if (OWN.has(option)) request[option] = value;
    else if (!row) throw new ZrasterError('bad-request', `unknown option: ${option}`);
    else if (value === undefined || value === null) continue;
    else if (name === 'view') keys.view = typeof value === 'string' ? { preset: value } : value;
    else if (!row.parameter || (row.isMesh && isScene) || hasObjects(value)) setKey(keys, row, name, value);
    else query[row.parameter] = textOf(value);
  }
  const outputs = channels === undefined ? [] : [channels].flat();
  if (!isScene && outputs.length && !outputs.some(isObject)) query.channel = outputs.join(',');
  else if (outputs.length) keys.outputs = outputs.map(item => (isObject(item) ? item : { channel: item }));
  if (Object.keys(query).length) request.query = [...new URLSearchParams(request.query), ...Object.entries(query)];
  return { keys, request };
}
