// The looks: a thumbnail of this scene in each, from this side.

let looks = [], drawnLooks = '';

function buildLooks() {
  const list = byId('looks');
  list.replaceChildren(...looks.map((look) => {
    const input = el('input', { type: 'radio', name: 'look', value: look.name, id: 'look-' + look.name });
    input.onchange = () => setKeys({ look: look.name });
    return el('label', { title: look.text, htmlFor: input.id }, input,
      el('canvas', { width: 160, height: 120, 'aria-hidden': 'true' }), el('span', {}, look.name));
  }));
  showLook();
  for (const { name } of looks) showTile(name).catch(() => {});
}

// Until this scene is drawn, shows a picture that is there: of the first example, or that of the manual.
async function showTile(name) {
  const canvas = tileOf(name), blob = await (await fetch(HAS_DAEMON ? `docs/pictures/look-${name}.png` : `looks/${name}.webp`)).blob();
  if (!canvas.dataset.drawn) await paint(canvas, blob);
}

const tileOf = (name) => byId('look-' + name).nextElementSibling;

const lookName = () => String(state.scene.look || 'textbook').split('@')[0];

function showLook() {
  for (const input of byId('looks').querySelectorAll('input')) input.checked = input.value === lookName();
}

function nextLook(step) {
  const at = looks.findIndex((look) => look.name === lookName());
  if (looks.length) setKeys({ look: looks[(at + step + looks.length) % looks.length].name });
}

// A single view of the scene for small pictures.
function smallKeys(width, height) {
  const changes = pictureKeys(), size = pictureSize();
  const shape = size.width / size.height;
  changes.window = shape > width / height ? { width, height: Math.round(width / shape) } : { width: Math.round(height * shape), height };
  for (const key of SEVERAL) if (state.scene[key] !== undefined) changes[key] = undefined;
  return changes;
}

async function paint(canvas, blob) {
  const bitmap = await createImageBitmap(blob), context = canvas.getContext('2d');
  const scale = Math.max(canvas.width / bitmap.width, canvas.height / bitmap.height);
  const width = bitmap.width * scale, height = bitmap.height * scale;
  context.drawImage(bitmap, (canvas.width - width) / 2, (canvas.height - height) / 2, width, height);
  bitmap.close();
}

onRest(async (signal) => {
  const key = state.version + JSON.stringify(state.camera);
  if (drawnLooks === key || !state.isValid) return;
  if (!HAS_DAEMON && state.version === 1 && state.example && !state.camera) return void (drawnLooks = key); // tiles show it
  for (const look of looks) {
    const changes = { ...smallKeys(160, 120), look: look.name };
    if (!(state.scene.samples <= 4)) changes.samples = 4;
    if (state.scene.fog && look.name !== 'textbook') changes.fog = undefined; // which linear light refuses
    const canvas = tileOf(look.name);
    try {
      const { blob } = await render(state.text, changes, '?channel=color', signal);
      canvas.dataset.drawn = look.name;
      await paint(canvas, blob);
      canvas.classList.remove('failed');
    } catch (error) {
      if (error.name === 'AbortError') throw error;
      canvas.classList.add('failed');
    }
  }
  drawnLooks = key;
});
