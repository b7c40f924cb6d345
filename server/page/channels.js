// Channels side by side: colour, depth, normals, instances.

const CHANNELS = [
  ['color', 'Colour'],
  ['depth', 'Depth: near is light'],
  ['normals', 'Normals, as colours'],
  ['instanceId', 'Instances, by colour'],
];

// Twelve colours that differ, for ids.
const PALETTE = ['#2b6cb0', '#dd8a2e', '#3f9d57', '#b3372f', '#8a5bc4', '#7a5a43', '#d06aa8', '#6b7680', '#a9b32a', '#1f9aa8', '#e0b02e', '#5b6be0'];
const rgb = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));

// Turns numbers into a picture: depth stretched over what is there, ids by the palette.
function imageOf(values, width, height, channel) {
  const image = new ImageData(width, height), pixels = image.data;
  let near = Infinity, far = -Infinity;
  if (channel === 'depth') {
    for (const value of values) {
      if (value === Infinity) continue;
      near = Math.min(near, value);
      far = Math.max(far, value);
    }
  }
  const colors = PALETTE.map(rgb), range = far - near || 1;
  for (let i = 0; i < width * height; i++) {
    let color = [16, 20, 26];
    if (channel === 'depth' && values[i] !== Infinity) color = Array(3).fill(255 - 205 * (values[i] - near) / range);
    if (channel !== 'depth' && values[i]) color = colors[(values[i] - 1) % colors.length];
    pixels.set(color, 4 * i);
    pixels[4 * i + 3] = 255;
  }
  return image;
}

const isPicture = (channel) => channel === 'color' || channel === 'normals';

// Draws channels, each into a canvas of the window's size.
async function drawChannels(canvases, changes, signal) {
  const outputs = [...canvases.keys()].map((channel) => isPicture(channel) ? { channel, encoding: 'png' } : { channel });
  const answer = await render(state.text, { ...changes, outputs }, '', signal);
  const { width, height } = changes.window || state.scene.window;
  for (const [channel, canvas] of canvases) {
    const blob = answer.parts ? answer.parts.get(channel) : answer.blob;
    const image = isPicture(channel) ? await createImageBitmap(blob) : imageOf(await npy(blob), width, height, channel);
    canvas.width = width;
    canvas.height = height;
    if (isPicture(channel)) canvas.getContext('2d').drawImage(image, 0, 0);
    else canvas.getContext('2d').putImageData(image, 0, 0);
  }
}

// Shows a channel large.
async function showChannel(channel, changes, signal) {
  await drawChannels(new Map([[channel, byId('picture')]]), changes, signal);
  byId('movie').hidden = true;
  byId('picture').classList.remove('covered');
  fitStage();
  byId('time').textContent = `${byId('picture').width} × ${byId('picture').height} · ${channel}`;
}

function buildChannels() {
  byId('channel-cards').replaceChildren(...CHANNELS.map(([channel, title]) => {
    const input = el('input', { type: 'radio', name: 'channel', value: channel, id: 'channel-' + channel });
    input.onchange = () => setChannel(channel);
    return el('label', { htmlFor: input.id }, input, el('canvas', { width: 320, height: 240, 'aria-hidden': 'true' }), el('span', {}, title));
  }));
  showControls();
}

function setChannel(channel) {
  state.channel = channel;
  showControls();
  refresh();
}

let drawnChannels = '';

onRest(async (signal) => {
  const key = state.version + JSON.stringify(state.camera);
  if (chosen !== 'channels' || drawnChannels === key || !state.isValid) return;
  await drawChannels(new Map(CHANNELS.map(([channel]) => [channel, byId('channel-' + channel).nextElementSibling])), smallKeys(320, 240), signal);
  drawnChannels = key;
});
