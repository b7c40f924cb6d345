// test_page.js BUILD [TEST...]: the page at / in a browser, as a person uses it. Prints TAP; pictures land in
// BUILD/page-test/shots/BROWSER.
'use strict';
const fs = require('fs');
const path = require('path');
const figures = require('./figures.js');
const lesson = require('./lesson.js');
const { build, work, check, daemon, open, drawn, redrawn, quiet, eachExample, firstMinute, widthsBetween, modelControls, pictures, orbit, violations, saved, doubleClick, run, shot, main } = require('./browser.js');

const assets = path.join(work, 'assets');
fs.mkdirSync(assets);
let address = '';
const textOf = (page) => page.inputValue('#text');
const sceneOf = async (page) => JSON.parse(await textOf(page));
const TABS = ['model', 'scene', 'channels', 'algorithms', 'pixel', 'lesson'];

const tests = {
  figures: (browser) => figures(browser, address),

  async start(browser) {
    for (let i = 0; i < 3; i++) {
      const page = await open(browser, address);
      await drawn(page);
      await page.waitForTimeout(300);
      check(`opened ${i + 1}: no message, no report of the policy, no request to elsewhere`, page.faults.length === 0, page.faults);
      if (i === 0) {
        await page.setViewportSize({ width: 1440, height: 900 });
        await page.waitForFunction(() => drawnLooks !== '' && byId('parts').children.length);
        await firstMinute(page);
        await shot(page, 'wide-light');
        await widthsBetween(page);
      }
      await page.close();
    }
  },

  // Before the first picture is drawn.
  async tiles(browser) {
    const page = await open(browser, address, { hash: '/docs/' });
    await page.route('**/v1/render*', () => {});
    await page.goto(address);
    await page.waitForFunction(() => [...byId('looks').querySelectorAll('canvas')].filter((canvas) => canvas.getContext('2d').getImageData(80, 60, 1, 1).data[3]).length === 9);
    const faults = page.faults.filter((fault) => !/getImageData/.test(fault)); // that of this test
    check('each look has a picture before the daemon draws', faults.length === 0, faults);
    await page.unrouteAll();
  },

  // A daemon with --engine-dir: the page draws while the model turns, and the daemon when it is still.
  async engine(browser) {
    const folder = [path.join(build, 'npm/zraster'), 'build/npm/zraster'].find((name) => fs.existsSync(name));
    if (!folder) {
      console.error('LEFT OUT: engine: there is no package; make npm builds it');
      return;
    }
    const page = await open(browser, await daemon('--assets-dir', assets, '--engine-dir', folder)), asked = [];
    page.on('request', (request) => { if (/v1\/render/.test(request.url())) asked.push(request.url()); });
    await drawn(page);
    await page.waitForFunction(() => engine.rough, null, { timeout: 30000 });
    await quiet(page);
    // Moves come from the page itself: on a busy machine those of the test would be still between two.
    const turn = (ms) => page.evaluate((ms) => new Promise((done) => {
      const frames = motion.frames, text = state.text, timer = setInterval(() => move((camera) => { camera.azimuth += 0.5; }), 4);
      setTimeout(() => { clearInterval(timer); done({ frames: motion.frames - frames, isStill: state.text !== text }); }, ms);
    }), ms);
    for (const name of ['bearing', 'pawns']) {
      await redrawn(page, () => page.selectOption('#example', name));
      await page.waitForFunction(() => drawnLooks === state.version + JSON.stringify(state.camera) && !isPumping, null, { timeout: 20000 });
      await page.waitForTimeout(300);
      let turned, before, requests;
      for (let tries = 0; tries === 0 || (turned.isStill && tries < 5); tries++) {
        before = await pictures(page);
        asked.length = 0;
        turned = await turn(1000);
        requests = [...asked];
        await drawn(page, before + 1);
        await page.waitForFunction(() => drawnLooks === state.version + JSON.stringify(state.camera) && !isPumping, null, { timeout: 20000 });
      }
      check(`${name}: it turns without a request`, turned.frames >= 2 && requests.length === 0, [turned, requests]);
      check(`${name}: still, the daemon draws it`, asked.length >= 1, asked);
      await quiet(page);
      const bytes = await saved(page);
      await page.click('#copy');
      await page.click('#copy-curl');
      const result = run('engine-' + name, await page.textContent('#copied'));
      await page.click('#copy-dialog .close');
      check(`${name}: the picture is the daemon's, byte for byte`, bytes.length > 100 && bytes.equals(result.bytes), `${bytes.length} and ${result.bytes.length} bytes; ${result.error}`);
    }
    await page.evaluate(() => { engine.rough.picture = () => { throw new Error('no'); }; });
    asked.length = 0;
    const { frames } = await turn(500), requests = asked.length;
    check('when the page cannot draw, the daemon does', frames > 0 && requests > 0 && await page.isHidden('#note'), [frames, requests]);
    check('engine: nothing in the console', page.faults.length === 0, page.faults);
  },

  async model(browser) {
    await modelControls(await open(browser, address));
  },

  async examples(browser) {
    const page = await open(browser, address);
    await drawn(page);
    await eachExample(page, async (name) => {
      check(`example ${name}: stays chosen`, await page.inputValue('#example') === name);
      await shot(page, 'example-' + name);
    });
  },

  async drag(browser) {
    const page = await open(browser, address);
    await drawn(page);
    for (const look of ['textbook', 'studio', 'technical', 'xray']) {
      await redrawn(page, () => page.check(`input[value=${look}]`));
      await orbit(page, 500);
      await quiet(page);
      const scene = await sceneOf(page), size = await page.evaluate(() => [byId('picture').width, pictureSize().width]);
      check(`${look}: the text follows the drag`, scene.view && scene.view.azimuthDegrees !== undefined && scene.look === look, scene.view);
      check(`${look}: the picture is whole at rest`, size[0] === size[1], size);
    }
    const before = (await sceneOf(page)).view;
    await page.mouse.move(400, 300);
    await redrawn(page, () => page.mouse.wheel(0, 200));
    check('the wheel moves away', JSON.stringify((await sceneOf(page)).view) !== JSON.stringify(before));
    const target = (await sceneOf(page)).view.target;
    await page.mouse.down({ button: 'right' });
    await redrawn(page, async () => { await page.mouse.move(460, 320, { steps: 4 }); await page.mouse.up({ button: 'right' }); });
    check('the right button moves the target', String((await sceneOf(page)).view.target) !== String(target));
    await redrawn(page, () => doubleClick(page, 400, 300));
    check('a double click shows everything', (await sceneOf(page)).view === undefined);
    check('moves: nothing in the console', page.faults.length === 0, page.faults);
  },

  async lookWhileMoving(browser) {
    const page = await open(browser, address);
    await drawn(page);
    await page.mouse.move(400, 300);
    await page.mouse.down();
    await page.mouse.move(440, 300, { steps: 10 });
    await page.waitForFunction(() => state.camera && motion.is);
    await redrawn(page, () => page.evaluate(() => setKeys({ look: 'clay' })));
    await page.mouse.up();
    await quiet(page);
    const scene = await sceneOf(page), width = await page.evaluate(() => [byId('picture').width, pictureSize().width]);
    check('a look chosen while it moves keeps the view, and the picture is whole', scene.look === 'clay' && Boolean(scene.view) && width[0] === width[1], [scene.view, width]);
  },

  async noJump(browser) {
    const page = await open(browser, address);
    await drawn(page);
    for (const name of ['pawns', 'triangle', 'hills', 'heights', 'lamp', 'cutaway']) {
      await redrawn(page, () => page.selectOption('#example', name));
      await quiet(page);
      const difference = await page.evaluate(async () => {
        const camera = cameraOf(await loadInfo()), { width, height } = pictureSize();
        const small = { width, height };
        const of = async (changes) => npy((await render(state.text, changes, '?channel=instanceId')).blob);
        const [before, after] = [await of({ window: small }), await of({ window: small, view: viewOf(camera) })];
        return before.reduce((sum, id, i) => sum + (id !== after[i]), 0) / before.length;
      });
      check(`${name}: the first move goes on from what is seen`, difference <= 0.002, `${difference} of the pixels differ`);
    }
  },

  async tabs(browser) {
    const page = await open(browser, address);
    await redrawn(page, () => page.selectOption('#example', 'pawns'));
    await page.click('#tab-channels');
    await page.waitForFunction(() => drawnChannels !== '');
    await redrawnChannel(page);
    await page.check('#channel-color');
    await page.click('#tab-algorithms');
    await page.waitForFunction(() => /same PNG|differ|None/.test(byId('algorithms-verdict').textContent), null, { timeout: 20000 });
    check('the five algorithms give one picture', /same PNG from each/.test(await page.textContent('#algorithms-verdict')), await page.textContent('#algorithms-verdict'));
    await shot(page, 'algorithms');
    await page.click('#tab-pixel');
    await page.mouse.click(300, 300);
    await page.waitForSelector('#pixel-rows tr');
    check('a click lists what is behind the pixel', (await page.$$('#pixel-rows tr')).length === 2, await page.textContent('#panel-pixel'));
    await shot(page, 'pixel');
    await page.mouse.move(302, 302);
    await page.waitForFunction(() => /face/.test(byId('under').textContent));
    check('the pointer shows the part', /gold pawn/.test(await page.textContent('#under')), await page.textContent('#under'));
    await page.focus('#tab-pixel');
    await page.keyboard.press('ArrowRight');
    check('arrows move between tabs', await page.isVisible('#panel-lesson') && await page.evaluate(() => document.activeElement.id) === 'tab-lesson');
    check('tabs: nothing in the console', page.faults.length === 0, page.faults);
  },

  lesson: (browser) => lesson(browser, address),

  async errors(browser) {
    const page = await open(browser, address);
    await drawn(page);
    await page.click('#tab-scene');
    const refused = () => page.waitForFunction(() => !byId('faults').hidden && state.isRefused);
    await page.fill('#text', '{\n  "look": "studi",\n  "polygons": [\n    {"vertices": [[0, 0, 0], [1, 0, 0], [0, 1]], "colour": "red"}\n  ]\n}\n');
    await refused();
    const marked = await page.$$eval('#ink .fault', (spans) => spans.map((span) => span.textContent).join(''));
    check('each fault is underlined', marked === '"studi"[0, 1]"colour"', marked);
    const buttons = await page.$$('#faults button');
    const chosen = [];
    for (const button of buttons) {
      await button.click();
      chosen.push(await page.evaluate(() => byId('text').value.slice(byId('text').selectionStart, byId('text').selectionEnd)));
    }
    check('each message selects its value', String(chosen) === '"studi",[0, 1],"colour"', chosen);
    check('the picture stays, with the first message over it', /did you mean studio.*and 2 more/.test(await page.textContent('#note')), await page.textContent('#note'));
    await shot(page, 'errors');
    await page.fill('#text', '{\n  "löok": "ä",,\n}');
    await page.waitForFunction(() => !state.isValid && faults.length === 1);
    const place = await page.evaluate(() => placeOf(faults[0]));
    check('broken JSON is marked where it breaks', place.from === '{\n  "löok": "ä",'.length, place);
    await redrawn(page, () => page.fill('#text', '{"look": "clay", "polygons": [{"vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "doubleSided": true}]}'));
    check('mended, it is drawn', await page.isHidden('#note') && await page.isHidden('#faults'));
    check('only the refused requests are in the console', page.faults.every((fault) => /status of 4/.test(fault)), page.faults);
  },

  async copies(browser) {
    const page = await open(browser, address);
    await drawn(page);
    const copied = async (kind) => {
      await page.click('#copy');
      await page.click('#copy-' + kind);
      await page.waitForFunction((k) => copyKind === k && byId('copied').textContent, kind);
      const text = await page.textContent('#copied');
      await page.click('#copy-dialog .close');
      return text;
    };
    const scenes = [['pawns', null], ['pawns', 'drag'], ['triangle', null], ['solids', null], ['pawns', 'sheet'], ['triangle', 'turntable']];
    for (const [name, act] of scenes) {
      await redrawn(page, () => page.selectOption('#example', name));
      if (act === 'drag') {
        await page.focus('#frame');
        await redrawn(page, () => page.keyboard.press('ArrowLeft'));
      } else if (act) {
        await redrawn(page, () => page.click(`#views button[value=${act}]`));
      }
      await quiet(page);
      const bytes = await saved(page), label = name + (act ? ', ' + act : '');
      for (const [kind, language] of [['curl', 'sh'], ['command', 'sh'], ['python', 'python']]) {
        const result = run(`${name}-${act}-${kind}`, await copied(kind), language);
        check(`${label}: copied as ${kind}, it gives the picture byte for byte`, bytes.length > 100 && bytes.equals(result.bytes), `${bytes.length} and ${result.bytes.length} bytes; ${result.error}`);
      }
      JSON.parse(await copied('json'));
    }
    await redrawn(page, () => page.selectOption('#example', 'hills'));
    const text = await textOf(page), link = await copied('link');
    check('the link holds the scene', link.startsWith(address + '/#') && link.length < 6000, link.slice(0, 80));
    const other = await open(browser, address, { hash: link.slice(address.length) });
    await drawn(other);
    check('the link opens it again', await textOf(other) === text);
    check('links: nothing in the console', other.faults.length === 0, other.faults);
    await page.click('#copy');
    await shot(page, 'copy');
    check('copies: nothing in the console', page.faults.length === 0, page.faults);
  },

  async keys(browser) {
    const page = await open(browser, address);
    await drawn(page);
    await page.waitForFunction(() => document.querySelectorAll('#looks input').length > 0);
    const order = [];
    for (let i = 0; i < 22; i++) {
      await page.keyboard.press('Tab');
      order.push(await page.evaluate(() => { const at = document.activeElement; return at.id || at.value || at.tagName; }));
    }
    const wanted = ['open', 'example', 'copy', 'theme', 'A', 'help', 'frame', 'one', 'sheet', 'three', 'turntable', 'box', 'title', 'triad', 'scale', 'labels', 'holes', 'save', 'look-studio', 'tab-model', 'panel-model'];
    check('Tab goes header, picture, views, looks, tabs, panel', String(order.slice(0, wanted.length)) === String(wanted), order);
    for (const mark of ['holes', 'box']) await redrawn(page, () => page.click(`#marks button[value=${mark}]`));
    check('marks are in the order of the list', String((await sceneOf(page)).annotate) === 'box,holes');
    for (const mark of ['holes', 'box']) await redrawn(page, () => page.click(`#marks button[value=${mark}]`));
    check('without marks, the key is gone', (await sceneOf(page)).annotate === undefined);
    await page.focus('#frame');
    const press = (key) => redrawn(page, () => page.keyboard.press(key));
    await press('ArrowLeft');
    const first = (await sceneOf(page)).view;
    await press('ArrowLeft');
    const second = (await sceneOf(page)).view;
    check('an arrow turns by 5 degrees', Math.abs(Math.abs(first.azimuthDegrees - second.azimuthDegrees) - 5) < 0.01, [first, second]);
    await press('Shift+ArrowUp');
    check('Shift and an arrow move', String((await sceneOf(page)).view.target) !== String(second.target));
    await press('+');
    check('plus goes nearer', (await sceneOf(page)).view.distance < second.distance);
    await press('3');
    check('3 is the left side', (await sceneOf(page)).view.preset === 'left');
    await press('0');
    check('0 fits', (await sceneOf(page)).view === undefined);
    await press(']');
    check('] is the next look', (await sceneOf(page)).look === 'technical');
    await press('[');
    check('[ is the look before', (await sceneOf(page)).look === 'studio');
    const looked = await textOf(page);
    await press('7');
    await press('Control+z');
    check('Ctrl and z undo', await textOf(page) === looked);
    await page.keyboard.press('c');
    await page.waitForFunction(() => /depth/.test(byId('time').textContent));
    check('c shows the next channel', await page.evaluate(() => state.channel) === 'depth');
    for (let i = 0; i < 3; i++) await page.keyboard.press('c');
    await quiet(page);
    await page.focus('#frame');
    await page.keyboard.press('Enter');
    await page.waitForFunction(() => !byId('pin').hidden && /^Pixel/.test(byId('pixel-text').textContent));
    const pixel = await page.textContent('#pixel-text b');
    await page.keyboard.press('Alt+ArrowRight');
    await page.waitForFunction((before) => { const at = document.querySelector('#pixel-text b'); return at && at.textContent !== before; }, pixel);
    check('Enter lists the surfaces of the middle, Alt and an arrow those of the pixel beside it', await page.textContent('#pixel-text b') !== pixel);
    await page.keyboard.press('Escape');
    check('Escape takes the pin away', await page.isHidden('#pin'));
    await page.keyboard.press('?');
    check('the question mark lists the keys', await page.isVisible('#help-dialog'));
    check('the keys pass axe', (await violations(page)).length === 0, await violations(page));
    await page.keyboard.press('Escape');
    check('Escape closes them', await page.isHidden('#help-dialog'));
    await page.click('#tab-scene');
    await page.focus('#text');
    const before = await textOf(page);
    await page.keyboard.press('End');
    await page.keyboard.type('c');
    check('letters in the text are text', (await textOf(page)).length === before.length + 1);
  },

  async widths(browser) {
    for (const scheme of ['light', 'dark']) {
      for (const [width, height] of [[1440, 900], [1024, 700], [360, 740]]) {
        const page = await open(browser, address, { viewport: { width, height }, colorScheme: scheme });
        await drawn(page);
        await page.waitForFunction(() => drawnLooks !== '', null, { timeout: 20000 });
        const label = `${width} px, ${scheme}`;
        for (const tab of TABS) {
          await page.click('#tab-' + tab);
          if (tab === 'lesson') {
            await page.click('#lesson-scenes button[value=ring]');
            for (const algorithm of ['trapezoid', 'scanline', 'painter', 'halfspace', 'edgelist']) {
              await page.click(`#lesson-algorithms button[value=${algorithm}]`);
              await page.waitForFunction((kind) => lesson.trace && lesson.trace.algorithm === kind && !byId('lesson-grid').hidden, algorithm, { timeout: 20000 });
              await page.evaluate(() => goTo(Math.floor(lesson.steps.length * 0.7)));
              const faults = await violations(page);
              check(`${label}, lesson of ${algorithm}: axe finds nothing`, faults.length === 0, faults);
            }
            await shot(page, `${width}-${scheme}-lesson`);
          }
          await page.waitForTimeout(150);
          const wide = await page.evaluate(() => document.documentElement.scrollWidth);
          check(`${label}, ${tab}: no scroll sideways`, wide <= width, String(wide));
          const found = await violations(page);
          check(`${label}, ${tab}: axe finds nothing`, found.length === 0, found);
        }
        await page.click('#tab-scene');
        await redrawn(page, () => page.selectOption('#example', 'bearing'));
        await page.waitForTimeout(1200);
        await shot(page, `${width}-${scheme}`);
        await page.click('#copy');
        await page.waitForFunction(() => byId('copied').textContent);
        const found = await violations(page);
        check(`${label}, copy: axe finds nothing`, found.length === 0, found);
        await page.keyboard.press('Escape');
        if (width === 360) {
          const small = await page.$$eval('header button, header select, #views button, #save, [role=tab], #panel-lesson button', (all) => all.filter((node) => node.offsetParent && node.getBoundingClientRect().height < 40).map((node) => node.id));
          check(`${label}: targets are 40 px high`, small.length === 0, small);
        }
        const ground = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
        check(`${label}: the ground`, ground === (scheme === 'dark' ? 'rgb(18, 22, 27)' : 'rgb(244, 246, 248)'), ground);
        await page.click('#theme');
        const other = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
        check(`${label}: the button changes it`, other !== ground, other);
        await page.close();
      }
    }
  },

  async touch(browser) {
    const page = await open(browser, address, { viewport: { width: 360, height: 740 }, hasTouch: true, isMobile: true });
    await drawn(page);
    const session = await page.context().newCDPSession(page);
    const touch = (type, ...points) => session.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
    await redrawn(page, async () => {
      await touch('touchStart', [150, 200]);
      for (let i = 1; i <= 8; i++) await touch('touchMove', [150 + 10 * i, 200]);
      await touch('touchEnd');
    });
    await quiet(page);
    const one = (await sceneOf(page)).view;
    check('one finger turns', Boolean(one && one.azimuthDegrees !== undefined), one);
    await redrawn(page, async () => {
      await touch('touchStart', [150, 200], [200, 200]);
      for (let i = 1; i <= 8; i++) await touch('touchMove', [150 - 5 * i, 200], [200 + 5 * i, 200]);
      await touch('touchEnd');
    });
    await quiet(page);
    const two = (await sceneOf(page)).view;
    check('two fingers zoom', Boolean(two && two.distance < one.distance && two.azimuthDegrees === one.azimuthDegrees), [one, two]);
    check('touch: nothing in the console', page.faults.length === 0, page.faults);
  },

  async files(browser) {
    const bare = await daemon();
    const ball = Buffer.from(await (await fetch(address + '/v1/examples/ball.obj')).arrayBuffer());
    for (const [label, from] of [['with assets', address], ['without assets', bare]]) {
      const page = await open(browser, from);
      await drawn(page);
      await redrawn(page, () => page.setInputFiles('#file', { name: 'my ball.obj', mimeType: 'model/obj', buffer: ball }));
      await quiet(page);
      const scene = await sceneOf(page);
      check(`${label}: a model becomes a scene`, scene.look === 'studio' && scene.meshes[0].asset === 'my ball.obj' && scene.meshes[0].name === 'my ball', scene);
      check(`${label}: it is drawn`, await page.isHidden('#note'), await page.textContent('#note'));
      await redrawn(page, () => page.evaluate((bytes) => {
        const transfer = new DataTransfer();
        transfer.items.add(new File(['mtllib m.mtl\nusemtl red\n' + bytes], 'dropped.obj'));
        transfer.items.add(new File(['newmtl red\nKd 0.9 0.1 0.1\n'], 'm.mtl'));
        dispatchEvent(new DragEvent('drop', { dataTransfer: transfer, cancelable: true }));
      }, String(ball)));
      await quiet(page);
      const middle = await page.evaluate(() => [...byId('picture').getContext('2d').getImageData(byId('picture').width / 2, byId('picture').height / 2, 1, 1).data]);
      check(`${label}: files that refer to each other are dropped together`, middle[0] > 2 * middle[1], middle);
      check(`${label}: nothing in the console, such as a 404`, page.faults.length === 0, page.faults);
      const isSaid = (text) => page.waitForFunction((text) => byId('note').textContent.includes(text), text, { timeout: 5000 }).then(() => true, () => false);
      for (const [text, place] of [['', 'line 1'], ['{bad', 'line 1, column 2'], ['[]', 'a list']]) {
        await page.setInputFiles('#file', { name: 'broken.json', mimeType: 'application/json', buffer: Buffer.from(text) });
        check(`${label}: the broken file '${text}' is refused, with the place`, await isSaid(place), await page.textContent('#note'));
      }
      const parts = '{"meshes": [{"asset": "one.obj"}, {"asset": "two.obj"}]}', obj = (name) => ({ name, mimeType: 'model/obj', buffer: ball });
      await page.setInputFiles('#file', [{ name: 'parts.json', mimeType: 'application/json', buffer: Buffer.from(parts) }, obj('one.obj')]);
      check(`${label}: a missing file is asked for`, await isSaid("'two.obj' is missing: drop that file, too"), await page.textContent('#note'));
      await redrawn(page, () => page.setInputFiles('#file', obj('two.obj')));
      check(`${label}: it is added`, await page.inputValue('#text') === parts && await page.isHidden('#note'), await page.textContent('#note'));
      await redrawn(page, () => page.setInputFiles('#file', [obj('one.obj'), { name: 'a.stl', mimeType: 'model/stl', buffer: Buffer.from('x') }]));
      check(`${label}: a note tells of a file that is left out`, await page.textContent('#note') === 'Opened: one.obj. Left out: a.stl.', await page.textContent('#note'));
      await page.close();
    }
    const page = await open(browser, address);
    await drawn(page);
    await page.setInputFiles('#file', { name: 'notes.txt', mimeType: 'text/plain', buffer: Buffer.from('x') });
    check('other files are refused with a message', /hold no scene/.test(await page.textContent('#note')));
    await page.setInputFiles('#file', { name: 'model.zip', mimeType: 'application/zip', buffer: Buffer.from('PK') });
    check('an archive is for others', /Archives \(\.zip\) are for the command and the daemon/.test(await page.textContent('#note')), await page.textContent('#note'));
  },

  async token(browser) {
    const closed = await daemon('--token=secret');
    const page = await open(browser, closed);
    await page.waitForSelector('#token[open]');
    check('the field of the token passes axe', (await violations(page)).length === 0, await violations(page));
    await page.keyboard.type('secret');
    await page.keyboard.press('Enter');
    await drawn(page);
    check('a token opens the daemon', await page.isHidden('#token') && await page.isHidden('#note'));
  },

  async busy(browser) {
    const page = await open(browser, address);
    await drawn(page);
    await quiet(page);
    await page.waitForFunction(() => drawnLooks !== '', null, { timeout: 20000 });
    let refusals = 1;
    await page.route('**/v1/render*', (route) => refusals-- > 0
      ? route.fulfill({ status: 503, headers: { 'Retry-After': '1', 'Content-Type': 'application/problem+json' }, body: '{"detail": "full"}' }) : route.continue());
    await redrawn(page, async () => {
      await page.check('input[value=clay]');
      await page.waitForFunction(() => /busy; trying again in 1 s/.test(byId('note').textContent));
    });
    check('a busy daemon is asked again', await page.isHidden('#note'), await page.textContent('#note'));
  },

  async offline(browser) {
    const page = await open(browser, address);
    await drawn(page);
    await page.context().setOffline(true);
    await page.check('input[value=dark]');
    await page.waitForFunction(() => /Is the daemon running/.test(byId('note').textContent));
    check('without an answer, the page names the cause', await page.isVisible('#note'));
  },
};

async function redrawnChannel(page) {
  await page.check('#channel-depth');
  await page.waitForFunction(() => /depth/.test(byId('time').textContent));
  const isGray = await page.evaluate(() => {
    const { data } = byId('picture').getContext('2d').getImageData(0, 0, byId('picture').width, byId('picture').height);
    let colored = 0, light = 0;
    for (let i = 0; i < data.length; i += 4) {
      if (data[i] === 16 && data[i + 2] === 26) continue;
      if (data[i] !== data[i + 1] || data[i] !== data[i + 2]) colored++;
      if (data[i] > 240) light++;
    }
    return colored === 0 && light > 10;
  });
  check('a channel is shown large', isGray);
  await shot(page, 'channels');
}

daemon('--assets-dir', assets).then((at) => { address = at; return main(tests); });
