/* test_module.mjs FOLDER: the package in FOLDER: its errors, a maximum of memory, faults of the module, its options. */
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';
import { end, sameBytes, test } from './check.mjs';

const folder = pathToFileURL(`${process.argv[2]}/`);
const { load, Zraster } = await import(new URL('node.mjs', folder));
const wasm = readFileSync(new URL('zraster.wasm', folder)), scalar = readFileSync(new URL('zraster-scalar.wasm', folder));
const OBJ = 'v 0 0 0\nv 1 0 0\nv 1 1 0.5\nv 0 1 0\nf 1 2 3 4\n';
const scene = JSON.parse(readFileSync('tests/scenes/flat-lit.json'));
const refused = status => error => error.status === status;
const z = await load();

await test('the one without SIMD draws the same bytes', async () => {
  const other = await load(scalar);
  sameBytes(z.draw(OBJ).encode().bytes, other.draw(OBJ).encode().bytes);
});
await test('a module, a promise of bytes and a Response open it', async () => {
  const response = new Response(wasm, { headers: { 'Content-Type': 'application/wasm' } });
  for (const source of [z.module, Promise.resolve(wasm), response]) assert.equal((await load(source)).version, z.version);
});
await test('a scene draws as its text does', () => {
  sameBytes(z.draw(scene).encode().bytes, z.draw(JSON.stringify(scene)).encode().bytes);
});
await test('lists of numbers in a scene may be typed arrays', () => {
  const corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0]];
  const draw = vertices => z.draw({ polygons: [{ vertices }] }, { size: 40 }).encode().bytes;
  for (const made of [corner => new Float32Array(corner), corner => new Uint16Array(corner), corner => Buffer.from(corner), corner => corner.map(BigInt)])
    sameBytes(draw(corners), draw(corners.map(made)));
  sameBytes(draw(corners), z.draw({ polygons: [{ vertices: corners }] }, { size: new Uint32Array([40, 40]) }).encode().bytes);
  assert.throws(() => draw(new Float64Array(corners.flat())), { message: /^\/polygons\/0\/vertices\/0: expected a list of numbers, found a number\n/ });
});
await test('what is no option, body or scene is refused', async () => {
  const isRefused = error => error.status === 'bad-request', other = await load();
  for (const options of [{ size: [] }, { size: [1, 2, 3] }, { size: 20, width: 10 }, { raw: true, lok: 1 }, { query: 'look=clay&look=dark', size: 40 }, { query: 5, size: 40 }])
    assert.throws(() => z.draw(OBJ, options), isRefused, JSON.stringify(options));
  assert.deepEqual(z.draw(OBJ, { size: [80] }).channel().shape, [80, 80, 4]);
  for (const body of [Promise.resolve(OBJ), new Blob([OBJ]), new Response(OBJ)]) assert.throws(() => z.draw(body), isRefused);
  for (const options of [{ memorymax: 2 ** 28 }, { memoryMax: 2 ** 23 }]) await assert.rejects(load(undefined, options), isRefused);
  const mine = z.read(OBJ);
  for (const wrong of [other.read(OBJ), z.draw(OBJ, { size: 9 }), {}, undefined]) assert.throws(() => z.compare(mine, wrong), isRefused);
  assert.throws(() => z.imageData(OBJ), isRefused); /* Node has no ImageData */
});
await test('a module that is closed while it opens stays closed', async () => {
  const other = await load(), opening = other.reopen();
  other.close();
  await opening;
  assert.throws(() => other.draw(OBJ), refused('ended'));
});
await test('options are parameters, in both spellings', () => {
  const want = z.draw(OBJ, { query: 'look=clay&width=90&height=70&creaseDegrees=10' }).encode().bytes;
  sameBytes(want, z.draw(OBJ, { look: 'clay', size: [90, 70], creaseDegrees: 10 }).encode().bytes);
  sameBytes(want, z.draw(OBJ, { look: 'clay', width: 90, height: 70, crease_degrees: 10 }).encode().bytes);
});
await test('options of scenes are their keys', () => {
  const want = z.draw({ ...scene, window: { width: 50, height: 40 } }).channel().data;
  assert.deepEqual(z.draw(scene, { size: [50, 40] }).channel().data, want);
});
await test('channels are arrays', () => {
  const picture = z.draw(OBJ, { size: [60, 40], channels: ['color', 'depth', 'normals'] });
  const depth = picture.channel('depth');
  assert.deepEqual([depth.shape, depth.data.constructor, picture.channel('normals').shape], [[40, 60], Float32Array, [40, 60, 3]]);
  assert.equal(picture.channel('faceId'), null);
});
await test('arrays are parts', () => {
  const parts = { p: { data: new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0]), shape: [3, 3] }, f: { data: new Uint32Array([0, 1, 2]), shape: [1, 3] } };
  const mesh = { meshes: [{ positions: { asset: 'p' }, faces: { asset: 'f' } }] };
  const list = { meshes: [{ positions: [[0, 0, 0], [1, 0, 0], [0, 1, 0]], faces: [[0, 1, 2]] }] };
  sameBytes(z.draw(mesh, { parts }).encode().bytes, z.draw(list).encode().bytes);
  assert.throws(() => z.draw(mesh, { parts: { p: { data: new Float32Array(4), shape: [3, 3] } } }), refused('bad-request'));
});
await test('a scene that was read is drawn with other keys', () => {
  const read = z.read(OBJ), front = read.draw({ background: '#102030' }, { look: 'clay', size: [64, 48], azimuth: 20 });
  assert.deepEqual([front.channel().shape, front.look], [[48, 64, 4], 'clay@1']);
  front.free();
  read.free();
  assert.throws(() => read.draw(), refused('ended'));
});
await test('faults have their places', () => {
  assert.throws(() => z.draw({ meshes: 3 }), error => error.status === 'bad-scene' && error.faults[0].pointer === '/meshes');
  assert.throws(() => z.draw(OBJ, { look: 'tecnical' }), /did you mean technical/);
  assert.throws(() => z.draw(OBJ, { lok: 'clay' }), /unknown option: lok/);
  assert.throws(() => z.draw('solid'), error => Boolean(error.status));
});
await test('libpng and libjpeg jump out of broken pictures', () => {
  for (const [bytes, text] of [
    ['\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\x04\0\0\0\x04\x08\x02\0\0\0&\x93\t)\0\0\0\x04IDAT', /a broken PNG: it ends too early/],
    ['\xff\xd8\xff\xdb\0\x43\0broken', /a broken JPEG: it ends too early/],
  ]) {
    const parts = { t: Buffer.from(bytes, 'latin1') }, mesh = { positions: [[0, 0, 0], [1, 0, 0], [0, 1, 0]], faces: [[0, 1, 2]], texcoords: [[0, 0], [1, 0], [0, 1]], material: 'a' };
    assert.throws(() => z.draw({ materials: [{ name: 'a', baseColorTexture: { asset: 't' } }], meshes: [mesh] }, { parts }), text);
  }
  assert.equal(z.ended, '');
});
await test('memory beyond the maximum is an error, and the next picture is drawn', async () => {
  const small = await load(undefined, { memoryMax: 24 * 2 ** 20 });
  assert.throws(() => small.draw(OBJ, { size: 4000, look: 'studio' }), refused('no-memory'));
  assert.throws(() => small.draw(new Uint8Array(30 * 2 ** 20)), refused('no-memory'));
  assert.ok(small.draw(OBJ, { size: 64 }).encode().bytes.length > 100);
  assert.ok(small.memory <= 24 * 2 ** 20);
  await assert.rejects(load(undefined, { memoryMax: 1000 }), refused('bad-request'));
});
await test('after a fault the module says so, and is opened again', async () => {
  const broken = await load(), picture = broken.draw(OBJ, { size: 32 });
  assert.throws(() => broken.call('zraster_draw', -16, -16, -16, -16), error => error.status === 'internal' && /reopen/.test(error.message));
  assert.throws(() => broken.draw(OBJ), refused('ended'));
  await broken.reopen();
  assert.throws(() => picture.encode(), refused('ended'));
  assert.ok(broken.draw(OBJ, { size: 32 }).encode().bytes.length > 100);
});
await test('a thousand pictures take no more memory than ten', async () => {
  const one = await load();
  const draw = () => { const picture = one.draw(OBJ, { size: 48 }); picture.encode(); picture.free(); };
  for (let i = 0; i < 10; i++) draw();
  const before = one.memory;
  for (let i = 0; i < 1000; i++) draw();
  assert.equal(one.memory, before);
});
await test('a closed renderer says so', async () => {
  const closed = await load();
  closed.close();
  assert.throws(() => closed.draw(OBJ), refused('ended'));
});
end();
