#!/usr/bin/env node
/* cli.mjs - npx zraster part.stl part.png --look technical --size 800x600: options are the parameters of a query. Exit status: 0 done,
 * 1 the file failed, 2 wrong command line. */
import { readFileSync } from 'node:fs';
import { readFile, writeFile } from 'node:fs/promises';
import { basename, dirname, extname, join, normalize, resolve, sep } from 'node:path';
import { load } from './node.mjs';

const USAGE = `Usage: zraster FILE [OUTPUT] [--OPTION VALUE]...
Draws a 3D model or scene to a picture.

  npx zraster part.stl                              write part.png
  npx zraster part.stl out.jpg --look technical --size 800x600
  npx zraster - <part.stl >part.png

  -o, --output FILE         file of the picture, or - for standard output (default: FILE with another ending, in this folder)
  -s, --size WxH            window in pixels; N means NxN
      --type TYPE           format of FILE (default: by its ending, else by its bytes)
  -h, --help                this text and all options
  -V, --version             version of zraster
`;
const SHORT = { '-o': '--output', '-s': '--size', '-l': '--look', '-c': '--channel', '-W': '--width', '-H': '--height', '-h': '--help', '-V': '--version' };
const WRITTEN = new Set(['output', 'size', 'type']);
const FAULTS = { ENOENT: 'there is no such file', EISDIR: 'it is a folder', EACCES: 'access is denied', ENOTDIR: 'its folder is a file', ENOSPC: 'the disk is full' };
const camel = name => name.replace(/-([a-z])/g, (_, letter) => letter.toUpperCase());
const dashed = name => `--${name.replace(/[A-Z]/g, letter => `-${letter.toLowerCase()}`)}`;
const isWord = word => word.startsWith('-') && word !== '-';

class WrongLine extends Error {}

/* Rows of parameters by name. Without its value, a parameter that is true or false is true. */
function parse(words, rows) {
  const files = [], query = {}, own = {};
  for (let i = 0; i < words.length; i++) {
    if (!isWord(words[i])) {
      files.push(words[i]);
      continue;
    }
    const [flag, given] = words[i].split(/=(.*)/s), long = SHORT[flag] ?? flag, name = camel(long.slice(2)), row = rows.get(name);
    if (!long.startsWith('--') || (!row && !WRITTEN.has(name))) throw new WrongLine(`unknown option ${flag}${near(name, rows)}`);
    const isTrue = row?.value === 'BOOL' && !/^(true|false)$/.test(words[i + 1]);
    const value = given ?? (isTrue ? 'true' : words[++i]);
    if (value === undefined) throw new WrongLine(`a value is missing after ${flag}: ${long} ${row?.value ?? 'VALUE'}`);
    if (WRITTEN.has(name)) own[name] = value;
    else query[name] = value;
  }
  if (own.size !== undefined) {
    if (!/^\d+(x\d+)?$/i.test(own.size)) throw new WrongLine(`--size accepts WIDTHxHEIGHT, such as 800x600, or one number for a square, not ${own.size}`);
    [query.width, query.height = query.width] = own.size.toLowerCase().split('x');
  }
  const [file, output = own.output, ...rest] = files;
  if (!file) throw new WrongLine('a file is missing: npx zraster part.stl');
  if (rest.length) throw new WrongLine(`${rest[0]} is one file too many: npx zraster draws one`);
  return { file, output, query, type: own.type };
}

/* The option that differs least from a name: by letters to insert, remove or replace. */
function near(name, rows) {
  let best = '', least = Math.min(3, name.length);
  for (const other of [...rows.keys(), ...WRITTEN]) {
    let row = Array.from({ length: other.length + 1 }, (_, i) => i);
    for (let i = 0; i < name.length; i++)
      row = row.reduce((next, _, k) => [...next, k ? Math.min(row[k] + 1, next[k - 1] + 1, row[k - 1] + (name[i] !== other[k - 1])) : i + 1], []);
    if (row[other.length] < least) [best, least] = [other, row[other.length]];
  }
  return best ? `; did you mean ${dashed(best)}?` : '; npx zraster --help lists all';
}

function help(rows) {
  const lines = [...rows.values()].map(({ name, value, help }) => {
    const words = `${dashed(name)} ${value === 'BOOL' ? '[BOOL]' : value.replaceAll('_', ' ')}`;
    return `      ${words.padEnd(30)}  ${help}`;
  });
  return `${USAGE}\nOptions, which are the parameters of zraster:\n${lines.join('\n')}\n\n--name=value is the same as --name value. Without its value, [BOOL] is true.`;
}

