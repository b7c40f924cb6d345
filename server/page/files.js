// Files: opened or dropped. A scene becomes the text; a model becomes a scene of a few lines. FORMATS: formats.h.

const formatOf = (file) => FORMATS.find(({ ending }) => file.name.toLowerCase().endsWith('.' + ending));

async function openFiles(list) {
  const opened = [...list];
  const scene = opened.find((file) => formatOf(file)?.isScene);
  const model = opened.find((file) => formatOf(file)?.isScene === false);
  if (!scene && !model) {
    say(`These files hold no scene or model. Their endings are ${FORMATS.map(({ ending }) => '.' + ending).join(', ')}.`, true);
    return;
  }
  for (const file of opened) if (file !== scene) files.set(file.name, { blob: file, together: opened.length > 1 });
  bundle = { text: null };
  state.example = '';
  if (scene) {
    setText(await scene.text());
  } else {
    const name = model.name.replace(/\.[^.]*$/, '');
    setText(`{\n  "look": "studio",\n${formatOf(model).isZUp ? '  "up": "z",\n' : ''}  "meshes": [${toLine({ name, asset: model.name })}]\n}\n`);
  }
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
