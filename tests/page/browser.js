// browser.js - a headless chromium, daemons of one build, and checks that print TAP.
'use strict';
const { spawn, spawnSync } = require('child_process');
const fs = require('fs');
const os = require('os');
const path = require('path');

const build = path.resolve(process.argv[2] || 'build');
const modules = path.join(build, 'page-test/node_modules');
const { chromium } = require(path.join(modules, 'playwright-core'));
const axe = fs.readFileSync(path.join(modules, 'axe-core/axe.min.js'), 'utf8');
const work = fs.mkdtempSync(path.join(os.tmpdir(), 'zraster-page-'));
const shots = path.join(build, 'page-test/shots');

let count = 0, failed = 0;

function check(name, isRight, found = '') {
  count++;
  if (!isRight) failed++;
  console.log(`${isRight ? 'ok' : 'not ok'} ${count} - ${name}`);
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

// Opens a page. `page.faults` are messages of the console, reports of the policy, and requests to elsewhere.
async function open(browser, address, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, colorScheme: 'light', ...options });
  const page = await context.newPage();
  page.faults = [];
  page.on('console', (message) => page.faults.push(`console: ${message.text()}`));
  page.on('pageerror', (error) => page.faults.push(`error: ${error.message}`));
  page.on('request', (request) => {
    const url = request.url();
    if (!url.startsWith(address) && !/^(data|blob):/.test(url)) page.faults.push(`request: ${url}`);
  });
  await page.addInitScript(() => addEventListener('securitypolicyviolation', (event) => console.error('policy: ' + event.violatedDirective)));
  await page.goto(address + (options.hash || '/'));
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

async function violations(page) {
  if (!(await page.evaluate(() => Boolean(window.axe)))) await page.evaluate(axe + ';0').catch(() => page.addScriptTag({ content: axe }));
  const { violations: found } = await page.evaluate(() => window.axe.run(document, { resultTypes: ['violations'] }));
  return found.map((fault) => `${fault.id}: ${fault.nodes.map((node) => node.target.join(' ')).join(', ')}`);
}

// Saves the picture of the page and returns its bytes.
async function saved(page) {
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

async function shot(page, name) {
  fs.mkdirSync(shots, { recursive: true });
  await page.screenshot({ path: path.join(shots, name + '.png') });
}

async function main(tests) {
  const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM || '/usr/bin/chromium', args: process.getuid() === 0 ? ['--no-sandbox'] : [],
  });
  const only = process.argv.slice(3);
  try {
    for (const [name, test] of Object.entries(tests)) {
      if (only.length && !only.includes(name)) continue;
      try {
        await test(browser);
      } catch (error) {
        check(`${name} runs to its end`, false, error.stack);
      }
      for (const context of browser.contexts()) await context.close();
    }
  } finally {
    await browser.close();
    for (const child of daemons) child.kill();
    fs.rmSync(work, { recursive: true, force: true });
  }
  console.log(`1..${count}`);
  process.exit(failed || !count ? 1 : 0);
}

module.exports = { build, work, check, daemon, open, drawn, redrawn, pictures, violations, saved, run, shot, main };
