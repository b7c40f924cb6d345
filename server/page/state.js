// State of the page: the text of the scene, the camera, and what was drawn of them.

const state = {
  text: '',
  scene: {}, // the text, parsed; the last valid one
  isValid: true,
  isRefused: false,
  version: 0, // rises with each change of the text that changes the picture
  camera: null, // while it was moved since the text was last read
  info: null, // of `version`, without pixels
  channel: 'color',
  pin: null, // shares of width and height
  picture: null, // the last whole answer: {blob, keys}
  example: '',
  word: '', // said beside a picture without a fault
};

const listeners = [];
const onRest = (listener) => listeners.push(listener);

// Keys that make several views, of which only the first picture would move.
const SEVERAL = ['views', 'turntable', 'orbit', 'animate', 'sheet'];
const isSeveral = () => SEVERAL.some((key) => state.scene[key] !== undefined);
const isMovie = () => isSeveral() && state.scene.sheet === undefined;
const canMove = () => !isSeveral();

function say(text, isBad = false) {
  const note = byId('note');
  note.textContent = text;
  note.hidden = !text;
  note.classList.toggle('bad', isBad);
}

// Texts before changes by controls; the browser undoes what was typed.
const past = [];

function undo() {
  if (!past.length) return;
  state.text = '';
  setText(past.pop());
  refresh();
}

// Takes a new text. `isOwn`: the page wrote it, and the camera stays.
function setText(text, isOwn = false) {
  if (state.text && state.text !== text && byId('text').value !== text) past.push(state.text);
  if (past.length > 100) past.shift();
  state.text = text;
  state.word = '';
  const scene = parsed(text);
  state.isValid = scene !== null;
  if (scene) state.scene = scene;
  if (!isOwn) {
    state.version++;
    state.camera = null;
    state.info = null;
    if (state.version > 1) for (const canvas of byId('looks').querySelectorAll('canvas')) canvas.classList.add('failed');
  }
  showText();
  showControls();
}

// Changes keys of the text, as a control does. `isMoving`: a slider, whose pictures are rough.
function setKeys(changes, isMoving = false) {
  if (!state.isValid) {
    say('The text is not valid JSON. Correct it first.', true);
    return;
  }
  const moved = state.camera && motion.is ? { view: viewOf(state.camera) } : {};
  setText(withKeys(state.text, { ...moved, ...changes }));
  refresh(isMoving && canMove());
}

const FACTS = '?channel=info&render=false';

async function loadInfo(signal) {
  const version = state.version;
  if (!state.info) {
    const answer = await render(state.text, pictureKeys(), FACTS, signal);
    const info = JSON.parse(await answer.blob.text());
    if (version === state.version) state.info = info;
  }
  return state.info;
}
