/* test_browser.mjs FOLDER: the package in FOLDER, in Chromium: scenes and a model have the pixels that Node gives, on the page and in a
 * Worker, with SIMD and without. */
import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { SAY, visit } from './browser.mjs';
import { end, sameBytes, test } from './check.mjs';

const folder = process.argv[2], { load } = await import(pathToFileURL(resolve(folder, 'node.mjs')));
const scenes = readdirSync('tests/scenes').filter(name => name.endsWith('.json')).filter((_, i) => i % 8 === 0);
const PAGE = `<!doctype html><title>zraster</title><script type="module">
${SAY}try {
  const { load } = await import('/package/browser.mjs'), { load: open } = await import('/package/worker.mjs');
  const here = await load(), scalar = await load('/package/zraster-scalar.wasm'), there = await open();
  for (const name of ${JSON.stringify(scenes)}) {
    const text = await (await fetch('/scenes/' + name)).text();
    await say('page/' + name, here.draw(text).encode().bytes);
    await say('scalar/' + name, scalar.draw(text).encode().bytes);
    await say('worker/' + name, (await (await there.draw(text)).encode()).bytes);
  }
  const canvas = new OffscreenCanvas(64, 48);
  const picture = here.draw('v 0 0 0\\nv 1 0 0\\nv 0 1 0\\nf 1 2 3\\n', { size: [64, 48], look: 'textbook' });
  canvas.getContext('2d').putImageData(picture.imageData(), 0, 0);
  await say('canvas', canvas.getContext('2d').getImageData(0, 0, 64, 48).data);
  await say('end', '');
} catch (error) {
  await say('end', error.stack);
}
</script>`;

const got = await visit(path => {
  if (path.startsWith('/package/')) return join(folder, path.slice(9));
  return path.startsWith('/scenes/') ? join('tests/scenes', path.slice(8)) : PAGE;
});

await test('the page ran to its end', () => assert.equal(String(got.get('end')), ''));
const z = await load();
for (const name of scenes)
  await test(name, () => {
    const want = z.draw(readFileSync(join('tests/scenes', name))).encode().bytes;
    for (const place of ['page', 'scalar', 'worker']) sameBytes(want, got.get(`${place}/${name}`), place);
  });
await test('a canvas has the colours', () => {
  const want = z.draw('v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n', { size: [64, 48], look: 'textbook' }).channel().data;
  assert.ok(got.get('canvas').equals(Buffer.from(want)));
});
end();
