// main.mjs - the package in a bundle, on the page and in a Worker.
import { load } from 'zraster';
import { load as open } from 'zraster/worker';

const OBJ = 'v 0 0 0\nv 1 0 0\nv 1 1 0.5\nv 0 1 0\nf 1 2 3 4\n';
async function run() {
  await say('page', (await load()).draw(OBJ, { size: 40 }).encode().bytes);
  const picture = await (await open()).draw(OBJ, { size: 40 });
  await say('worker', (await picture.encode()).bytes);
}
run().then(() => say('end', ''), error => say('end', error.stack));
