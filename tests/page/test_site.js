// test_site.js BUILD [TEST...]: the page of BUILD/site, which draws by itself, from a server of files. Prints TAP; pictures land in
// BUILD/page-test/shots/BROWSER.
'use strict';
const fs = require('fs');
const path = require('path');
const { build, work, check, folder, open, drawn, redrawn, quiet, eachExample, firstMinute, widthsBetween, modelControls, gallery, violations, run, shot, main } = require('./browser.js');

const site = path.join(build, 'site');
// The file of that name in the folder DATA, if it is there.
function given(name) {
  const file = path.join(process.env.DATA || '', name);
  if (process.env.DATA && fs.existsSync(file)) return [file];
  console.error(`LEFT OUT: ${name}: DATA=DIR has none`);
  return [];
}
const BUNNY = 'models/stanford-bunny.obj';
// A triangle with its points in another file.
const GLTF = JSON.stringify({
  asset: { version: '2.0' }, buffers: [{ uri: 'x.bin', byteLength: 36 }], bufferViews: [{ buffer: 0, byteLength: 36 }],
  accessors: [{ bufferView: 0, componentType: 5126, count: 3, type: 'VEC3', min: [0, 0, 0], max: [1, 1, 0] }],
  meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }], nodes: [{ mesh: 0 }], scenes: [{ nodes: [0] }],
});
let address = '';

// Where the picture on the page differs from that of a file, in pixels; of other sizes: -1.
const difference = (page, bytes) => page.evaluate(async (base64) => {
  const bitmap = await createImageBitmap(new Blob([Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0))])), canvas = byId('picture');
  if (bitmap.width !== canvas.width || bitmap.height !== canvas.height) return -1;
  const [a, b] = [canvas, bitmap].map((image) => {
    const context = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d');
    context.drawImage(image, 0, 0);
    return new Uint32Array(context.getImageData(0, 0, canvas.width, canvas.height).data.buffer);
  });
  return a.reduce((sum, value, i) => sum + (value !== b[i]), 0);
}, bytes.toString('base64'));

// Each example, or a text, drawn by the page and by the command that the page copies.
async function compareWithCommand(page, name) {
  await page.click('#copy');
  await page.click('#copy-command');
  const text = await page.textContent('#copied');
  await page.click('#copy-dialog .close');
  const { bytes, error } = run(name, text);
  check(`${name}: the pixels of the copied command`, bytes.length > 0 && await difference(page, bytes) === 0, error);
}

// The same of files that are no examples.
async function compareWithCommandIn(page, name, list) {
  fs.mkdirSync(path.join(work, name), { recursive: true });
  for (const file of list) fs.copyFileSync(file, path.join(work, name, path.basename(file)));
  await compareWithCommand(page, name);
}

// Drops files or folders of the disk on the picture. False in browsers without the protocol of chromium.
async function dropped(page, list) {
  const session = await page.context().newCDPSession(page).catch(() => null);
  for (const type of session ? ['dragEnter', 'dragOver', 'drop'] : [])
    await session.send('Input.dispatchDragEvent', { type, x: 300, y: 300, data: { items: [], files: list, dragOperationsMask: 1 } });
  return Boolean(session);
}

