/* test_worker.mjs FOLDER: the Worker of the package in FOLDER, in Node, and the command of npx. */
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { end, sameBytes, test } from './check.mjs';

const folder = pathToFileURL(`${process.argv[2]}/`), work = mkdtempSync(join(tmpdir(), 'zraster-'));
const { load } = await import(new URL('node.mjs', folder)), worker = await import(new URL('node_worker.mjs', folder));
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
await test('the signal of one call leaves the others', async () => {
  const long = { size: 4000, look: 'studio', samples: 16 }, running = new AbortController(), waiting = new AbortController();
  const calls = [there.draw(OBJ, { ...long, signal: running.signal }), there.draw(OBJ, { size: 30, signal: waiting.signal }), there.draw(OBJ, { size: 20 })];
  setTimeout(() => running.abort(), 100);
  waiting.abort();
  const [first, second, third] = await Promise.allSettled(calls);
  assert.deepEqual([first.reason?.status, second.reason?.status], ['cancelled', 'cancelled']);
  assert.deepEqual((await third.value.channel()).shape, [20, 20, 4]);
  const [a, b] = await Promise.all([there.draw(OBJ, { size: 10 }), there.draw(OBJ, { size: 12 })]);
  assert.deepEqual([(await a.channel()).shape[0], (await b.channel()).shape[0]], [10, 12]);
});
await test('a closed Worker says so, and is opened again', async () => {
  const closed = await worker.load();
  closed.close();
  await assert.rejects(closed.draw(OBJ), error => error.status === 'ended');
  const opening = closed.reopen(), picture = await closed.draw(OBJ, { size: 20 });
  await opening;
  assert.deepEqual((await picture.channel()).shape, [20, 20, 4]);
  closed.close();
});
await test('a Worker that is opened and closed at once settles all calls', async () => {
  const other = await worker.load(), statusOf = ({ reason }) => reason?.status;
  assert.deepEqual(await Promise.all([other.reopen(), other.reopen()]), [undefined, undefined]);
  const calls = [other.draw(OBJ, { size: 20 })];
  other.close();
  calls.push(other.reopen(), other.draw(OBJ, { size: 30 }));
  const settled = await Promise.allSettled(calls);
  assert.deepEqual(settled.map(statusOf), ['cancelled', undefined, undefined]);
  assert.deepEqual((await settled[2].value.channel()).shape, [30, 30, 4]);
  const opening = other.reopen();
  other.close();
  await assert.rejects(opening, error => error.status === 'cancelled');
});
await test('what cannot be sent is refused, and a picture is freed twice', async () => {
  await assert.rejects(there.draw(OBJ, { look: () => 1 }), error => error.status === 'bad-request');
  const picture = await there.draw(OBJ, { size: 20 });
  await picture.free();
  await picture.free();
});
await test('a URL of a file, its text and a Response open both', async () => {
  const url = new URL('zraster-scalar.wasm', folder), response = () => new Response(readFileSync(url), { headers: { 'Content-Type': 'application/wasm' } });
  for (const source of [() => url, () => url.href, response])
    for (const open of [load, worker.load]) {
      const z = await open(source());
      assert.equal(z.version, here.version);
      z.close();
    }
  await assert.rejects(worker.load(new URL('none.wasm', folder)), /none.wasm/);
});
await test('npx zraster writes a picture, with the materials beside the file', () => {
  writeFileSync(join(work, 'part.obj'), OBJ);
  writeFileSync(join(work, 'part.mtl'), 'newmtl red\nKd 1 0 0\n');
  const cli = resolve(process.argv[2], 'cli.mjs');
  const said = spawnSync('node', [cli, 'part.obj', 'out.png', '--look', 'studio', '--size', '64x48'], { cwd: work, encoding: 'utf8' });
  assert.equal(said.stderr, '');
  const parts = { 'part.mtl': Buffer.from('newmtl red\nKd 1 0 0\n') };
  sameBytes(readFileSync(join(work, 'out.png')), here.draw(OBJ, { look: 'studio', size: [64, 48], parts }).encode().bytes);
});
await test('npx zraster tells of faults as the command does', () => {
  const cli = resolve(process.argv[2], 'cli.mjs'), say = line => spawnSync('node', [cli, ...line.split(' ')], { cwd: work, encoding: 'utf8' });
  writeFileSync(join(work, 'junk.stl'), 'junk\n');
  for (const [line, status, text] of [
    ['part.obj --look tecnical', 2, /^zraster: --look: 'tecnical' is unknown \(did you mean technical\?\)/],
    ['part.obj --lok clay', 2, /^zraster: unknown option --lok; did you mean --look\?$/m],
    ['part.obj --creaseDegrees', 2, /^zraster: a value is missing after --creaseDegrees: --creaseDegrees DEGREES$/m],
    ['part.obj -z 3', 2, /^zraster: unknown option -z; npx zraster --help lists all$/m],
    ['part.obj --size axb', 2, /^zraster: --size accepts WIDTHxHEIGHT, such as 800x600, or one number for a square, not axb$/m],
    ['part.obj a b', 2, /^zraster: b is one file too many/],
    ['none.obj', 1, /^zraster: none.obj: there is no such file$/m],
    ['.', 1, /^zraster: .: it is a folder$/m],
    ['junk.stl', 1, /^zraster: junk.stl: neither 'solid' nor a binary header/],
    ['part.obj none/out.png', 1, /^zraster: none\/out.png: the folder none does not exist$/m],
    ['part.obj part.obj', 2, /^zraster: part.obj: the output would overwrite its own input$/m],
    ['part.obj out.xyz', 2, /^zraster: out.xyz: nothing is saved: the output is PNG, so its name ends in .png$/m],
    ['part.obj out.jpg -c depth', 2, /^zraster: out.jpg: nothing is saved: the output is NPY, so its name ends in .npy$/m],
  ]) {
    const said = say(line);
    assert.match(said.stderr, text);
    assert.equal(said.status, status, line);
  }
  const bare = spawnSync('node', [cli], { encoding: 'utf8' });
  assert.deepEqual([bare.status, /^Usage: /.test(bare.stderr)], [2, true]);
  assert.match(say('--help').stdout, /--ground-shadow \[BOOL\]/);
  assert.match(say('-V').stdout, /^zraster \d/);
});
await test('npx zraster writes the format of the ending, and to standard output', () => {
  const cli = resolve(process.argv[2], 'cli.mjs'), run = (line, input) => spawnSync('node', [cli, ...line.split(' ')], { cwd: work, input });
  for (const [name, start] of [['out.jpg', '\xff\xd8'], ['out.jpeg', '\xff\xd8'], ['out.webp', 'RIFF'], ['out.svg', '<svg']]) {
    assert.equal(run(`part.obj ${name} --edges --size 40`).status, 0);
    assert.equal(readFileSync(join(work, name)).subarray(0, start.length).toString('latin1'), start);
  }
  assert.equal(run('- -s 40', OBJ).stdout.subarray(1, 4).toString(), 'PNG');
  assert.equal(run('part.obj -o - -s 40').stdout.subarray(1, 4).toString(), 'PNG');
});
rmSync(work, { recursive: true });
end();
