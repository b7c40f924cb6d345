/* sizes.mjs SITE: what a visitor loads of the folder of `make site`, gzipped: its modules, its page and pictures of looks. */
import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { gzipSync } from 'node:zlib';
import { end, test } from './check.mjs';

const site = process.argv[2];
const gzipped = names => names.reduce((sum, name) => sum + gzipSync(readFileSync(join(site, name)), { level: 9 }).length, 0);
const scripts = readdirSync(join(site, 'engine')).filter(name => name.endsWith('.mjs')).map(name => `engine/${name}`);
const looks = readdirSync(join(site, 'looks')).map(name => `looks/${name}`);

for (const [name, files, least, most] of [
  ['the module', ['engine/zraster.wasm'], 500_000, 1_000_000],
  ['the module without SIMD', ['engine/zraster-scalar.wasm'], 500_000, 1_000_000],
  ['the page beside the module', ['index.html', 'offline.js', ...scripts], 10_000, 40_000],
  ['pictures of looks', looks, 10_000, 40_000],
]) await test(`${name}: at most ${most} bytes`, () => {
  const bytes = gzipped(files);
  console.log(`# ${name}: ${bytes} bytes`);
  assert.ok(bytes >= least && bytes <= most, `${bytes} bytes`);
});
end();
