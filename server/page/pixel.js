// The surface under the pointer, and all surfaces behind a pinned pixel.

let hoverTimer = 0, hoverRequest = null, pinnedKey = '';

function pixelAt(share) {
  const { width, height } = pictureSize();
  return {
    x: Math.max(0, Math.min(width - 1, Math.floor(share[0] * width))),
    y: Math.max(0, Math.min(height - 1, Math.floor(share[1] * height))),
  };
}

async function fragmentsAt(share, signal) {
  const { x, y } = pixelAt(share);
  const answer = await render(state.text, pictureKeys(), `?channel=fragments&x=${x}&y=${y}`, signal);
  return JSON.parse(await answer.blob.text());
}

const nameOf = (fragment) => fragment.node || fragment.mesh || 'polygons';

function hover(share) {
  clearTimeout(hoverTimer);
  if (motion.is || isSeveral() || !state.isValid) return;
  hoverTimer = setTimeout(async () => {
    if (hoverRequest || isPumping || pointers.size) return;
    hoverRequest = new AbortController();
    try {
      const { fragments } = await fragmentsAt(share, hoverRequest.signal);
      showUnder(fragments.find((fragment) => fragment.shown) || fragments[0]);
    } catch (error) {
      /* the picture's own request shows the error */
    }
    hoverRequest = null;
  }, 50);
}

function showUnder(fragment) {
  const line = byId('under');
  if (!fragment) {
    line.textContent = 'Background';
    return;
  }
  const point = fragment.position.map((value) => round(value, 4)).join(', ');
  line.replaceChildren(el('b', {}, nameOf(fragment)), ` · face ${fragment.faceId} · depth ${round(fragment.depth, 5)} · point ${point}`);
}

function pin(share) {
  state.pin = share;
  pinnedKey = '';
  showPin();
  if (share) choose('pixel');
  rest();
}

function showPin() {
  const marker = byId('pin');
  marker.hidden = !state.pin || isSeveral();
  if (!state.pin) return;
  marker.style.left = 100 * state.pin[0] + '%';
  marker.style.top = 100 * state.pin[1] + '%';
}

onRest(async (signal) => {
  const key = state.version + JSON.stringify([state.camera, state.pin]);
  if (chosen !== 'pixel' || pinnedKey === key || !state.isValid) return;
  const text = byId('pixel-text'), body = byId('pixel-rows'), table = byId('pixel-table');
  table.hidden = true;
  byId('pixel-span').textContent = '';
  if (!state.pin || isSeveral()) {
    text.textContent = isSeveral() ? 'Choose one view to list the surfaces of a pixel.'
      : 'Click the picture, or press Enter on it, to list every surface behind that pixel, nearest first.';
    return;
  }
  const { x, y, count, fragments } = await fragmentsAt(state.pin, signal);
  text.replaceChildren('Pixel ', el('b', {}, `${x}, ${y}`), count === 0 ? ' shows the background: nothing is behind its centre.'
    : count === 1 ? ' has one surface behind its centre.'
      : ` has ${count} surfaces behind its centre. ${fragments.some((f) => f.alphaMode === 'BLEND')
        ? 'Blended ones in front of the nearest opaque one are visible, too.' : 'The nearest one hides the others.'}`);
  table.hidden = !count;
  body.replaceChildren(...fragments.slice(0, 200).map((fragment) => {
    const swatch = el('span', { className: 'swatch' });
    swatch.style.background = PALETTE[(fragment.instanceId - 1 + PALETTE.length) % PALETTE.length];
    return el('tr', { className: fragment.shown ? 'seen' : '' }, el('td', {}, swatch, nameOf(fragment)), el('td', { className: 'number' }, String(fragment.faceId)),
      el('td', {}, fragment.frontFacing === 2 ? 'back' : fragment.frontFacing === 1 ? 'front' : 'line'),
      el('td', { className: 'number' }, String(round(fragment.depth, 6))), el('td', {}, fragment.shown ? 'visible' : 'hidden'));
  }));
  if (count > 1) {
    const last = fragments[fragments.length - 1];
    byId('pixel-span').textContent = `From nearest to farthest: ${round(last.depth - fragments[0].depth, 4)} scene units.`;
  }
  pinnedKey = key;
});
