// Files: opened or dropped. A scene becomes the text; a model becomes a scene of a few lines. FORMATS: formats.h.

const formatOf = (file) => FORMATS.find(({ ending }) => file.name.toLowerCase().endsWith('.' + ending));

// Models with the same upward axis as the first one become one scene. Files that a fault or a warning names are only added.
async function openFiles(list) {
  const opened = [...list], isAsked = opened.some(({ name }) => faults.some(({ detail }) => detail.split(/'(mtllib |map_Kd )?/).includes(name)));
  const known = opened.filter(formatOf), scene = known.find((file) => formatOf(file).isScene);
  if (!known.length && !isAsked) {
    say(`These files hold no scene or model. Their endings are ${FORMATS.map(({ ending }) => '.' + ending).join(', ')}. Of a folder, open the files in it. Archives (.zip) are for the command and the daemon.`, true);
    return;
  }
  let { text } = state;
  if (scene) {
    text = await scene.text();
  } else if (!isAsked) {
    const { isZUp } = formatOf(known[0]);
    const meshes = known.filter((file) => formatOf(file).isZUp === isZUp).map(({ name }) => toLine({ name: name.replace(/\.[^.]*$/, ''), asset: name }));
    text = `{\n  "look": "studio",\n${isZUp ? '  "up": "z",\n' : ''}  "meshes": [${meshes.join(',\n    ')}]\n}\n`;
  }
  for (const file of opened) if (file !== scene) files.set(file.name, { blob: file, together: isAsked || opened.length > 1 });
  if (isAsked) for (const name of copiedNames()) if (files.has(name)) files.get(name).together = true;
  bundle = { text: null };
  state.example = '';
  setText(text);
  const [taken, left] = [true, false].map((is) => opened.filter((file) => (known.includes(file) || /\.zip$/i.test(file.name)) &&
    (file === scene || copiedNames().includes(file.name)) === is).map(({ name }) => name).join(', '));
  if (left) state.word = `Opened: ${taken}. Left out: ${left}.`;
  state.channel = 'color';
  refresh();
}

function listenForFiles() {
  byId('file').onchange = (event) => {
    if (event.target.files.length) openFiles(event.target.files);
    event.target.value = '';
  };
  byId('open').onclick = () => byId('file').click();
  addEventListener('dragover', (event) => {
    event.preventDefault();
    document.body.classList.add('dropping');
  });
  addEventListener('dragleave', (event) => {
    if (!event.relatedTarget) document.body.classList.remove('dropping');
  });
  addEventListener('drop', (event) => {
    event.preventDefault();
    document.body.classList.remove('dropping');
    if (event.dataTransfer.files.length) openFiles(event.dataTransfer.files);
  });
}

// Opens an example. On a dark page the first one has the dark look.
async function openExample(name) {
  try {
    const response = await call('v1/examples/' + encodeURIComponent(name));
    const text = await response.text();
    state.example = name;
    state.channel = 'color';
    state.pin = null;
    setText(isFirst && matchMedia('(prefers-color-scheme: dark)').matches ? withKeys(text, { look: 'dark' }) : text);
    refresh(isFirst && !isSeveral());
  } catch (error) {
    showErrors(error);
  }
}
