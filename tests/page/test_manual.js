// test_manual.js BUILD: the pages of the manual in a browser, light and dark, wide and narrow. Prints TAP.
'use strict';
const { check, daemon, open, violations, gallery, shot, main } = require('./browser.js');

const SIZES = [
  { name: 'wide-light', colorScheme: 'light', viewport: { width: 1440, height: 1000 } },
  { name: 'narrow-dark', colorScheme: 'dark', viewport: { width: 360, height: 800 } },
];

main({
  gallery: async (browser) => gallery(browser, await daemon(), '/docs/gallery'),

  async manual(browser) {
    const address = await daemon();
    for (const { name, ...options } of SIZES) {
      const page = await open(browser, address, { ...options, hash: '/docs/' });
      await shot(page, `manual-${name}`);
      const links = await page.$$eval('nav a[href]', (list) => list.map((link) => link.href).filter((link) => link.includes('/docs/')));
      check(`${name}: the manual has at least 30 pages`, links.length >= 30, links);
      const faults = [];
      for (const link of links) {
        await page.goto(link);
        const width = await page.evaluate(() => document.documentElement.scrollWidth);
        if (width > options.viewport.width) faults.push(`${link}: ${width} pixels wide`);
        for (const fault of await violations(page)) faults.push(`${link}: ${fault}`);
        const pictures = await page.$$eval('img', (list) => Promise.all(list.map((image) => {
          image.loading = 'eager';
          return image.decode().then(() => '', () => image.src);
        })));
        faults.push(...pictures.filter(Boolean));
      }
      check(`${name}: pages fit the window, pictures are shown, axe finds nothing`, faults.length === 0, faults);
      check(`${name}: no message, no report of the policy, no request to elsewhere`, page.faults.length === 0, page.faults);
    }
  },
});
