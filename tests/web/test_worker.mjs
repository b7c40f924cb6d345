/* test_worker.mjs FOLDER: the Worker of the package in FOLDER, in Node, and the command of npx. */
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { end, sameBytes, test } from './check.mjs';

const folder = pathToFileURL(`${process.argv[2]}/`), work = mkdtempSync(join(tmpdir(), 'zraster-'));
const { load } = await import(new URL('node.mjs', folder)), worker = await import(new URL('worker.mjs', folder));
const OBJ = 'mtllib part.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0.5\nv 0 1 0\nusemtl red\nf 1 2 3 4\n';
const here = await load(), there = await worker.load();

await test('a Worker draws the same picture', async () => {
  const picture = await there.draw(OBJ, { look: 'clay', size: 64 }), { bytes, type } = await picture.encode();
  assert.equal(type, 'image/png');
  assert.equal(picture.look, 'clay@1');
  sameBytes(bytes, here.draw(OBJ, { look: 'clay', size: 64 }).encode().bytes);
  assert.deepEqual((await picture.channel()).shape, [64, 64, 4]);
  await picture.free();
  await assert.rejects(picture.encode(), error => error.status === 'ended');
});
await test('scenes stay there, and faults come back', async () => {
  const scene = await there.read(OBJ), picture = await scene.draw({}, { size: 40 });
  assert.deepEqual((await picture.channel()).shape, [40, 40, 4]);
  await assert.rejects(there.draw({ meshes: 3 }), error => error.faults[0].pointer === '/meshes');
  assert.deepEqual(await there.references(OBJ), ['part.mtl']);
});
await test('a signal ends a call at once, and the next one draws', async () => {
  const old = await there.read(OBJ), signal = AbortSignal.timeout(100), begin = Date.now();
  await assert.rejects(there.draw(OBJ, { size: 4000, look: 'studio', samples: 16, signal }), error => error.status === 'cancelled');
  assert.ok(Date.now() - begin < 2000);
  await assert.rejects(old.draw(), error => error.status === 'ended');
  assert.deepEqual((await (await there.draw(OBJ, { size: 20 })).channel()).shape, [20, 20, 4]);
  await assert.rejects(there.draw(OBJ, { signal: AbortSignal.abort() }), error => error.status === 'cancelled');
});
await test('npx zraster writes a picture, with the materials beside the file', () => {
  writeFileSync(join(work, 'part.obj'), OBJ);
  writeFileSync(join(work, 'part.mtl'), 'newmtl red\nKd 1 0 0\n');
  const cli = resolve(process.argv[2], 'cli.mjs');
  const said = spawnSync('node', [cli, 'part.obj', 'out.png', '--look', 'studio', '--size', '64x48'], { cwd: work, encoding: 'utf8' });
  assert.equal(said.stderr, '');
  const parts = { 'part.mtl': Buffer.from('newmtl red\nKd 1 0 0\n') };
  sameBytes(readFileSync(join(work, 'out.png')), here.draw(OBJ, { look: 'studio', size: [64, 48], parts }).encode().bytes);
  assert.match(spawnSync('node', [cli, 'part.obj', '--look', 'tecnical'], { cwd: work, encoding: 'utf8' }).stderr, /did you mean technical/);
  assert.match(spawnSync('node', [cli, 'none.obj'], { cwd: work, encoding: 'utf8' }).stderr, /ENOENT/);
});
rmSync(work, { recursive: true });
end();