const tests = {
  async start(browser) {
    const page = await open(browser, address, { viewport: { width: 1440, height: 900 } });
    await drawn(page);
    await page.waitForFunction(() => drawnLooks !== '', null, { timeout: 60000 });
    check('opened: no message, no report of the policy, no request to elsewhere', page.faults.length === 0, page.faults);
    await quiet(page);
    await firstMinute(page);
    await shot(page, 'site-1440-light');
    check('axe finds nothing', (await violations(page)).length === 0, await violations(page));
    await widthsBetween(page);
    for (const [name, options] of [['site-1440-dark', { viewport: { width: 1440, height: 900 }, colorScheme: 'dark' }], ['site-390', { viewport: { width: 390, height: 844 } }]]) {
      const other = await open(browser, address, options);
      await drawn(other);
      await quiet(other);
      await shot(other, name);
    }
  },

  // Before the module is there.
  async first(browser) {
    const page = await open(browser, address, { hash: '/docs/index.html' }), pictures = [];
    await page.route('**/*.wasm', () => {});
    page.on('response', (response) => { if (/looks\/.*webp$/.test(response.url())) pictures.push(path.basename(response.url())); });
    await page.goto(address);
    await page.waitForFunction(() => [...byId('looks').querySelectorAll('canvas')].filter((canvas) => canvas.getContext('2d').getImageData(80, 60, 1, 1).data[3]).length === 9);
    check('the first picture is there before the module', await page.evaluate(() => document.querySelector('#poster img').naturalWidth) === 720 && await page.isVisible('#poster img'));
    check('each look has a picture before the module', pictures.length === 10 && pictures.includes('first.webp'), pictures);
    const dark = await open(browser, address, { colorScheme: 'dark', hash: '/docs/index.html' }), darkPictures = [];
    dark.on('request', (request) => { if (/first/.test(request.url())) darkPictures.push(path.basename(request.url())); });
    await dark.goto(address);
    check('a dark page begins with the dark look', String(darkPictures) === 'first-dark.webp', darkPictures);
    await drawn(dark);
    check('the page draws over it', await dark.evaluate(() => !byId('poster')));
    const link = await open(browser, address, { hash: '/#' + encodeURIComponent('{"look": "clay"}') });
    check('a link has no picture of another scene', await link.evaluate(() => !byId('poster')));
    await page.unrouteAll();
  },

  async model(browser) {
    await modelControls(await open(browser, address));
  },

  async examples(browser) {
    const page = await open(browser, address);
    await drawn(page);
    await eachExample(page, async (name) => {
      if (!await page.evaluate(() => isMovie())) await compareWithCommand(page, name);
    });
  },

  async tabs(browser) {
    const page = await open(browser, address);
    await drawn(page);
    await page.click('#tab-channels');
    await page.waitForFunction(() => byId('channel-cards').querySelectorAll('canvas').length === 4 && !document.querySelector('#channel-cards canvas.failed'));
    await page.click('#tab-algorithms');
    await page.waitForFunction(() => /\d/.test(byId('algorithm-rows').textContent), null, { timeout: 60000 });
    await page.mouse.click(400, 300);
    await page.waitForFunction(() => /Pixel/.test(byId('pixel-text').textContent));
    await page.click('#tab-lesson');
    await redrawn(page, () => page.click('#lesson-scenes button'));
    await page.waitForFunction(() => !byId('lesson-body').hidden, null, { timeout: 20000 });
    check('channels, algorithms, a pixel and the lesson are there', true);
    await page.click('#tab-scene');
    check('the tab JSON has the scene', await page.isVisible('#text'));
    await page.fill('#text', '{"look": "studio", ');
    await page.waitForFunction(() => !byId('faults').hidden);
    check('broken JSON is refused with its place', /column|line|byte|expected|end/i.test(await page.textContent('#faults')), await page.textContent('#faults'));
    await page.fill('#text', '{"look": "studi", "meshes": []}');
    await page.waitForFunction(() => /look/.test(byId('faults').textContent));
    check('a wrong value is refused with its place', /studio/.test(await page.textContent('#faults')), await page.textContent('#faults'));
    check('tabs: nothing in the console', page.faults.length === 0, page.faults);
  },

  async drop(browser) {
    const models = [path.join(site, 'v1/examples/pawn.obj'), ...[BUNNY, 'models/spot.obj', 'hunt2/files/16-khr-meshopt.glb'].flatMap(given)];
    const page = await open(browser, address);
    await drawn(page);
    for (const file of models) {
      await redrawn(page, () => page.setInputFiles('#file', file));
      await quiet(page);
      await compareWithCommandIn(page, path.basename(file), [file]);
    }
    check('dropped: nothing in the console', page.faults.length === 0, page.faults);
  },

  // Texts that are not valid JSON, from files.
  async broken(browser) {
    const page = await open(browser, address), suite = path.join(process.env.DATA || '', 'json-test-suite/test_parsing');
    await drawn(page);
    await quiet(page);
    const files = [['', 'line 1, column 2'], ['{', 'line 1, column 2'], ['{bad', 'line 1, column 2'], ['not json', 'line 1, column 1'], ['{"look": "clay",\n}', 'line 2, column 1'], ['[]', 'a list']]
      .map(([text, expected], i) => ({ name: `broken${i}.json`, buffer: Buffer.from(text), expected }));
    const isRefused = (text) => { try { JSON.parse(text); } catch { return true; } return false; };
    for (const name of given('json-test-suite/test_parsing').length ? fs.readdirSync(suite) : []) {
      const buffer = fs.readFileSync(path.join(suite, name));
      if (isRefused(new TextDecoder().decode(buffer))) files.push({ name, buffer, expected: ' ' });
    }
    const silent = [];
    for (const { name, buffer, expected } of files) {
      await page.evaluate(() => showErrors(null));
      await page.setInputFiles('#file', { name, mimeType: 'application/json', buffer });
      const isSaid = (expected) => [byId('note'), byId('faults')].every((node) => !node.hidden && node.textContent.includes(expected));
      await page.waitForFunction(isSaid, expected, { timeout: 5000 }).catch(async () => silent.push([name, await page.textContent('#note')]));
    }
    check(`${files.length} broken files are refused, with the place`, silent.length === 0, silent);
    await redrawn(page, () => page.setInputFiles('#file', { name: 'whole.json', mimeType: 'application/json', buffer: Buffer.from('{"look": "clay", "polygons": [{"vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0]]}]}') }));
    check('a whole one is drawn after them', await page.isHidden('#note') && await page.isHidden('#faults'), await page.textContent('#note'));
    await page.goto(address + '/#' + encodeURIComponent('{"look": "clay",'));
    await page.reload();
    await page.waitForFunction(() => /line 1, column 17/.test(byId('note').textContent), null, { timeout: 20000 });
    check('broken: nothing in the console', page.faults.length === 0, page.faults);
  },

  // Several files at once, some of them missing, and files that the page does not open.
  async several(browser) {
    const page = await open(browser, address), example = (name) => path.join(site, 'v1/examples', name);
    const made = (name, text) => {
      fs.writeFileSync(path.join(work, name), text);
      return path.join(work, name);
    };
    const note = async () => await page.isVisible('#note') ? page.textContent('#note') : '';
    const assets = async () => String(JSON.parse(await page.inputValue('#text')).meshes.map(({ asset }) => asset));
    const stl = made('a.stl', 'solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n');
    const scene = made('scene.json', '{"meshes": [{"asset": "nut.obj"}, {"asset": "bolt.obj"}]}'), zip = made('b.zip', 'PK');
    await drawn(page);
    await redrawn(page, () => page.setInputFiles('#file', [example('pawn.obj'), example('ball.obj')]));
    await quiet(page);
    check('two models are one scene', await assets() === 'pawn.obj,ball.obj' && await note() === '', [await assets(), await note()]);
    await compareWithCommandIn(page, 'two', [example('pawn.obj'), example('ball.obj')]);
    await redrawn(page, () => page.setInputFiles('#file', [stl, example('wheel.obj'), zip]));
    await quiet(page);
    check('of models with other axes, and of an archive, a note tells', await assets() === 'a.stl' && /^Opened: a\.stl\. Left out: wheel\.obj, b\.zip\.$/.test(await note()), await note());
    await redrawn(page, () => page.setInputFiles('#file', [scene, example('nut.obj'), example('bolt.obj')]));
    check('a scene with its files has no note', await note() === '', await note());
    await redrawn(page, () => page.setInputFiles('#file', [scene, example('nut.obj'), example('bolt.obj'), stl]));
    check('of a model that the scene does not name, a note tells', /^Opened: scene\.json, nut\.obj, bolt\.obj\. Left out: a\.stl\.$/.test(await note()), await note());
    await redrawn(page, () => page.check('input[value=clay]'));
    check('it ends with the next change', await note() === '', await note());

    // The site has files of the examples, so other names are needed.
    const parts = made('parts.json', '{"look": "clay", "meshes": [{"asset": "one.obj"}, {"asset": "two.obj"}]}');
    const [one, two] = ['one.obj', 'two.obj'].map((name) => made(name, fs.readFileSync(example('ball.obj'))));
    const asks = async (list, missing) => {
      await page.setInputFiles('#file', list);
      const isSaid = await page.waitForFunction((name) => byId('note').textContent.includes(`'${name}' is missing: drop that file, too`), missing, { timeout: 5000 }).catch(() => false);
      check(`${list.map((file) => path.basename(file))}: the note asks for ${missing}`, Boolean(isSaid), await note());
    };
    await asks([parts], 'one.obj');
    await asks([one], 'two.obj');
    await redrawn(page, () => page.setInputFiles('#file', two));
    check('a file that the text asks for is added to it', await page.inputValue('#text') === fs.readFileSync(parts, 'utf8') && await note() === '', await note());

    for (const [name, text, other] of [['buffered.gltf', GLTF, 'x.bin'], ['red.obj', 'mtllib my red.mtl\n' + fs.readFileSync(example('ball.obj')), 'my red.mtl']]) {
      const model = made(name, text), isModel = name.endsWith('.gltf');
      if (isModel) await page.setInputFiles('#file', model);
      else await redrawn(page, () => page.setInputFiles('#file', model));
      await page.waitForFunction((other) => byId('faults').textContent.includes(other), other, { timeout: 5000 });
      await redrawn(page, () => page.setInputFiles('#file', made(other, isModel ? Buffer.from(new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0]).buffer) : 'newmtl red\nKd 0.9 0.1 0.1\n')));
      check(`${other} is added to ${name}`, await assets() === name && await note() === '' && await page.isHidden('#faults'), [await assets(), await note(), await page.textContent('#faults')]);
    }

    await page.setInputFiles('#file', zip);
    check('an archive is for others', /\.obj,/.test(await note()) && !/\.zip,/.test(await note()) && /Archives \(\.zip\) are for the command and the daemon/.test(await note()), await note());
    if (await dropped(page, [path.join(site, 'v1')])) check('of a folder, its files are asked for', /Of a folder, open the files in it/.test(await note()), await note());
    check('several: nothing in the console but missing files', page.faults.every((fault) => /404/.test(fault)), page.faults);
  },

  async faults(browser) {
    const page = await open(browser, address);
    await drawn(page);
    await page.evaluate(() => {
      const { picture } = engine.whole;
      engine.whole.picture = () => {
        engine.whole.picture = picture;
        throw Object.assign(new Error('the module ended'), { status: 'internal' });
      };
      setKeys({ samples: 1 });
    });
    await page.waitForFunction(() => /the module ended/.test(byId('note').textContent));
    await redrawn(page, () => page.evaluate(() => setKeys({ samples: 16 })));
    check('after a fault of the module the next picture is drawn', await page.isHidden('#note'), await page.textContent('#note'));
    const controllers = await page.evaluate(async () => {
      const all = Array.from({ length: 6 }, () => new AbortController());
      const results = Promise.allSettled(all.map(({ signal }, i) => render(state.text, { window: { width: 60 + i, height: 40 } }, '', signal)));
      all.slice(0, 5).forEach((controller) => controller.abort());
      return (await results).map(({ status }) => status);
    });
    check('requests that end leave the others', controllers[5] === 'fulfilled' && controllers.slice(0, 5).every((status) => status === 'rejected'), controllers);
  },

  async speed(browser) {
    const [file] = given(BUNNY);
    if (!file) return;
    const page = await open(browser, address);
    await drawn(page);
    await redrawn(page, () => page.setInputFiles('#file', file));
    await redrawn(page, () => page.evaluate(() => setKeys({ look: 'textbook', window: { width: 640, height: 480 } })));
    // Moves come from the page itself: the test's own would wait for one another.
    const turn = (ms) => page.evaluate((ms) => new Promise((done) => {
      const before = motion.frames, timer = setInterval(() => move((camera) => { camera.azimuth += 0.5; }), 4);
      setTimeout(() => { clearInterval(timer); done(motion.frames - before); }, ms);
    }), ms);
    await turn(1500);
    const frames = await turn(3000), step = await page.evaluate(() => motion.step);
    await page.evaluate(() => { adapt = () => {}; motion.step = 1; });
    console.log(`# orbit of the bunny at 640 x 480 in textbook: ${(frames / 3).toFixed(1)} pictures a second in step ${step}, ${((await turn(3000)) / 3).toFixed(1)} at full size`);
    check('the picture moves', frames > 10, frames);
  },

  async offline(browser) {
    const page = await open(browser, address);
    await drawn(page);
    await page.evaluate(() => navigator.serviceWorker.ready);
    await page.waitForFunction(async () => (await caches.keys()).length === 1);
    await page.context().setOffline(true);
    await page.reload();
    await drawn(page);
    await redrawn(page, () => page.check('input[value=clay]'));
    await redrawn(page, () => page.selectOption('#example', 'pawns'));
    check('without a network: opened, drawn, another look, another example', await page.isHidden('#note'), await page.textContent('#note'));
    await page.context().setOffline(false);

    // A copy of another version on the same origin.
    const root = path.join(work, 'copies');
    for (const name of ['a', 'a/b']) fs.cpSync(site, path.join(root, name), { recursive: true, filter: (file) => !file.startsWith(path.join(site, 'docs')) });
    const script = path.join(root, 'a/b/offline.js');
    fs.writeFileSync(script, fs.readFileSync(script, 'utf8').replace(/VERSION = '\w+'/, "VERSION = 'other'"));
    const origin = await folder(root), copy = await open(browser, origin, { hash: '/a/' });
    const has = (names) => copy.waitForFunction(async (names) => String((await caches.keys()).sort()) === names, String(names.map((name) => `zraster ${origin}${name}`)), { timeout: 20000 }).then(() => true, () => copy.evaluate(() => caches.keys()));
    const [, version] = /VERSION = '(\w+)'/.exec(fs.readFileSync(path.join(site, 'offline.js'), 'utf8'));
    await copy.evaluate(() => navigator.serviceWorker.ready);
    await copy.goto(origin + '/a/b/');
    await copy.evaluate(() => navigator.serviceWorker.ready);
    let found = await has(['/a/ ' + version, '/a/b/ other']);
    check('copies on one origin keep their caches', found === true, found);
    fs.writeFileSync(script, fs.readFileSync(script, 'utf8').replace('other', 'newer'));
    await copy.reload();
    found = await has(['/a/ ' + version, '/a/b/ newer']);
    check('a new version of one deletes the cache of its old one alone', found === true, found);
  },

  gallery: (browser) => gallery(browser, address, '/docs/gallery.html'),

  async manual(browser) {
    const page = await open(browser, address);
    const dead = [], scenes = [], seen = new Set(), links = [address + '/docs/index.html'];
    while (links.length) {
      const link = links.pop().replace(/#.*/, '');
      if (seen.has(link) || !link.startsWith(address)) continue;
      seen.add(link);
      const response = await page.request.get(link);
      if (!response.ok()) dead.push(link);
      if (!/text\/html/.test(response.headers()['content-type'] || '')) continue;
      for (const [, href] of (await response.text()).matchAll(/(?:href|src|srcset)="([^"]*)"/g))
        if (href.includes('#%7B')) scenes.push(new URL(href, link).href);
        else if (!/^(data|mailto):|&hellip;|…/.test(href)) links.push(new URL(href.replace(/&amp;/g, '&'), link).href);
    }
    const refused = [];
    for (const scene of scenes) {
      const other = await open(browser, address, { hash: scene.slice(address.length) });
      await drawn(other).catch(() => {});
      await quiet(other);
      if (await other.isVisible('#note') || await other.isVisible('#faults')) refused.push(`${decodeURIComponent(scene).slice(0, 200)}: ${await other.textContent('#note')}`);
      await other.close();
    }
    check(`the page draws all ${scenes.length} scenes of the manual`, scenes.length > 10 && refused.length === 0, refused);
    check(`the manual has no dead link among ${seen.size}`, dead.length === 0 && seen.size > 80, dead);
  },
};

(async () => {
  address = await folder(site);
  main(tests);
})();
