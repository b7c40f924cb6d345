// The lesson: how lists of edges and a z-buffer fill a window of 32 x 24, row by row. After each polygon, ids and depths are
// those of the daemon for the scene up to that polygon; the page computes the crossings only.

const LESSON = { width: 32, height: 24, cell: 30, most: 24 };
const CODE = [
  'for each polygon',
  '  for each edge',
  '    for each row whose middle it crosses',
  '      put the x of the crossing into its list',
  '  for each row with a list',
  '    sort the list',
  '    for each pixel between two x, pair by pair',
  '      z = depth of the polygon there',
  '      if z is less than depths[row][pixel]',
  '        depths[row][pixel] = z',
  '        picture[row][pixel] = its colour',
];
const lesson = { steps: [], at: 0, states: [], corners: [], key: '', playing: 0 };

const isLessonScene = (scene) => Array.isArray(scene.polygons) && !scene.meshes && !isSeveral() &&
  scene.polygons.length > 0 && scene.polygons.length <= LESSON.most && scene.polygons.every((polygon) => Array.isArray(polygon.vertices) && !polygon.holes);

// Corners in the window, on the grid of 1/256 pixel; null if one is behind the eye.
function project(vertices, camera) {
  const { worldToCamera: w, projectionMatrix: p } = camera;
  const apply = (m, v) => [0, 1, 2, 3].map((row) => v.reduce((sum, value, column) => sum + at4(m, row, column) * value, 0));
  const points = vertices.map(([x, y, z, last = 1]) => apply(p, apply(w, [x, y, z, last])));
  if (points.some((point) => point[3] <= 0)) return null;
  const snap = (value) => Math.round(value * 256) / 256;
  return points.map(([x, y, , last]) => [snap((x / last + 1) * LESSON.width / 2), snap((1 - y / last) * LESSON.height / 2)]);
}

// The list of a row: x of the edges that cross its middle, sorted.
function crossings(corners, row) {
  const y = row + 0.5, list = [];
  corners.forEach(([x0, y0], i) => {
    const [x1, y1] = corners[(i + 1) % corners.length];
    if ((y0 <= y) !== (y1 <= y)) list.push(x0 + (y - y0) * (x1 - x0) / (y1 - y0));
  });
  return list.sort((a, b) => a - b);
}

async function loadLesson(signal) {
  const text = state.text, { width, height } = LESSON, plain = { window: { width, height }, samples: 1, outputs: undefined };
  const info = JSON.parse(await (await render(text, plain, FACTS, signal)).blob.text());
  const { worldToCamera, projectionMatrix } = info.camera;
  const polygons = state.scene.polygons;
  const empty = { ids: new Uint32Array(width * height), depths: new Float32Array(width * height).fill(Infinity) };
  const states = [empty];
  for (let k = 1; k <= polygons.length; k++) {
    const changes = { ...plain, algorithm: 'edgelist', view: { worldToCamera, projectionMatrix }, polygons: polygons.slice(0, k) };
    const ids = await npy((await render(text, changes, '?channel=faceId', signal)).blob);
    states.push({ ids, depths: await npy((await render(text, changes, '?channel=depth', signal)).blob) });
  }
  lesson.states = states;
  lesson.corners = polygons.map((polygon) => project(polygon.vertices, info.camera));
  lesson.steps = [{ polygon: 0, row: -1 }];
  lesson.corners.forEach((corners, i) => {
    if (!corners) return;
    lesson.steps.push({ polygon: i + 1, row: -1 });
    for (let row = 0; row < height; row++) {
      const xs = crossings(corners, row);
      if (xs.length) lesson.steps.push({ polygon: i + 1, row, xs });
    }
  });
  lesson.steps.push({ polygon: polygons.length, row: height, isEnd: true });
  lesson.at = 0;
  byId('step').max = lesson.steps.length - 1;
  showStep();
}

// Ids and depths at a step: rows above the current one are done.
function heldAt(step, x, y) {
  const at = y * LESSON.width + x;
  const isDone = step.polygon > 0 && y <= step.row;
  const held = lesson.states[isDone ? step.polygon : Math.max(0, step.polygon - 1)];
  return { id: held.ids[at], depth: held.depths[at] };
}

// The pixels of a row between its crossings: written or lost.
function pixelsOf(step) {
  const out = [];
  for (let i = 0; step.xs && i + 1 < step.xs.length; i += 2) {
    for (let x = Math.max(0, Math.ceil(step.xs[i] - 0.5)); x + 0.5 < step.xs[i + 1] && x < LESSON.width; x++) {
      out.push({ x, isWritten: lesson.states[step.polygon].ids[step.row * LESSON.width + x] === step.polygon });
    }
  }
  return out;
}

function colorOf(id) {
  const color = (state.scene.polygons[id - 1] || {}).color;
  return typeof color === 'string' && /^#[0-9a-f]{6}$/i.test(color) ? color : PALETTE[(id - 1) % PALETTE.length];
}

