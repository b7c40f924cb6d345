// The tab Model: facts, a cut, the distance of the parts, and the list of them.

const CUTS = ['', 'x', 'y', 'z'];
let listedParts = '', slid = '';

const cutOf = (scene) => {
  const planes = scene.sections?.planes || [], [{ axis, keep } = {}] = planes;
  return !scene.sections ? '' : planes.length === 1 && !keep ? axis : null;
};
const setCut = (axis, isMoving) => setKeys({ sections: axis ? { planes: [{ axis, fraction: byId('cut-at').value / 100 }] } : undefined }, isMoving);
const hiddenParts = () => [state.scene.hide ?? []].flat().map(String);

// Changes keys by a slider. Its moves are one step of undo.
function slide(input, change) {
  input.oninput = () => {
    const steps = past.length, isSame = slid === state.text;
    idle.abort();
    motion.is = true;
    clearTimeout(motion.timer);
    motion.timer = setTimeout(() => {
      motion.is = false;
      refresh();
    }, REST_MS);
    change(input.value / 100);
    if (isSame && past.length > steps) past.pop();
    slid = state.text;
  };
}

function showModel() {
  const { scene } = state, cut = cutOf(scene), hidden = hiddenParts();
  for (const button of byId('cut').children) button.setAttribute('aria-pressed', String(button.value === cut));
  byId('cut-at').disabled = !cut;
  if (cut) byId('cut-at').value = 100 * (scene.sections.planes[0].fraction ?? 0.5);
  byId('apart').value = 100 * (scene.explode?.factor ?? scene.explode ?? 0);
  for (const input of byId('parts').querySelectorAll('input')) input.checked = !hidden.includes(input.value);
}

function listParts(parts) {
  const count = (name) => parts.filter((part) => part.name === name).length;
  byId('parts').replaceChildren(...parts.slice(0, 300).map(({ name, id, color }) => {
    const key = count(name) > 1 || /[*?]/.test(name) ? id : name, swatch = el('span', { className: 'swatch' });
    const input = el('input', { type: 'checkbox', value: String(key) });
    swatch.style.background = color;
    input.onchange = () => {
      const hide = [state.scene.hide ?? []].flat().filter((other) => String(other) !== input.value).concat(input.checked ? [] : key);
      setKeys({ hide: hide.length ? hide : undefined });
    };
    return el('label', {}, input, swatch, name);
  }));
}

function listenToModel() {
  byId('cut').replaceChildren(...CUTS.map((axis) => el('button', { type: 'button', value: axis }, axis || 'None')));
  for (const button of byId('cut').children) button.onclick = () => setCut(button.value);
  slide(byId('cut-at'), () => setCut(cutOf(state.scene), true));
  slide(byId('apart'), (explode) => setKeys({ explode: explode || undefined }, true));
}

onRest(async (signal) => {
  if (!state.isValid || isSeveral()) return;
  const { parts = [], counts, bounds, unit } = await loadInfo(signal);
  const size = bounds && !state.scene.explode ? bounds.max.map((most, i) => round(most - bounds.min[i], 4)).join(' × ') + ` ${unit || ''}` : '';
  byId('model-facts').textContent = `${parts.length} ${parts.length === 1 ? 'part' : 'parts'}, ${counts.triangles.toLocaleString('en')} triangles` + (size && `, ${size}`);
  const names = JSON.stringify(parts.map(({ name, color }) => [name, color]));
  byId('apart').disabled = parts.length < 2;
  if (listedParts !== names) listParts(parts);
  listedParts = names;
  showModel();
});
