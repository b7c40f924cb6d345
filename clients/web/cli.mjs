#!/usr/bin/env node
/* cli.mjs - npx zraster part.stl part.png --look technical --size 800x600: options are the parameters of a query. */
import { readFile, writeFile } from 'node:fs/promises';
import { basename, dirname, extname, join, normalize, sep } from 'node:path';
import { load } from './node.mjs';

const USAGE = `Usage: zraster FILE [OUTPUT] [--OPTION VALUE]...
Draws a 3D model or scene to a picture.

  npx zraster part.stl                              write part.png
  npx zraster part.stl out.png --look technical --size 800x600

Options are the parameters of zraster: --look, --width, --height, --preset, --azimuth, --channel, ...
`;
const camel = name => name.replace(/-([a-z])/g, (_, letter) => letter.toUpperCase());

function parse(words) {
  const files = [], query = {};
  for (let i = 0; i < words.length; i++) {
    if (!words[i].startsWith('--')) {
      files.push(words[i]);
      continue;
    }
    const [name, given] = words[i].slice(2).split(/=(.*)/s), value = given ?? words[++i];
    if (value === undefined) throw new Error(`${words[i - 1]}: a value is missing`);
    if (name === 'size') [query.width, query.height = query.width] = value.split('x');
    else query[camel(name)] = value;
  }
  return { files, query };
}

/* Files that the file refers to, and those that these refer to, from its folder: none from outside of it. */
async function neighbours(z, file, body) {
  const parts = {}, folder = dirname(file), wanted = z.references(body);
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

async function main(words) {
  if (!words.length || words.includes('--help')) return console.log(USAGE);
  const { files: [file, output], query } = parse(words);
  if (!file) throw new Error('a file is missing');
  const z = await load(), body = await readFile(file);
  const picture = z.draw(body, { query, parts: await neighbours(z, file, body) });
  const { bytes, type } = picture.encode(), ending = z.tables.encodings.find(row => row.type === type)?.suffix ?? 'png';
  for (const line of picture.warnings) console.error(`zraster: ${file}: ${line}`);
  await writeFile(output ?? `${basename(file, extname(file))}.${ending}`, bytes);
}

main(process.argv.slice(2)).catch(error => {
  console.error(`zraster: ${error.message}`);
  process.exitCode = 1;
});
