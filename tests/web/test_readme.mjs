/* test_readme.mjs PACKAGE: the examples of clients/web/README.md run with the package, as npm installs it, in a canvas, a component and a
 * worker at the edge that are just large enough for them. */
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { end, test } from './check.mjs';

const work = mkdtempSync(join(tmpdir(), 'zraster-')), hook = resolve('tests/web/wasm_hook.mjs');
writeFileSync(join(work, 'package.json'), '{"private": true}');
const installed = spawnSync('npm', ['install', '--offline', '--no-audit', '--no-fund', resolve(process.argv[2])], { cwd: work, encoding: 'utf8' });
mkdirSync(join(work, 'node_modules/react'), { recursive: true });
for (const [, name, text] of readFileSync('clients/web/README.md', 'utf8').matchAll(/^```js file=(\S+)\n(.*?)^```$/gms)) writeFileSync(join(work, name), text);
const OBJ = 'v 0 0 0\nv 1 0 0\nv 1 1 0.5\nv 0 1 0\nf 1 2 3 4\n';
writeFileSync(join(work, 'part.obj'), OBJ);

/* A program in the folder of the examples. */
function node(...words) {
  const said = spawnSync('node', words, { cwd: work, encoding: 'utf8', timeout: 120000 });
  assert.equal(said.status, 0, said.stdout + said.stderr);
  return said.stdout;
}

/* A canvas of a page, with one picture. */
const page = `
globalThis.ImageData = class { constructor(data, width, height) { Object.assign(this, { data, width, height }); } };
const listeners = {}, frames = [];
globalThis.requestAnimationFrame = frame => frames.push(frame);
const pictures = [];
const canvas = { width: 80, height: 60, addEventListener: (type, take) => (listeners[type] = take), getContext: () => ({ putImageData: image => pictures.push(image) }) };
`;

await test('npm installs the package, and runs nothing of it', () => {
  assert.equal(installed.status, 0, installed.stderr);
  assert.equal(JSON.parse(readFileSync(join(work, 'node_modules/zraster/package.json'))).scripts, undefined);
});
await test('npx zraster part.obj part.png', () => {
  const said = spawnSync('npx', ['--no', 'zraster', 'part.obj', 'part.png', '--look', 'clay'], { cwd: work, encoding: 'utf8' });
  assert.equal(said.status, 0, said.stderr);
  assert.equal(readFileSync(join(work, 'part.png')).subarray(1, 4).toString(), 'PNG');
});
await test('thumbnails of a folder', () => {
  node('thumbnails.mjs', '.');
  assert.ok(existsSync(join(work, 'part.obj.png')));
});
await test('a test that compares pictures', () => {
  assert.match(node('--test', 'picture.test.mjs'), /^# pass 1$/m);
});
await test('a canvas that orbits', () => {
  writeFileSync(join(work, 'page.mjs'), `${page}
import { orbit } from './orbit.mjs';
await orbit(canvas, ${JSON.stringify(OBJ)});
listeners.pointermove({ buttons: 1, movementX: 40 });
frames.pop()();
if (pictures.length !== 2 || Buffer.from(pictures[0].data).equals(Buffer.from(pictures[1].data))) throw new Error('it does not orbit');
`);
  node('page.mjs');
});
await test('a worker at the edge', () => {
  writeFileSync(join(work, 'host.mjs'), `
import { register } from 'node:module';
register(${JSON.stringify(pathToFileURL(hook).href)});
const { default: worker } = await import('./edge.mjs');
const ask = body => worker.fetch(new Request('http://edge/?look=clay&width=50', { method: 'POST', body }));
const good = await ask(${JSON.stringify(OBJ)}), bad = await ask('{"meshes": 3}');
if (good.status !== 200 || good.headers.get('Content-Type') !== 'image/png') throw new Error('no picture');
if (bad.status !== 422 || !(await bad.json())[0].detail) throw new Error('no fault');
`);
  node('--conditions=workerd', 'host.mjs');
});
await test('a component for React', () => {
  writeFileSync(join(work, 'node_modules/react/package.json'), '{"name": "react", "type": "module", "exports": "./react.mjs"}');
  writeFileSync(join(work, 'node_modules/react/react.mjs'), `
export const left = [];
export const createElement = (type, properties) => ({ type, properties });
export const useRef = current => ({ current });
export const useEffect = effect => left.push(effect);
`);
  writeFileSync(join(work, 'app.mjs'), `${page}
import { left } from 'react';
import { Model } from './Model.mjs';
const element = Model({ body: ${JSON.stringify(OBJ)}, width: 80, height: 60, look: 'clay' });
element.properties.ref.current = canvas;
const leave = left.pop()();
while (!pictures.length) await new Promise(resolve => setTimeout(resolve, 20));
leave();
if (pictures[0].width !== 80) throw new Error('another picture');
`);
  node('app.mjs');
});
rmSync(work, { recursive: true });
end();
