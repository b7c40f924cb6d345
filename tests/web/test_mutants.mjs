/* test_mutants.mjs BUILD MODULE [COUNT]: scenes and models with changed bytes, by the module in Node and by the command: the same pixels, or the
 * same fault; and no trap. */
import { existsSync, mkdtempSync, readdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { extname, join } from 'node:path';
import { load } from '../../clients/web/zraster.mjs';
import { drawsAlike, end, test } from './check.mjs';

const [build, module, count = '200'] = process.argv.slice(2), MOST = 60000;
const z = await load(readFileSync(module)), work = mkdtempSync(join(tmpdir(), 'zraster-'));
const data = process.env.ZRASTER_DATA ?? '../shared/data';
const endings = new Set(z.tables.formats.map(row => `.${row.suffix}`));

function filesOf(folder) {
  if (!existsSync(folder)) {
    console.error(`LEFT OUT: there is no ${folder}`);
    return [];
  }
  const files = readdirSync(folder).sort().map(name => join(folder, name));
  return files.filter(file => endings.has(extname(file)) && statSync(file).isFile() && statSync(file).size <= MOST);
}

const seeds = ['tests/scenes', 'clients/examples', join(data, 'hunt'), join(data, 'hunt2/files'), join(data, 'models/parts')].flatMap(filesOf);

/* Numbers from 0 up to most - 1, the same in each run. */
let state = 1;
function below(most) {
  state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
  return Math.floor((state / 2 ** 32) * most);
}

/* Digits of texts become others; one of eight changes is any character, and one of eight files is cut. */
function mutant(bytes) {
  const out = Uint8Array.from(bytes), characters = '0123456789-.,:[]{}"eE ';
  const isText = !out.subarray(0, 512).includes(0), most = out.length;
  for (let i = 1 + below(4); i > 0; i--) {
    let at = below(most);
    const isAny = below(8) === 0;
    while (isText && !isAny && at < most && !(out[at] >= 48 && out[at] <= 57)) at++;
    if (at < most) out[at] = !isText ? below(256) : characters.charCodeAt(below(isAny ? characters.length : 10));
  }
  return below(8) === 0 ? out.subarray(0, below(most)) : out;
}

let drawn = 0, refused = 0;

function same(file) {
  if (drawsAlike(z, build, file, {}, extname(file).slice(1))) drawn++;
  else refused++;
}

for (let i = 0; i < Number(count); i++) {
  const seed = seeds[below(seeds.length)], file = join(work, `${i}${extname(seed)}`);
  writeFileSync(file, mutant(readFileSync(seed)));
  await test(`${i}: ${seed}`, () => same(file));
  rmSync(file);
}
rmSync(work, { recursive: true });
console.log(`# ${drawn} drawn, ${refused} refused by both; ${z.memory >> 20} MiB`);
end();
