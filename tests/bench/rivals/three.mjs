/* three.mjs BUILD MESH.obj ROUNDS: the module in Node and in Chromium: its opening, its redraws beside those of the library, and its redraw on a
 * page beside that of three by WebGL in software (SwiftShader). In turns, medians. `make bench-three` installs and runs it; BUILD/bench gets
 * the pictures of the page. */
import { spawn, spawnSync } from 'node:child_process';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { createInterface } from 'node:readline';
import { pathToFileURL } from 'node:url';
import { SAY, visit } from '../../web/browser.mjs';

const [build, mesh, count] = process.argv.slice(2), rounds = Number(count), folder = join(build, 'npm/zraster'), SIZE = [640, 480];
const { load } = await import(pathToFileURL(resolve(folder, 'node.mjs')));

const median = values => [...values].sort((a, b) => a - b)[values.length >> 1];

function print(name, ours, theirs, ratio, bar, isMet) {
  console.log(`${name.padEnd(62)}${ours.padStart(12)}${theirs.padStart(14)}${ratio.padStart(9)}   (bar ${bar})  ${isMet ? 'ok' : 'SHORT'}`);
}
const ms = value => `${value.toFixed(1)} ms`;

/* Milliseconds from the import to the opened module in a new process: by the clock, and of processors. */
function opened() {
  const text = `const begin = performance.now(), used = process.cpuUsage(); const { load } = await import(${JSON.stringify(pathToFileURL(resolve(folder, 'node.mjs')).href)});
const z = await load(), { user, system } = process.cpuUsage(used); console.log(performance.now() - begin, (user + system) / 1000);`;
  return spawnSync('node', ['--input-type=module', '-e', text], { encoding: 'utf8' }).stdout.split(' ').map(Number);
}

/* The library by ctypes, one thread: draws a kept scene for each line, and prints the processor time. */
const PYTHON = `import sys, time
sys.path.insert(0, "clients/python")
import zraster
renderer = zraster.Renderer(threads=1)
scene = zraster.Scene(open(sys.argv[1], "rb").read(), renderer=renderer)
for line in sys.stdin:
    look, azimuth = line.split()
    begin = time.process_time()
    scene.render(look=look, azimuth=float(azimuth), size=(640, 480))
    print(1000 * (time.process_time() - begin), flush=True)
`;

async function besideLibrary() {
  const environment = { ...process.env, ZRASTER_LIBRARY: resolve(build, 'libzraster.so.0'), PYTHONDONTWRITEBYTECODE: '1' };
  const python = spawn(process.env.PYTHON || 'python3', ['-c', PYTHON, mesh], { stdio: ['pipe', 'pipe', 'inherit'], env: environment });
  const lines = createInterface({ input: python.stdout })[Symbol.asyncIterator](), z = await load(), scene = z.read(readFileSync(mesh));
  const library = async (look, azimuth) => {
    python.stdin.write(`${look} ${azimuth}\n`);
    return Number((await lines.next()).value);
  };
  const ours = (look, azimuth) => {
    const begin = process.cpuUsage();
    scene.draw({}, { look, azimuth, size: SIZE }).free();
    const { user, system } = process.cpuUsage(begin);
    return (user + system) / 1000;
  };
  for (const look of ['textbook', 'studio']) {
    for (let i = 0; i < 10; i++) ours(look, i), await library(look, i);
    const times = [];
    for (let i = 0; i < rounds; i++) times.push([ours(look, 7 * i), await library(look, 7 * i)]);
    const [a, b] = [0, 1].map(k => median(times.map(pair => pair[k])));
    print(`${look}, redraw in Node beside the library, one thread, processor`, ms(a), ms(b), `${(a / b).toFixed(2)} x`, 'at most 3.5', a / b <= 3.5);
  }
  python.stdin.end();
}

async function besideThree() {
  const three = join(build, 'loaders/node_modules/three/build'), page = `<!doctype html><script>${SAY}</script>
<script type="importmap">{"imports": {"three": "/three/three.module.js"}}</script>
<script>onunhandledrejection = event => say('end', String(event.reason.stack)); onerror = message => say('end', message);
history.replaceState(null, '', location.search + '&rounds=${rounds}');</script><script type="module" src="/three_page.mjs"></script>`;
  const got = await visit(path => {
    if (path === '/mesh') return mesh;
    if (path.startsWith('/package/')) return join(folder, path.slice(9));
    if (path.startsWith('/three/')) return join(three, path.slice(7));
    return path === '/' ? page : join('tests/bench/rivals', path);
  }, { flags: ['--use-angle=swiftshader', '--enable-unsafe-swiftshader'], seconds: 600 });
  if (String(got.get('end'))) throw new Error(String(got.get('end')));
  for (const name of ['three', 'ours']) {
    const rgba = got.get(`${name}.rgba`), rows = Array.from({ length: SIZE[1] }, (_, y) => rgba.subarray(4 * SIZE[0] * y, 4 * SIZE[0] * (y + 1)));
    const rgb = (name === 'three' ? rows.reverse() : rows).flatMap(row => [...row].filter((_, i) => i % 4 < 3));
    writeFileSync(join(build, 'bench', `redraw-${name}.ppm`), Buffer.concat([Buffer.from(`P6 ${SIZE.join(' ')} 255\n`), Buffer.from(rgb)]));
  }
  const times = JSON.parse(got.get('times')), [theirs, ours] = [0, 1].map(k => median(times.map(pair => pair[k])));
  print('textbook, redraw in Chromium beside three with readPixels', ms(ours), ms(theirs), `${(theirs / ours).toFixed(2)} x`, 'at least 10', theirs / ours >= 10);
  console.log(`# ${got.get('name')}`);
}

mkdirSync(join(build, 'bench'), { recursive: true });
const openings = Array.from({ length: rounds }, opened), [cold, used] = [0, 1].map(k => median(openings.map(times => times[k])));
console.log(`${`bunny, ${SIZE.join(' x ')}, medians of ${rounds} rounds in turns`.padEnd(62)}${'module'.padStart(12)}${'other'.padStart(14)}${'ratio'.padStart(9)}`);
print('import and load() in a new process of Node, clock', ms(cold), '', '', 'at most 100 ms', cold <= 100);
console.log(`# ${ms(used)} of processors; least by the clock: ${ms(Math.min(...openings.map(([time]) => time)))}`);
await besideLibrary();
await besideThree();
