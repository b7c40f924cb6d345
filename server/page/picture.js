// The picture: one request in flight; rough while it moves, whole at rest.

const REST_MS = 160;
const SLOW_MS = HAS_ENGINE ? 22 : 45, FAST_MS = HAS_ENGINE ? 13 : 18; // of a rough picture: the next is smaller, or larger
const STEPS = [
  { samples: 4, scale: 1 },
  { samples: 1, scale: 1 },
  { samples: 1, scale: 1, plain: true },
  { samples: 1, scale: 0.75, plain: true },
  { samples: 1, scale: 0.5, plain: true },
];
const motion = { is: false, step: 1, mean: (SLOW_MS + FAST_MS) / 2, timer: 0, waiting: false, frames: 0 };
let isFirst = true; // the first picture is a rough one, which is there sooner
let pending = null, isPumping = false, whole = null, idle = new AbortController();

// Pixels of the window: the scene's, or those of the screen, up to 1600 wide.
function pictureSize() {
  const given = state.scene.window;
  if (given && given.width > 0 && given.height > 0) return { width: given.width, height: given.height, isGiven: true };
  const room = byId('stage').clientWidth;
  const high = Math.max(220, Math.min(room * 0.75, Math.max(300, innerHeight - 270)));
  const density = Math.min(devicePixelRatio || 1, 1600 / room);
  return { width: Math.round(room * density), height: Math.round(high * density) };
}

// Keys that the page adds to a text for its picture.
function pictureKeys() {
  const size = pictureSize(), changes = {};
  if (!size.isGiven) {
    const scale = isMovie() ? Math.min(1, 480 / size.width) : 1;
    changes.window = { width: Math.round(size.width * scale), height: Math.round(size.height * scale) };
  }
  if (state.camera) changes.view = viewOf(state.camera);
  return changes;
}

const pictureQuery = () => isMovie() ? '?channel=color&encoding=apng' : state.scene.outputs ? '?channel=color' : '';

function roughKeys() {
  const step = STEPS[motion.step], size = pictureSize();
  const changes = pictureKeys();
  changes.window = { width: Math.max(1, Math.round(size.width * step.scale)), height: Math.max(1, Math.round(size.height * step.scale)) };
  const samples = state.scene.samples;
  if (!(samples <= step.samples)) changes.samples = step.samples;
  if (step.plain) {
    changes.occlusion = false;
    if (/^(technical|blueprint)/.test(state.scene.look || '')) changes.edges = { from: 'samples' };
  }
  return changes;
}

// Chooses the step of the next rough picture: without occlusion first, then smaller, if much of the time is drawing.
function adapt(answer) {
  motion.mean += 0.3 * (answer.ms - motion.mean);
  if (motion.mean > SLOW_MS && answer.drawn > answer.ms / 4 && motion.step < STEPS.length - 1) {
    motion.step++;
    motion.mean = (SLOW_MS + FAST_MS) / 2;
  } else if (motion.mean < FAST_MS && motion.step > 0) {
    motion.step--;
    motion.mean = (SLOW_MS + FAST_MS) / 2;
  }
}

// Asks for a whole picture now, or for a rough one; of broken JSON for its fault.
function refresh(isRough = false) {
  if (!isRough) idle.abort();
  pending = state.isValid && { isRough };
  if (whole) whole.abort();
  if (pending) pump();
  else checkSyntax();
}

async function pump() {
  if (isPumping) return;
  isPumping = true;
  while (pending) {
    const job = pending;
    pending = null;
    try {
      await drawOnce(job);
    } catch (error) {
      if (error.name !== 'AbortError') showErrors(error);
    }
  }
  isPumping = false;
  byId('stage').classList.remove('busy');
  if (isFirst) {
    isFirst = false;
    refresh();
    return;
  }
  if (!motion.is && !pending && !state.isRefused) rest();
}

