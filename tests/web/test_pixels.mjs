/* test_pixels.mjs BUILD MODULE: all scenes of tests/scenes, as they are and with other channels, and models in all looks, by the
 * module in Node and by the command: the same pixels. */
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { load } from '../../clients/web/zraster.mjs';
import { drawsAlike, end, test } from './check.mjs';

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
console.log(`# ${refused} of them refused by both`);
console.log(`# ${z.memory >> 20} MiB of memory`);
end();
