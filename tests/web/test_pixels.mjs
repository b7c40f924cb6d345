/* test_pixels.mjs BUILD MODULE: all scenes of tests/scenes, as they are and with other channels, all encodings, textures of all formats, and
 * models in all looks, by the module in Node and by the command: the same pixels. */
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { load } from '../../clients/web/zraster.mjs';
import { drawsAlike, end, sameBytes, test } from './check.mjs';

const [build, module] = process.argv.slice(2);
const z = await load(readFileSync(module));
const models = join(process.env.ZRASTER_DATA ?? '../shared/data', 'models');
const CHANNELS = 'color,depth,windowDepth,faceId,distance,instanceId,frontFacing,barycentrics,position,normals,texcoord';

let refused = 0;

function same(file, options) {
  if (!drawsAlike(z, build, file, options)) refused++;
}

const folder = 'tests/scenes';
for (const name of readdirSync(folder).filter(name => name.endsWith('.json')).sort()) {
  await test(name, () => same(join(folder, name)));
  await test(`${name}, channels`, () => same(join(folder, name), { channel: CHANNELS }));
}
for (const name of ['beetle', 'cow', 'fandisk', 'spot', 'stanford-bunny', 'suzanne', 'teapot', 'parts/gear', 'parts/housing', 'parts/plate']) {
  const file = join(models, `${name}.obj`);
  if (!existsSync(file)) console.error(`LEFT OUT: ${name}: there is no ${file}`);
  else for (const look of z.tables.looks)
    await test(`${name}, ${look}`, () => same(file, { look, width: '320', height: '240' }));
}

const work = mkdtempSync(join(tmpdir(), 'zraster-')), command = (...words) => spawnSync(join(build, 'zraster'), [...words, '-o', '-'], { maxBuffer: 2 ** 28 }).stdout;
for (const { name: channel, encodings } of z.tables.channels)
  for (const encoding of encodings)
    await test(`${channel} as ${encoding}`, () => same('clients/examples/cube.json', { channel, encoding }));
for (const encoding of ['jpeg', 'png', 'webp'])
  await test(`a texture as ${encoding}`, () => {
    const image = command('tests/scenes/look-textures.json', '--channel', 'color', '--encoding', encoding), file = join(work, 'scene.json');
    const mesh = { positions: [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], faces: [[0, 1, 2, 3]], texcoords: [[0, 0], [1, 0], [1, 1], [0, 1]], material: 'a' };
    const scene = JSON.stringify({ materials: [{ name: 'a', baseColorTexture: { asset: 'image' } }], meshes: [mesh] });
    writeFileSync(join(work, 'image'), image);
    writeFileSync(file, scene);
    const want = command(file);
    assert.ok(want.length > 1000);
    sameBytes(want, z.draw(scene, { parts: { image } }).encode().bytes);
  });
rmSync(work, { recursive: true });
console.log(`# ${refused} of them refused by both`);
console.log(`# ${z.memory >> 20} MiB of memory`);
end();
