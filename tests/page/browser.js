// browser.js - a headless chromium and firefox, daemons of one build, and checks that print TAP.
'use strict';
const { spawn, spawnSync } = require('child_process');
const fs = require('fs');
const os = require('os');
const path = require('path');

const build = path.resolve(process.argv[2] || 'build');
const modules = path.join(build, 'page-test/node_modules');
const { chromium, firefox } = require(path.join(modules, 'playwright-core'));
const axe = fs.readFileSync(path.join(modules, 'axe-core/axe.min.js'), 'utf8');
const work = fs.mkdtempSync(path.join(os.tmpdir(), 'zraster-page-'));
const shots = path.join(build, 'page-test/shots');

// Firefox is driven by WebDriver BiDi, which cannot touch, take the network away or set the colours of the system.
const BROWSERS = {
  chromium: {
    kind: chromium, path: process.env.CHROMIUM || '/usr/bin/chromium', options: { args: process.getuid() === 0 ? ['--no-sandbox'] : [] }, leaves: [],
  },
  firefox: { kind: firefox, path: process.env.FIREFOX || '/usr/bin/firefox-esr', options: { channel: 'moz-firefox' }, leaves: ['touch', 'offline', 'first'] },
};

let count = 0, failed = 0, named = '';

function check(name, isRight, found = '') {
  count++;
  if (!isRight) failed++;
  console.log(`${isRight ? 'ok' : 'not ok'} ${count} - ${named}: ${name}`);
  if (!isRight) console.error(`  ${name}: ${typeof found === 'string' ? found : JSON.stringify(found)}`);
}

const daemons = [];

// Starts a daemon and returns its address.
function daemon(...flags) {
  return new Promise((done) => {
    const child = spawn(path.join(build, 'zrasterd'), ['--port', '0', ...flags], { stdio: ['ignore', 'pipe', 'ignore'] });
    daemons.push(child);
    child.stdout.once('data', (text) => done(/http:\/\/\S+/.exec(String(text))[0]));
  });
}

const SHOT_STYLE = 'YjaKGiklmzC6wjXA513HAMmzus8VE61XCOT+SmwNZWA='; // the hash of "body {}"

// Serves the files of a folder by Python's server, which knows nothing of the page, and returns its address.
function folder(root) {
  return new Promise((done) => {
    const child = spawn(process.env.PYTHON || '/usr/bin/python3', ['-u', '-m', 'http.server', '--bind', '127.0.0.1', '--directory', root, '0'], { stdio: ['ignore', 'pipe', 'ignore'] });
    daemons.push(child);
    child.stdout.once('data', (text) => done(/http:\/\/[\d.:]+/.exec(String(text))[0]));
  });
}

// Opens a page. `page.faults` are messages of the console, reports of the policy, and requests to elsewhere.
async function open(browser, address, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, colorScheme: 'light', ...options });
  const page = await context.newPage();
  page.faults = [];
  page.on('console', (message) => page.faults.push(`console: ${message.text()}`));
  page.on('pageerror', (error) => { if (!error.message.includes(SHOT_STYLE)) page.faults.push(`error: ${error.message}`); });
  page.on('request', (request) => {
    const url = request.url();
    if (!url.startsWith(address) && !/^(data|blob):/.test(url)) page.faults.push(`request: ${url}`);
  });
  await page.addInitScript(() => addEventListener('securitypolicyviolation', (event) => { if (!window.isShot) console.error('policy: ' + event.violatedDirective); }));
  await page.goto(address + (options.hash || '/'));
  if (named === 'firefox' && options.colorScheme === 'dark' && await page.$('#theme')) await page.click('#theme');
  return page;
}

const drawn = (page, least = 1) => page.waitForFunction((n) => Number(document.documentElement.dataset.pictures || 0) >= n, least, { timeout: 20000 });
const pictures = (page) => page.evaluate(() => Number(document.documentElement.dataset.pictures || 0));

