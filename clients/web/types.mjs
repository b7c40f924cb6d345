/* types.mjs MODULE: prints options.d.ts, from the rows of the renderer, in the spelling of queries and in that of Python. */
import { readFile } from 'node:fs/promises';
import { load } from './zraster.mjs';

const z = await load(readFile(process.argv[2])), { parameters, keys, looks, channels } = z.tables;
const NUMBERS = ['UNITS', 'WHOLE', 'NUMBER', 'PIXEL', 'PIXELS', 'DEGREES', 'SECONDS', 'SIDE', 'COUNT'];

const snake = name => name.replace(/[A-Z]/g, letter => `_${letter.toLowerCase()}`);

const words = names => [...new Set(names)].map(name => `'${name}'`).join(' | ');

function type(row) {
  if (row.name === 'look') return 'Look';
  if (NUMBERS.includes(row.value)) return 'number';
  return row.value === 'BOOL' ? 'boolean' : 'string | number | boolean | readonly (string | number)[] | object';
}

const names = new Map(keys.map(row => [row.name, { help: row.help, type: 'unknown' }]));
for (const row of parameters) names.set(row.name, { help: row.help, type: type(row) });
console.log('/* Options of draw and read: the parameters of queries and the keys of scenes. Written by types.mjs. */');
console.log('/* (string & {}): other texts, too; editors complete the names. */');
console.log(`export type Look = ${words(looks.map(look => look.split('@')[0]))} | (string & {});`);
console.log(`export type ChannelName = ${words(channels.map(row => row.name))} | (string & {});`);
console.log('export interface Options {');
for (const [name, { help, type }] of [...names].sort(([a], [b]) => (a < b ? -1 : 1)))
  for (const spelling of new Set([name, snake(name)])) console.log(`  /** ${String(help).replaceAll('*/', '* /')} */\n  ${spelling}?: ${type};`);
console.log('}');
