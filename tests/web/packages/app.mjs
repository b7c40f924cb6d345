// app.mjs - components of the README in a page: two that draw at once, other properties, one that leaves while it draws.
import { createElement, StrictMode } from 'react';
import { createRoot } from 'react-dom/client';
import { Model } from './Model.mjs';

const faults = [];
addEventListener('unhandledrejection', event => faults.push(`unhandled: ${event.reason?.stack ?? event.reason}`));
addEventListener('error', event => faults.push(`error: ${event.message}`));
const body = new Uint8Array(await (await fetch('part.stl')).arrayBuffer());
const small = { body, width: 160, height: 120 }, large = { body, width: 2000, height: 2000, look: 'studio', samples: 16 };

function place() {
  const root = createRoot(document.body.appendChild(document.createElement('div')));
  return { show: properties => root.render(createElement(StrictMode, null, createElement(Model, properties))), leave: () => root.unmount() };
}

/* The colours of a canvas, when they are there and are no longer the old ones. */
async function colours(width, old = '') {
  for (;;) {
    const canvas = [...document.querySelectorAll('canvas')].find(canvas => canvas.width === width);
    const data = canvas?.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
    if (data?.some(value => value) && String(data) !== String(old)) return data;
    await new Promise(done => setTimeout(done, 20));
  }
}

const first = place(), second = place(), third = place();
first.show({ ...small, look: 'clay' });
second.show({ ...small, width: 200, look: 'technical' });
const clay = await colours(160);
await say('clay', clay);
await say('technical', await colours(200));

first.show({ ...small, look: 'textbook', azimuth: 70 });
const textbook = await colours(160, clay);
await say('textbook', textbook);

third.show(large);
await new Promise(done => setTimeout(done, 100));
first.show({ ...small, look: 'dark' });
third.leave();
await say('dark', await colours(160, textbook));

first.leave();
second.show({ ...small, body: new Uint8Array([1, 2, 3]), width: 200 });
while (!faults.length) await new Promise(done => setTimeout(done, 20));
const expected = faults.splice(0).join('\n');
await say('broken', expected);
second.leave();
await new Promise(done => setTimeout(done, 300));
await say('end', faults.join('\n'));