// Does something and waits for the next whole picture.
async function redrawn(page, act) {
  const before = await pictures(page);
  await act();
  await drawn(page, before + 1);
}

const quiet = (page) => page.waitForFunction(() => !isPumping && !motion.is && !pending);

// Opens each example in turn, which is drawn without a complaint, and does something with it.
async function eachExample(page, act) {
  const names = await page.$$eval('#example option', (options) => options.map((option) => option.value).filter(Boolean));
  check('the examples are listed', names.length >= 12, names);
  for (const name of names) {
    await redrawn(page, () => page.selectOption('#example', name));
    await quiet(page);
    check(`example ${name}: drawn without a complaint`, await page.isHidden('#note') && await page.isHidden('#faults'), await page.textContent('#note'));
    await act(name);
  }
  check('examples: nothing in the console', page.faults.length === 0, page.faults);
}

// Turns the picture by the pointer for some time. Returns the number of pictures that were drawn meanwhile.
async function orbit(page, ms) {
  const before = await page.evaluate(() => motion.frames), began = Date.now();
  await page.mouse.move(400, 300);
  await page.mouse.down();
  for (let i = 0; Date.now() - began < ms; i++) {
    await page.mouse.move(400 + 100 * Math.sin(i / 40), 300 + 40 * Math.cos(i / 30));
    await page.waitForTimeout(8);
  }
  const count = await page.evaluate(() => motion.frames) - before;
  await redrawn(page, () => page.mouse.up());
  return count;
}

async function violations(page) {
  if (!(await page.evaluate(() => Boolean(window.axe)))) await page.evaluate(axe + ';0').catch(() => page.addScriptTag({ content: axe }));
  const { violations: found } = await page.evaluate(() => window.axe.run(document, { resultTypes: ['violations'] }));
  return found.map((fault) => `${fault.id}: ${fault.nodes.map((node) => node.target.join(' ')).join(', ')}`);
}

// Saves the picture of the page and returns its bytes. BiDi reports no downloads, so in firefox the bytes are those of the link.
async function saved(page) {
  if (named === 'firefox') {
    return Buffer.from(await page.evaluate(async () => {
      const { createObjectURL } = URL, { click } = HTMLAnchorElement.prototype;
      let blob = new Blob();
      URL.createObjectURL = (given) => { blob = given; return ''; };
      HTMLAnchorElement.prototype.click = () => {};
      byId('save').click();
      URL.createObjectURL = createObjectURL;
      HTMLAnchorElement.prototype.click = click;
      return [...new Uint8Array(await blob.arrayBuffer())];
    }));
  }
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('#save')]);
  return fs.readFileSync(await download.path());
}

// Runs a text as a shell does, in a folder of its own, with the programs of the build. Returns picture.png.
function run(name, text, kind = 'sh') {
  const folder = path.join(work, name);
  fs.mkdirSync(folder, { recursive: true });
  const env = {
    ...process.env, PATH: `${build}:${process.env.PATH}`, PYTHONPATH: path.resolve('clients/python'),
    PYTHONDONTWRITEBYTECODE: '1', ZRASTER_LIBRARY: path.join(build, 'libzraster.so.0'),
  };
  const command = kind === 'sh' ? ['sh', ['-c', text]] : [process.env.PYTHON || '/usr/bin/python3', ['-c', text]];
  const result = spawnSync(command[0], command[1], { cwd: folder, env, encoding: 'utf8' });
  const file = path.join(folder, fs.existsSync(path.join(folder, 'picture.apng')) ? 'picture.apng' : 'picture.png');
  return { bytes: fs.existsSync(file) ? fs.readFileSync(file) : Buffer.alloc(0), error: result.stderr };
}

