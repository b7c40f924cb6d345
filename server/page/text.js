// The text of the scene: where its values stand, and how one of them is replaced. Layout and order of the rest stay.

const TOKEN = /\s*("(?:[^"\\]|\\.)*"|[-+.\w]+|[{}[\],:])/y;

// Maps the JSON Pointer of each value of valid JSON to {key, from, to}: where its key and it begin, and where it ends.
function scan(text) {
  const places = new Map();
  let from = 0, token = '';
  const next = () => {
    const match = TOKEN.exec(text);
    token = match ? match[1] : '';
    from = TOKEN.lastIndex - token.length;
    return token;
  };
  const value = (pointer, key) => {
    const begin = from, close = token === '{' ? '}' : token === '[' ? ']' : '';
    if (close && next() !== close) {
      for (let i = 0; ; i++) {
        const place = from;
        let name = i;
        if (close === '}') {
          name = JSON.parse(token).replace(/~/g, '~0').replace(/\//g, '~1');
          next();
          next();
        }
        value(pointer + '/' + name, place);
        if (next() !== ',') break;
        next();
      }
    }
    places.set(pointer, { key, from: begin, to: TOKEN.lastIndex });
  };
  TOKEN.lastIndex = 0;
  next();
  value('', 0);
  return places;
}

let scanned = { text: null, places: null };

function placesOf(text) {
  if (scanned.text !== text) scanned = { text, places: scan(text) };
  return scanned.places;
}

// One line of JSON with spaces.
function toLine(value) {
  return JSON.stringify(value, null, 1).replace(/\n\s*/g, ' ').replace(/([{[]) /g, '$1').replace(/ ([}\]])/g, '$1');
}

// The text with other values at the top: {look: 'clay', view: undefined}. undefined removes a key. `more` are edits of one's
// own, {from, to, text}.
function withKeys(text, changes, more = []) {
  const places = placesOf(text), edits = [...more], added = [], root = places.get('');
  const removed = new Set();
  for (const [key, value] of Object.entries(changes)) {
    const place = places.get('/' + key);
    if (value === undefined) {
      if (place) removed.add(key);
    } else if (place) {
      edits.push({ from: place.from, to: place.to, text: toLine(value) });
    } else {
      added.push(JSON.stringify(key) + ': ' + toLine(value));
    }
  }
  const members = [...places].filter(([pointer]) => pointer && pointer.indexOf('/', 1) < 0);
  const kept = members.filter(([pointer]) => !removed.has(pointer.slice(1)));
  members.forEach(([pointer, place], i) => {
    if (!removed.has(pointer.slice(1))) return;
    const after = members[i + 1], before = members[i - 1];
    if (after) edits.push({ from: place.key, to: after[1].key, text: '' });
    else edits.push({ from: before && kept.length ? kept[kept.length - 1][1].to : place.key, to: place.to, text: '' });
  });
  if (added.length) {
    const first = members[0];
    const indent = first ? /\n\s*$/.exec(text.slice(0, first[1].key)) : null;
    const between = indent ? ',' + indent[0] : ', ';
    const at = kept.length ? kept[kept.length - 1][1].to : root.from + 1;
    edits.push({ from: at, to: at, text: (kept.length ? between : '') + added.join(between) });
  }
  edits.sort((a, b) => a.from - b.from || a.to - b.to);
  let out = '', at = 0;
  for (const edit of edits) {
    if (edit.from < at && edit.to <= at) continue;
    out += text.slice(at, Math.max(at, edit.from)) + edit.text;
    at = Math.max(at, edit.to);
  }
  return out + text.slice(at);
}

function parsed(text) {
  try {
    const scene = JSON.parse(text);
    return scene && typeof scene === 'object' && !Array.isArray(scene) ? scene : null;
  } catch {
    return null;
  }
}

// Makes an element: el('p', {className: 'soft'}, 'text', child).
function el(name, properties = {}, ...children) {
  const node = document.createElement(name);
  for (const [key, value] of Object.entries(properties)) {
    if (key in node) node[key] = value;
    else node.setAttribute(key, value);
  }
  node.append(...children);
  return node;
}

const byId = (id) => document.getElementById(id);
const round = (value, digits = 5) => Number(Number(value).toPrecision(digits));
const pause = (ms) => new Promise((done) => setTimeout(done, ms));
