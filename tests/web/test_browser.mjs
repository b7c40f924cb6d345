/* test_browser.mjs FOLDER: the package in FOLDER, in Chromium: scenes and a model have the pixels that Node gives, on the page and in a
 * Worker, with SIMD and without. */
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { mkdtempSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { extname, join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { end, sameBytes, test } from './check.mjs';

const folder = process.argv[2], { load } = await import(pathToFileURL(resolve(folder, 'node.mjs')));
const TYPES = { '.mjs': 'text/javascript', '.wasm': 'application/wasm', '.html': 'text/html' };
const scenes = readdirSync('tests/scenes').filter(name => name.endsWith('.json')).filter((_, i) => i % 8 === 0);
const PAGE = `<!doctype html><title>zraster</title><script type="module">
const say = (name, body) => fetch('/got/' + name, { method: 'POST', body });
try {
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

const got = new Map();
let finish;
const finished = new Promise(resolve => (finish = resolve));
const server = createServer(async (request, response) => {
  const parts = [], path = new URL(request.url, 'http://page').pathname;
  for await (const part of request) parts.push(part);
  const file = path.startsWith('/package/') ? join(folder, path.slice(9)) : path.startsWith('/scenes/') ? join('tests/scenes', path.slice(8)) : null;
  if (path.startsWith('/got/')) got.set(path.slice(5), Buffer.concat(parts));
  response.setHeader('Content-Type', TYPES[extname(path)] ?? 'text/html');
  try {
    response.end(file ? readFileSync(file) : request.method === 'POST' ? '' : PAGE);
  } catch {
    response.writeHead(404).end();
  }
  if (path === '/got/end') finish(Buffer.concat(parts).toString());
}).listen(0, '127.0.0.1');
await once(server, 'listening');
const profile = mkdtempSync(join(tmpdir(), 'zraster-')), address = `http://127.0.0.1:${server.address().port}/`;
const browser = spawn('chromium', ['--headless=new', '--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage', '--no-first-run', '--disable-background-networking', `--user-data-dir=${profile}`, address], { stdio: 'ignore' });
const timer = setTimeout(() => finish('Chromium said nothing for two minutes'), 120000);
const fault = await finished;
clearTimeout(timer);
browser.kill();
await once(browser, 'exit');
server.close();
server.closeAllConnections();
rmSync(profile, { recursive: true, force: true, maxRetries: 5 });

await test('the page ran to its end', () => assert.equal(fault, ''));
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