function drawStep(step) {
  const canvas = byId('lesson-grid'), { width, height, cell } = LESSON;
  canvas.width = width * cell;
  canvas.height = height * cell;
  const context = canvas.getContext('2d');
  context.fillStyle = '#fff';
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.font = '10.5px system-ui, sans-serif';
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  for (let y = 0; y < height; y++) {
    for (let x = 0; x < width; x++) {
      const { id, depth } = heldAt(step, x, y);
      context.strokeStyle = '#dfe5ea';
      if (id) {
        context.fillStyle = colorOf(id);
        context.fillRect(x * cell, y * cell, cell, cell);
        context.strokeStyle = '#ffffff80';
      }
      context.lineWidth = 1;
      context.strokeRect(x * cell + 0.5, y * cell + 0.5, cell, cell);
      if (!id) continue;
      const [r, g, b] = rgb(colorOf(id));
      context.fillStyle = 0.3 * r + 0.6 * g + 0.1 * b > 120 ? '#000' : '#fff';
      context.fillText(depth.toFixed(1), (x + 0.5) * cell, (y + 0.5) * cell + 1);
    }
  }
  const corners = lesson.corners[step.polygon - 1];
  if (corners && !step.isEnd) {
    context.strokeStyle = '#1a232d';
    context.lineWidth = 2;
    context.beginPath();
    corners.forEach(([x, y]) => context.lineTo(x * cell, y * cell));
    context.closePath();
    context.stroke();
  }
  if (step.xs) {
    for (const { x, isWritten } of pixelsOf(step)) {
      context.strokeStyle = isWritten ? '#fff' : '#000';
      context.lineWidth = 2.5;
      context.strokeRect(x * cell + 3.5, step.row * cell + 3.5, cell - 6, cell - 6);
    }
    context.strokeStyle = '#d0245c';
    context.lineWidth = 2;
    context.strokeRect(1, step.row * cell, canvas.width - 2, cell);
    context.fillStyle = '#d0245c';
    for (const x of step.xs) {
      context.beginPath();
      context.arc(x * cell, (step.row + 0.5) * cell, 5, 0, 7);
      context.fill();
    }
  }
}

function wordsOf(step) {
  if (step.polygon === 0) return 'The window is empty: each depth is infinite.';
  if (step.isEnd) return 'Done. Each pixel holds the nearest polygon, whatever the order of the polygons.';
  if (!step.xs) return `Polygon ${step.polygon}: each edge adds its crossings to the lists of the rows, below.`;
  const pixels = pixelsOf(step), written = pixels.filter((pixel) => pixel.isWritten).length, lost = pixels.length - written;
  const spans = [];
  for (let i = 0; i + 1 < step.xs.length; i += 2) spans.push(`${step.xs[i].toFixed(2)} to ${step.xs[i + 1].toFixed(2)}`);
  return `Polygon ${step.polygon}, row ${step.row}, x from ${spans.join(' and from ')}: ${written} ${written === 1 ? 'pixel is' : 'pixels are'} nearer and written, ` +
    `${lost} ${lost === 1 ? 'is' : 'are'} behind and ${lost === 1 ? 'stays as it is' : 'stay as they are'}.`;
}

function showStep() {
  const step = lesson.steps[lesson.at];
  if (!step) return;
  drawStep(step);
  const words = wordsOf(step);
  byId('step').value = lesson.at;
  byId('step').setAttribute('aria-valuetext', words);
  byId('lesson-words').textContent = words;
  byId('lesson-grid').setAttribute('aria-label', 'The window of 32 by 24 pixels. ' + words);
  const lit = step.isEnd || step.polygon === 0 ? [-1, -1] : step.xs ? [4, 10] : [1, 3];
  byId('code').replaceChildren(...CODE.map((line, i) => el('span', { className: i >= lit[0] && i <= lit[1] ? 'lit' : '' }, line + '\n')));
  const corners = lesson.corners[step.polygon - 1], rows = [];
  for (let row = 0; corners && !step.isEnd && row < LESSON.height; row++) {
    if (step.xs && Math.abs(row - step.row) > 4) continue;
    const xs = crossings(corners, row);
    if (xs.length) rows.push(el('tr', { className: row === step.row ? 'seen' : '' }, el('td', {}, String(row)), el('td', {}, xs.map((x) => x.toFixed(3)).join('  '))));
  }
  byId('lists').replaceChildren(...rows);
  byId('lists-table').hidden = !rows.length;
}

function goTo(step) {
  lesson.at = Math.max(0, Math.min(lesson.steps.length - 1, step));
  showStep();
}

function play(is) {
  clearInterval(lesson.playing);
  lesson.playing = is ? setInterval(() => {
    if (lesson.at >= lesson.steps.length - 1) play(false);
    else goTo(lesson.at + 1);
  }, 450) : 0;
  byId('play').textContent = is ? 'Pause' : 'Play';
}

function listenToLesson() {
  byId('step').oninput = (event) => goTo(Number(event.target.value));
  byId('step-back').onclick = () => goTo(lesson.at - 1);
  byId('step-on').onclick = () => goTo(lesson.at + 1);
  byId('play').onclick = () => {
    if (!lesson.playing && lesson.at >= lesson.steps.length - 1) lesson.at = 0;
    play(!lesson.playing);
  };
  for (const button of byId('lesson-scenes').querySelectorAll('button')) button.onclick = () => openExample(button.value);
}

onRest(async (signal) => {
  const isLesson = chosen === 'lesson' && state.isValid, fits = isLesson && isLessonScene(state.scene);
  byId('lesson-body').hidden = !fits;
  byId('lesson-missing').hidden = fits || !isLesson;
  showStage();
  if (!fits) return;
  if (lesson.key !== state.text) {
    play(false);
    await loadLesson(signal);
    lesson.key = state.text;
  }
  showStage();
});

// The grid stands in for the picture while its tab is chosen.
function showStage() {
  const is = chosen === 'lesson' && lesson.key === state.text && isLessonScene(state.scene);
  byId('lesson-grid').hidden = !is;
  byId('frame').hidden = is;
  byId('facts').hidden = is;
}
