// figures.js - prints the size of the page, the time to its first picture, and frames a second while the bunny turns.
'use strict';
const fs = require('fs');
const os = require('os');
const path = require('path');
const { check, open, drawn, redrawn, orbit } = require('./browser.js');

const FIRST_MS = 1000, WIDTH = 640, HEIGHT = 480, SECONDS = 4;
const bunny = path.join(process.env.DATA || '../shared/data', 'models/stanford-bunny.obj');
const loadText = () => `load average ${os.loadavg()[0].toFixed(1)} on ${os.cpus().length} cores`;

async function first(browser, address) {
  let best = Infinity;
  for (let i = 0; i < 5; i++) {
    const page = await open(browser, address);
    await page.waitForFunction(() => document.documentElement.dataset.drawn, null, { polling: 'raf' });
    best = Math.min(best, await page.evaluate(() => performance.now()));
    await page.close();
  }
  console.log(`# first picture after ${Math.round(best)} ms, ${loadText()}`);
  if (os.loadavg()[0] > 2 * os.cpus().length) console.log('# its bound is left out: the machine is busy');
  else check('the first picture is there within a second', best <= FIRST_MS, `${best} ms`);
}

async function frames(browser, address) {
  const page = await open(browser, address);
  await drawn(page);
  await redrawn(page, () => page.setInputFiles('#file', bunny));
  for (const look of ['textbook', 'studio']) {
    await redrawn(page, () => page.evaluate((keys) => setKeys(keys), { look, window: { width: WIDTH, height: HEIGHT } }));
    await page.waitForFunction(() => !isPumping);
    await orbit(page, 1000); // until the roughness has adapted
    const count = await orbit(page, 1000 * SECONDS), step = await page.evaluate(() => STEPS[motion.step]);
    const width = Math.round(WIDTH * step.scale), height = Math.round(HEIGHT * step.scale);
    console.log(`# the bunny turns, ${look}: ${(count / SECONDS).toFixed(1)} frames a second of ${width} x ${height}, ` +
      `${step.samples} samples${step.plain ? ', without occlusion' : ''}, ${loadText()}`);
  }
  await page.close();
}

module.exports = async function (browser, address) {
  const page = await fetch(address, { headers: { 'Accept-Encoding': 'gzip' } });
  console.log(`# the page has ${page.headers.get('Content-Length')} bytes, compressed`);
  await first(browser, address);
  if (fs.existsSync(bunny)) await frames(browser, address);
  else console.log(`# frames a second are left out: there is no ${bunny}`);
};