// What a visitor sees at first, at 1440 x 900: a picture, controls and one sentence; no JSON, and nothing that scrolls.
async function firstMinute(page) {
  const seen = await page.evaluate(() => ({
    text: document.body.innerText,
    parts: byId('parts').children.length,
    looks: [...byId('looks').querySelectorAll('canvas')].filter((canvas) => new Set(new Uint32Array(canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data.buffer)).size > 10).length,
    scrolls: [...document.querySelectorAll('*')].filter((node) => node.clientHeight && node.scrollHeight > node.clientHeight + 1 && node.offsetParent &&
      /auto|scroll/.test(getComputedStyle(node).overflowY)).map((node) => node.id || node.className || node.tagName),
    page: document.documentElement.scrollHeight - innerHeight,
  }));
  check('no JSON is shown until it is asked for', await page.isHidden('#text') && !/[{}"]/.test(seen.text), seen.text);
  check('one sentence tells of zraster, another one to drop a model', /draws.*\. Drop one/i.test(await page.textContent('#about')));
  check('the example has a picture, the list of its parts and a picture in each look', seen.parts === 18 && seen.looks === 9, seen);
  check('nothing scrolls at 1440 x 900', seen.page <= 1 && seen.scrolls.length === 0, [seen.page, seen.scrolls]);
}

// Between the sizes of screens: nothing is cut off, and nothing scrolls sideways.
async function widthsBetween(page) {
  for (const width of [320, 390, 699, 700, 899, 900, 1024, 1279, 1280]) {
    await page.setViewportSize({ width, height: 800 });
    await page.waitForFunction(() => document.documentElement.scrollWidth <= innerWidth, null, { timeout: 5000 }).catch(() => {});
    const found = await page.evaluate(() => {
      const about = byId('about'), header = document.querySelector('header');
      const out = [...header.children].filter((node) => node.offsetParent && (node.getBoundingClientRect().right > innerWidth || node.getBoundingClientRect().bottom > header.getBoundingClientRect().bottom));
      return { wide: document.documentElement.scrollWidth, cut: about.scrollWidth > about.clientWidth + 1, out: out.map((node) => node.id), select: byId('example').clientWidth, high: header.clientHeight };
    });
    check(`${width} px: the header fits, with its sentence`, found.wide <= width && !found.cut && !found.out.length && found.select >= 55 && found.high <= 110, found);
  }
}

// The controls of the tab Model change the text.
async function modelControls(page) {
  await drawn(page);
  const scene = async () => JSON.parse(await page.inputValue('#text'));
  await redrawn(page, () => page.selectOption('#example', 'bearing'));
  await quiet(page);
  await page.waitForFunction(() => byId('parts').children.length === 18);
  check('the facts of the model', /^18 parts, 36,765 triangles, 84 × 54.8 × 84/.test(await page.textContent('#model-facts')), await page.textContent('#model-facts'));
  await redrawn(page, () => page.click('#cut button[value=x]'));
  check('a cut is a plane', JSON.stringify((await scene()).sections) === '{"planes":[{"axis":"x","fraction":0.5}]}', (await scene()).sections);
  const steps = await page.evaluate(() => past.length);
  await redrawn(page, async () => {
    for (const value of [40, 30, 20]) await page.evaluate((value) => { byId('cut-at').value = value; byId('cut-at').dispatchEvent(new Event('input')); }, value);
  });
  check('a slider moves it, in one step of undo', (await scene()).sections.planes[0].fraction === 0.2 && await page.evaluate(() => past.length) === steps + 1, (await scene()).sections);
  check('the picture is whole again', await page.evaluate(() => byId('picture').width === pictureSize().width));
  await redrawn(page, () => page.click('#cut button[value=""]'));
  await redrawn(page, () => page.evaluate(() => { byId('apart').value = 100; byId('apart').dispatchEvent(new Event('input')); }));
  await redrawn(page, () => page.click('#parts input[value=gear]'));
  check('without a cut, taken apart, one part hidden', (await scene()).sections === undefined && (await scene()).explode === 1 && String((await scene()).hide) === 'gear', await scene());
  await redrawn(page, () => page.click('#parts input[value=gear]'));
  check('shown again', (await scene()).hide === undefined && await page.isChecked('#parts input[value=gear]'));
  check('controls: nothing in the console', page.faults.length === 0, page.faults);
}

// The gallery of the manual: columns of 480 pixels, one column in narrow windows, and other pictures on dark pages.
async function gallery(browser, address, hash) {
  for (const [width, colorScheme, columns] of [[1440, 'light', 2], [1920, 'light', 3], [390, 'dark', 1]]) {
    const page = await open(browser, address, { viewport: { width, height: 900 }, colorScheme, hash });
    const room = await page.evaluate(() => document.documentElement.clientWidth) - 32;
    const cards = await page.$$eval('.card', (list) => Promise.all(list.map(async (card) => {
      const image = card.querySelector('img'), { left, right } = card.getBoundingClientRect();
      image.loading = 'eager';
      await image.decode();
      return { left: Math.round(left), right, shown: image.currentSrc, width: image.width, asked: Number(image.getAttribute('width') || 0), isOne: Boolean(card.querySelector('source')) };
    })));
    const lefts = new Set(cards.map(({ left }) => left)), large = cards.filter(({ asked }) => asked === 480);
    check(`gallery, ${width} px: ${columns} columns`, lefts.size === columns && cards.every(({ right }) => right <= width), [...lefts]);
    check(`gallery, ${width} px: pictures of at most 480 pixels fill it`, large.length >= 12 && large.every((card) => card.width === Math.min(480, room)), large);
    if (named !== 'firefox') check(`gallery, ${colorScheme}: pictures of the mode`, cards.filter(({ isOne }) => isOne).length === 4 && cards.every(({ isOne, shown }) => /-dark\.webp/.test(shown) === (isOne && colorScheme === 'dark')), cards);
    check(`gallery, ${width} px: axe finds nothing`, (await violations(page)).length === 0, await violations(page));
    await shot(page, `gallery-${width}-${colorScheme}`);
    await page.close();
  }
}

// Pictures of the screen. In firefox, playwright adds a style for them, which the policy refuses and reports.
async function shot(page, name) {
  const folder = path.join(shots, named);
  fs.mkdirSync(folder, { recursive: true });
  await page.evaluate(() => { window.isShot = true; });
  await page.screenshot({ path: path.join(folder, name + '.png'), caret: 'initial' });
  await page.evaluate(() => { window.isShot = false; });
}

// BiDi makes two clicks of it.
async function doubleClick(page, x, y) {
  if (named === 'firefox') await page.dispatchEvent('#frame', 'dblclick');
  else await page.mouse.dblclick(x, y);
}

async function runIn(browser, tests, leaves) {
  for (const [name, test] of tests) {
    if (leaves.includes(name)) {
      console.log(`# ${named} leaves out: ${name}`);
      continue;
    }
    try {
      await test(browser);
    } catch (error) {
      check(`${name} runs to its end`, false, error.stack);
    }
    for (const context of browser.contexts()) await context.close();
  }
}

async function main(tests) {
  const only = process.argv.slice(3);
  const wanted = Object.entries(tests).filter(([name]) => !only.length || only.includes(name));
  try {
    for (const [name, { kind, path: program, options, leaves }] of Object.entries(BROWSERS)) {
      if (process.env.BROWSERS && !process.env.BROWSERS.split(' ').includes(name)) continue;
      named = name;
      if (name === 'firefox' && !fs.existsSync(program)) {
        console.log(`# firefox is left out: there is no ${program}`);
        continue;
      }
      const browser = await kind.launch({ executablePath: program, ...options });
      console.log(`# ${name} ${browser.version()}`);
      try {
        await runIn(browser, wanted, leaves);
      } finally {
        await browser.close();
      }
    }
  } finally {
    for (const child of daemons) child.kill();
    fs.rmSync(work, { recursive: true, force: true });
  }
  console.log(`1..${count}`);
  process.exit(failed || !count ? 1 : 0);
}

module.exports = { build, work, check, daemon, folder, open, drawn, redrawn, quiet, eachExample, firstMinute, widthsBetween, modelControls, gallery, pictures, orbit, violations, saved, doubleClick, run, shot, main };
