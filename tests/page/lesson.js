// lesson.js - each step of the five algorithms, for scenes of polygons and of a mesh.
'use strict';
const { check, open, drawn, redrawn, shot } = require('./browser.js');

const TETRAHEDRON = '{"look": "studio", "meshes": [{"positions": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], "faces": [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]}]}';

module.exports = async function (browser, address) {
  const page = await open(browser, address);
  await drawn(page);
  await page.click('#tab-lesson');
  await page.waitForSelector('#lesson-missing');
  check('a scene of many triangles has no lesson', await page.isHidden('#lesson-body') && /triangles in view/.test(await page.textContent('#lesson-missing')));
  const shown = (scene, algorithm) => page.waitForFunction(([name, kind]) => (state.example || 'tetrahedron') === name && lesson.trace && lesson.trace.algorithm === kind &&
    lesson.key === keyOfLesson() && !byId('lesson-grid').hidden, [scene, algorithm], { timeout: 20000 });
  for (const scene of ['crossing', 'ring', 'star', 'tetrahedron']) {
    if (scene === 'tetrahedron') {
      await page.click('#tab-scene');
      await redrawn(page, () => page.fill('#text', TETRAHEDRON));
      await page.click('#tab-lesson');
    } else {
      await page.click(`#lesson-scenes button[value=${scene}]`);
    }
    for (const algorithm of ['edgelist', 'trapezoid', 'scanline', 'painter', 'halfspace']) {
      await page.click(`#lesson-algorithms button[value=${algorithm}]`);
      await shown(scene, algorithm);
      const found = await page.evaluate(async () => {
        const { trace, steps } = lesson, { width, height } = trace.window, hasBuffer = !/scanline|painter/.test(trace.algorithm);
        const faults = { words: 0, lit: 0, drawn: 0, buffer: 0, picture: 0 };
        steps.forEach((step, at) => {
          goTo(at);
          const lit = document.querySelectorAll('#code .lit').length, isOuter = at === 0 || at === steps.length - 1;
          if (byId('lesson-words').textContent !== step.words || /undefined|NaN/.test(step.words + byId('lists').textContent)) faults.words++;
          if (lit !== (isOuter ? 0 : step.lines[1] - step.lines[0] + 1)) faults.lit++;
          const before = replay(trace, steps, at), after = replay(trace, steps, at + 1);
          const changed = [...after.ids.keys()].filter((place) => before.ids[place] !== after.ids[place] || !Object.is(before.depths[place], after.depths[place]));
          const writes = step.writes || [];
          if (changed.some((place) => !writes.some(({ x, row }) => row * width + x === place))) faults.drawn++;
          if (hasBuffer && writes.some(({ x, row, z }) => !(z < (before.ids[row * width + x] ? before.depths[row * width + x] : 1.00001)))) faults.buffer++;
        });
        const held = replay(trace, steps, steps.length);
        const changes = { ...pictureKeys(), window: { width, height }, samples: 1, occlusion: false, groundShadow: false, edges: false };
        const faces = await npy((await render(state.text, changes, '?channel=faceId')).blob);
        faces.forEach((face, at) => {
          const id = held.ids[(height - 1 - Math.floor(at / width)) * width + at % width];
          if (face !== (id ? trace.primitives[id - 1].faceId : 0)) faults.picture++;
        });
        return { faults, steps: steps.length };
      });
      const label = `${scene}, ${algorithm}: ${found.steps} steps`;
      check(`${label}; each has its words, lines and squares, and writes nearer pixels only`, found.steps > 3 && found.faults.words + found.faults.lit + found.faults.drawn + found.faults.buffer === 0, found);
      check(`${label}; the last one is the picture`, found.faults.picture === 0, found);
      await page.evaluate(() => goTo(Math.floor(lesson.steps.length * 0.6)));
      await shot(page, `lesson-${scene}-${algorithm}`);
    }
  }
  const least = await page.evaluate(() => Math.min(...[...PALETTE, '#3b7dd8', '#e08a2e', '#8a5bc4'].map((color) => {
    const lights = [color, inkOn(color)].map(luminanceOf).sort((a, b) => b - a);
    return (lights[0] + 0.05) / (lights[1] + 0.05);
  })));
  check('the text of the squares has a contrast of 4.5 or more', least >= 4.5, String(least));
  await page.evaluate(() => goTo(0));
  await page.focus('#step');
  await page.keyboard.press('ArrowRight');
  check('an arrow key is a step', await page.evaluate(() => lesson.at) === 1);
  await page.focus('#lesson-algorithms button[value=edgelist]');
  await page.keyboard.press('Enter');
  await page.waitForFunction(() => lesson.trace.algorithm === 'edgelist');
  check('a key chooses the algorithm', await page.getAttribute('#lesson-algorithms button[value=edgelist]', 'aria-pressed') === 'true');
  await page.click('#tab-scene');
  check('another tab shows the picture again', await page.isVisible('#frame') && await page.isHidden('#lesson-grid'));
  check('lesson: nothing in the console', page.faults.length === 0, page.faults);
};