async function drawOnce({ isRough }) {
  const version = state.version, channel = state.channel;
  const controller = new AbortController();
  whole = isRough ? null : controller;
  const timer = setTimeout(() => byId('stage').classList.add('busy'), 400);
  try {
    const changes = isRough ? roughKeys() : pictureKeys();
    if (channel !== 'color' && !isSeveral()) {
      await showChannel(channel, changes, controller.signal);
      showErrors(null);
      return;
    }
    const hasFacts = !isRough && !state.info && !isSeveral();
    const query = hasFacts ? '' : isRough ? '?channel=color' : pictureQuery();
    const outputs = hasFacts ? { outputs: [{ channel: 'color' }, { channel: 'info' }] } : {};
    const answer = await render(state.text, { ...changes, ...outputs }, query, controller.signal, isRough);
    if (version !== state.version) return;
    if (hasFacts) state.info = JSON.parse(await answer.parts.get('info').text());
    await show(answer);
    motion.frames++;
    document.documentElement.dataset.drawn = String(motion.frames);
    if (isRough) {
      adapt(answer);
    } else {
      const { width, height } = changes.window || state.scene.window;
      state.picture = { blob: answer.blob, keys: changes };
      byId('time').textContent = `${width} × ${height} · ${Math.round(answer.ms)} ms`;
      byId('time').title = `drawn in ${answer.drawn.toFixed(1)} ms, ${answer.blob.size.toLocaleString('en')} bytes`;
      showErrors(null, answer.warnings);
      showPin();
      document.documentElement.dataset.pictures = String(Number(document.documentElement.dataset.pictures || 0) + 1);
    }
  } finally {
    clearTimeout(timer);
    whole = null;
  }
}

let movieUrl = '';

async function show({ blob, image }) {
  byId('poster')?.remove();
  const canvas = byId('picture'), movie = byId('movie'), is = isMovie();
  if (is) {
    if (movieUrl) URL.revokeObjectURL(movieUrl);
    movieUrl = URL.createObjectURL(blob);
    movie.src = movieUrl;
    await movie.decode();
  } else {
    const drawn = image || await createImageBitmap(blob), context = canvas.getContext('2d');
    if (canvas.width !== drawn.width || canvas.height !== drawn.height) {
      canvas.width = drawn.width;
      canvas.height = drawn.height;
    }
    if (image) context.putImageData(image, 0, 0);
    else context.drawImage(drawn, 0, 0);
    if (!image) drawn.close();
  }
  movie.hidden = !is;
  canvas.classList.toggle('covered', is);
  fitStage();
}

function fitStage() {
  const { width, height } = pictureSize(), room = byId('stage').clientWidth;
  const scale = Math.min(room / width, Math.max(300, innerHeight - 270) / height);
  byId('frame').style.width = Math.floor(width * scale) + 'px';
  byId('frame').style.aspectRatio = `${width} / ${height}`;
}

// ---- moves ----

// Moves the camera by a function of it.
async function move(change) {
  if (!state.isValid || !canMove()) return;
  if (!state.camera) {
    if (motion.waiting) return;
    motion.waiting = true;
    try {
      const info = await loadInfo();
      state.camera = info && cameraOf(info);
    } catch (error) {
      if (error.name !== 'AbortError') showErrors(error);
    }
    motion.waiting = false;
    if (!state.camera) return;
  }
  change(state.camera);
  if (!motion.is) idle.abort();
  motion.is = true;
  clearTimeout(motion.timer);
  motion.timer = setTimeout(settle, REST_MS);
  refresh(true);
}

// The text follows at rest.
function settle() {
  motion.is = false;
  if (!state.camera || !state.isValid) return;
  setText(withKeys(state.text, { view: viewOf(state.camera) }), true);
  state.example = '';
  refresh();
}

// ---- work at rest: looks, channels, the pixel; one after the other, until something moves ----

async function rest() {
  idle.abort();
  idle = new AbortController();
  const { signal } = idle;
  for (const listener of listeners) {
    if (signal.aborted) return;
    try {
      await listener(signal);
    } catch (error) {
      if (error.name === 'AbortError') return;
    }
  }
}
