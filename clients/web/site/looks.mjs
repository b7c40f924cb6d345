/* looks.mjs PACKAGE EXAMPLES OUT: prints the list of looks, as GET /v1/looks answers it. Draws the first example in each, as OUT/LOOK.webp, and
 * larger as OUT/first.webp and OUT/first-dark.webp, for light and dark pages. */
import { readFile, writeFile } from 'node:fs/promises';
import { pathToFileURL } from 'node:url';
import { resolve } from 'node:path';

const [source, examples, out] = process.argv.slice(2);
const { load } = await import(pathToFileURL(resolve(source, 'node.mjs')));
const zraster = await load(), { looks, words } = zraster.tables;
const all = words.filter(word => word.kind === 'look').map(({ name, text }) => ({
  name,
  text,
  versions: looks.map(look => look.split('@')).filter(([other]) => other === name).map(([, version]) => Number(version)),
}));
console.log(JSON.stringify({ looks: all }));

/* The bytes of all pictures are at most 40 kB. */
const TILE = { size: [160, 120], most: 2048 }, FIRST = { size: [720, 480], most: 10240 };
const body = await readFile(`${examples}/bearing.json`, 'utf8'), parts = {};
for (const name of zraster.references(body)) parts[name] = await readFile(`${examples}/${name}`);
const example = zraster.read(body, { parts });

async function draw(name, look, { size: [width, height], most }) {
  const outputs = [{ channel: 'color', encoding: 'webp', maxBytes: most }];
  const picture = example.draw({ look, outputs, window: { width, height } });
  await writeFile(`${out}/${name}.webp`, picture.encode().bytes);
  picture.free();
}

for (const { name } of all) await draw(name, name, TILE);
await draw('first', 'studio', FIRST);
await draw('first-dark', 'dark', FIRST);