/* Files that the file refers to, and those that these refer to, from its folder: none from outside of it. */
async function neighbours(z, file, body, type) {
  const parts = {}, folder = dirname(file), wanted = z.references(body, type);
  for (const name of wanted) {
    const path = normalize(name);
    if (name in parts || path.startsWith('..') || path.startsWith(sep)) continue;
    const data = await readFile(join(folder, path)).catch(() => null);
    if (!data) continue;
    parts[name] = { data, optional: true };
    if (extname(name).toLowerCase() === '.mtl')
      wanted.push(...z.references(data, 'mtl').map(below => join(dirname(name), below)));
  }
  return parts;
}

/* A reader that ends early is no fault. */
function print(bytes) {
  if (process.stdout.isTTY) throw new WrongLine('standard output is a terminal, and the output is a picture; -o FILE saves it');
  return new Promise((done, fail) => {
    process.stdout.on('error', error => (error.code === 'EPIPE' ? done() : fail(new Error(`standard output: ${FAULTS[error.code] ?? error.message}`))));
    process.stdout.write(bytes, error => error || done());
  });
}

const endingOf = file => extname(file).slice(1).toLowerCase();
const hasEnding = ending => row => row.suffix === ending || row.spelling === ending;

/* The encoding of an output's ending, if its channel has it and it is not the usual one. */
function encodingOf({ encodings, channels }, output, channel = 'color') {
  const row = encodings.find(hasEnding(endingOf(output))), allowed = channels.find(row => row.name === channel)?.encodings ?? [];
  return row && row.name !== 'png' && allowed.includes(row.name) ? { encoding: row.name } : {};
}

async function draw(z, { file, output, query, type }) {
  const { formats, encodings } = z.tables, ending = endingOf(file);
  if (output && output !== '-' && resolve(output) === resolve(file)) throw new WrongLine(`${file}: the output would overwrite its own input`);
  const body = file === '-' ? readFileSync(0) : await readFile(file);
  const kind = type ?? formats.find(row => row.suffix === ending)?.suffix;
  const isModel = !formats.find(row => row.suffix === kind)?.isScene, name = file === '-' ? undefined : basename(file);
  const asked = { ...(output ? encodingOf(z.tables, output, query.channel) : {}), ...(query.annotate && isModel && name ? { title: name } : {}), ...query };
  const picture = z.draw(body, { query: asked, type: kind, parts: await neighbours(z, file, body, kind) }), { bytes, type: made } = picture.encode();
  for (const line of picture.warnings) console.error(`zraster: ${file}: ${line}`);
  if (output === '-' || (!output && file === '-')) return print(bytes);
  const row = encodings.find(row => row.type === made) ?? encodings[0], wanted = output ? endingOf(output) : '';
  if (wanted && !hasEnding(wanted)(row) && !(row.name === 'apng' && wanted === 'png'))
    throw new WrongLine(`${output}: nothing is saved: the output is ${row.name.toUpperCase()}, so its name ends in .${row.suffix}`);
  const path = output ?? `${basename(file, extname(file))}.${row.suffix}`;
  await writeFile(path, bytes).catch(error => {
    const isMissing = error.code === 'ENOENT';
    throw new Error(isMissing ? `${path}: the folder ${dirname(path)} does not exist` : `${path}: ${FAULTS[error.code] ?? error.message}`);
  });
}

/* Faults of parameters name options; all others name the file. */
function told(error, file) {
  if (FAULTS[error.code]) return `${file}: ${FAULTS[error.code]}`;
  if (!error.status || error.status === 'internal') return error.message.replace(/^zraster: /, '');
  const text = error.message.replace(/^parameter (\w+):/gm, (_, name) => `${dashed(name)}:`);
  if (error.status === 'bad-request') return text;
  return text.includes('\n') ? `${file}:\n${text.replace(/^/gm, '  ')}` : `${file}: ${text}`;
}

async function main(words) {
  if (!words.length) {
    console.error(USAGE);
    return 2;
  }
  const z = await load(), rows = new Map(z.tables.parameters.map(row => [row.name, row]));
  if (words.includes('--help') || words.includes('-h')) console.log(help(rows));
  else if (words.includes('--version') || words.includes('-V')) console.log(`zraster ${z.version}`);
  else {
    let call = null;
    try {
      call = parse(words, rows);
      await draw(z, call);
    } catch (error) {
      console.error(`zraster: ${told(error, call?.file)}`);
      return error instanceof WrongLine || error.status === 'bad-request' ? 2 : 1;
    }
  }
  return 0;
}

process.exitCode = await main(process.argv.slice(2));
