// The lesson: an algorithm fills a window of 32 x 24 pixels step by step, as the renderer did it.

const LESSON_WINDOW = { width: 32, height: 24 };
const MOST_PRIMITIVES = 64; // that the renderer traces
const lesson = { algorithm: 'edgelist', trace: null, steps: [], at: 0, key: '', playing: 0 };

const keyOfLesson = () => lesson.algorithm + state.version + JSON.stringify(state.camera);

// The reason why a scene has no lesson; ''.
async function faultOfLesson(signal) {
  if (isSeveral()) return 'The lesson has one view.';
  const { counts } = await loadInfo(signal) || {};
  const most = counts ? counts.drawnWhole + counts.drawnPieces + counts.lines : 0;
  return most > MOST_PRIMITIVES ? `This scene has ${most.toLocaleString('en')} triangles in view, and the lesson takes ${MOST_PRIMITIVES}.` : '';
}

async function loadLesson(signal) {
  const changes = { ...pictureKeys(), window: LESSON_WINDOW, samples: 1, algorithm: lesson.algorithm, occlusion: false, groundShadow: false, edges: false, outputs: [{ channel: 'trace' }] };
  const answer = await render(state.text, changes, '', signal);
  lesson.trace = JSON.parse(await answer.blob.text());
  lesson.steps = stepsOf(lesson.trace);
  lesson.at = 0;
  byId('step').max = lesson.steps.length - 1;
  showStep();
}

const tableRow = (name, cells, properties) => el('tr', properties, ...cells.map((cell) => el(name, name === 'th' ? { scope: 'col' } : {}, String(cell))));

function showStep() {
  const step = lesson.steps[lesson.at], { trace } = lesson;
  if (!step) return;
  drawGrid(byId('lesson-grid'), trace, replay(trace, lesson.steps, lesson.at + 1), step);
  byId('step').value = lesson.at;
  byId('step').setAttribute('aria-valuetext', step.words);
  byId('lesson-words').textContent = step.words;
  byId('lesson-grid').setAttribute('aria-label', `The window of ${trace.window.width} by ${trace.window.height} pixels. ${step.words}`);
  const [first, last] = step.lines;
  byId('code').replaceChildren(...CODES[trace.algorithm].map((line, i) => el('span', { className: i >= first && i <= last ? 'lit' : '' }, line + '\n')));
  const { head, rows } = step.list || { head: [], rows: [] };
  byId('lists-head').replaceChildren(tableRow('th', head));
  byId('lists').replaceChildren(...rows.map(({ cells, isSeen }) => tableRow('td', cells, { className: isSeen ? 'seen' : '' })));
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

function chooseLesson(algorithm) {
  lesson.algorithm = algorithm;
  for (const button of byId('lesson-algorithms').children) button.setAttribute('aria-pressed', String(button.value === algorithm));
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
  for (const button of byId('lesson-algorithms').children) {
    button.onclick = () => {
      chooseLesson(button.value);
      rest();
    };
  }
  chooseLesson(lesson.algorithm);
}

onRest(async (signal) => {
  const isLesson = chosen === 'lesson' && state.isValid, missing = byId('lesson-missing');
  let fault = isLesson ? await faultOfLesson(signal) : '';
  if (isLesson && !fault && lesson.key !== keyOfLesson()) {
    play(false);
    try {
      await loadLesson(signal);
      lesson.key = keyOfLesson();
    } catch (error) {
      if (error.name === 'AbortError') throw error;
      fault = error.errors[0].detail;
    }
  }
  byId('lesson-body').hidden = !isLesson || Boolean(fault);
  missing.textContent = fault && `${fault} Choose one of the three scenes above, or write your own.`;
  missing.hidden = !fault;
  showStage();
});

// Shows grid and lists instead of the picture and its controls while the tab of the lesson is chosen.
function showStage() {
  const is = chosen === 'lesson' && lesson.key === keyOfLesson();
  for (const id of ['lesson-grid', 'lists-table']) byId(id).hidden = !is;
  for (const id of ['frame', 'facts', 'choices', 'look']) byId(id).hidden = is;
}
