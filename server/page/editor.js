// The text of the scene, with its faults marked in it and listed below it.

let faults = [], editTimer = 0, typed = null;

const PARTS = /("(?:[^"\\\n]|\\.)*")(\s*:)?|(-?\d[\d.eE+-]*)|\b(true|false|null)\b/g;

// The text in spans by kind; `marks` are places to underline, ascending.
function colored(text, marks) {
  const out = document.createDocumentFragment();
  const put = (from, to, kind) => {
    while (from < to) {
      const mark = marks.find((m) => m.to > from);
      const isIn = mark && mark.from <= from;
      const end = Math.min(to, mark ? (isIn ? mark.to : mark.from) : to);
      const piece = text.slice(from, end);
      if (isIn || kind) out.append(el('span', { className: (kind || '') + (isIn ? ' fault' : '') }, piece));
      else out.append(piece);
      from = end;
    }
  };
  if (text.length > 60000) {
    put(0, text.length, '');
    return out;
  }
  let at = 0;
  for (const match of text.matchAll(PARTS)) {
    const [all, string, colon, number] = match;
    const kind = string ? (colon ? 'key' : 'string') : number ? '' : 'word';
    if (!kind) continue;
    put(at, match.index, '');
    const length = string ? string.length : all.length;
    put(match.index, match.index + length, kind);
    at = match.index + length;
  }
  put(at, text.length, '');
  return out;
}

function showText() {
  const area = byId('text');
  if (area.value !== state.text) area.value = state.text;
  mark();
}

// The place of a fault: its value, or that of the nearest thing around it; in broken JSON, the byte that the daemon names.
function placeOf({ pointer, detail, offset }) {
  const text = state.text;
  if (!state.isValid) {
    if (offset === undefined) return null;
    const before = new TextDecoder().decode(new TextEncoder().encode(text).slice(0, offset));
    const from = Math.min(before.length, Math.max(0, text.length - 1));
    return { from, to: from + 1 };
  }
  const places = placesOf(text);
  let at = pointer || '';
  while (at && !places.has(at)) at = at.slice(0, at.lastIndexOf('/'));
  const place = at && places.get(at);
  if (!place) return null;
  const isKey = /unknown key/.test(detail) || text[place.from] === '{' || text[place.from] === '[' && place.to - place.from > 60;
  if (!isKey) return { from: place.from, to: place.to };
  return text[place.key] === '"' ? { from: place.key, to: placeEnd(place.key) } : { from: place.from, to: place.from + 1 };
}

function placeEnd(from) {
  TOKEN.lastIndex = from;
  const match = TOKEN.exec(state.text);
  return match ? TOKEN.lastIndex : from + 1;
}

function mark() {
  const marks = faults.map((fault) => fault.isWarning ? null : placeOf(fault)).filter(Boolean).sort((a, b) => a.from - b.from);
  byId('ink').replaceChildren(colored(state.text, marks), '\n');
  follow();
}

function follow() {
  byId('ink').scrollTop = byId('text').scrollTop;
  byId('ink').scrollLeft = byId('text').scrollLeft;
}

// Lists of allowed words are in the title.
const withoutList = (detail) => detail.replace(/; (allowed|known here): .*/s, '').replace(/no part of the request has the name ('.*')/, '$1 is missing: drop that file, too');

// Shows the faults of a refusal, or none, with the warnings of a picture.
function showErrors(refusal, warnings = '') {
  state.isRefused = Boolean(refusal);
  faults = refusal ? (refusal.errors || [{ pointer: '', detail: refusal.message }]) : [];
  if (warnings) faults = warnings.split('; ').map((detail) => ({ pointer: '', detail, isWarning: true }));
  byId('faults').replaceChildren(...faults.map((fault) => {
    const place = fault.isWarning ? null : placeOf(fault);
    const row = el(place ? 'button' : 'p', { className: fault.isWarning ? 'warning' : 'error' });
    if (fault.pointer) row.append(el('code', {}, fault.pointer), ' ');
    row.append(fault.isWarning ? 'Warning: ' + fault.detail : withoutList(fault.detail));
    row.title = fault.detail;
    if (place) {
      row.type = 'button';
      row.onclick = () => {
        choose('scene');
        const area = byId('text');
        area.focus();
        area.setSelectionRange(place.from, place.to);
        area.scrollTop = Math.max(0, (state.text.slice(0, place.from).split('\n').length - 4) * 19);
      };
    }
    return el('li', {}, row);
  }));
  byId('faults').hidden = !faults.length;
  byId('text').setAttribute('aria-invalid', String(Boolean(refusal)));
  if (refusal) {
    const [first] = faults, more = faults.length - 1;
    say((first.pointer ? first.pointer + ': ' : '') + withoutList(first.detail) + (more > 0 ? `, and ${more} more` : ''), true);
  } else {
    say(state.word);
  }
  mark();
}

function listenToText() {
  const area = byId('text');
  area.oninput = () => {
    clearTimeout(editTimer);
    faults = [];
    state.example = '';
    typed = area.value;
    setText(area.value);
    editTimer = setTimeout(refresh, 250);
  };
  area.onscroll = follow;
}

// Finds the place at which the JSON breaks.
async function checkSyntax() {
  const { text } = state;
  try {
    await (HAS_DAEMON ? readThere : readHere)(text || ' ');
  } catch (error) {
    if (text === state.text) showErrors(error);
  }
}
