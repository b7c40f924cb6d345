// Files: opened or dropped. A scene becomes the text; a model becomes a scene of a few lines.

const MODELS = /\.(obj|stl|ply|glb|gltf|3mf|zip)$/i;

async function openFiles(list) {
  const opened = [...list];
  const scene = opened.find((file) => /\.json$/i.test(file.name));
  const model = opened.find((file) => MODELS.test(file.name));
  if (!scene && !model) {
    say('These files hold no scene or model: JSON, OBJ, STL, PLY, glTF, 3MF or ZIP.', true);
    return;
  }
  for (const file of opened) if (file !== scene) files.set(file.name, { blob: file, together: opened.length > 1 });
  bundle = { text: null };
  state.example = '';
  if (scene) {
    setText(await scene.text());
  } else {
    const name = model.name.replace(/\.[^.]*$/, '');
    const isZUp = /\.(stl|3mf)$/i.test(model.name);
    setText(`{\n  "look": "studio",\n${isZUp ? '  "up": "z",\n' : ''}  "meshes": [${toLine({ name, asset: model.name })}]\n}\n`);
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

async function openExample(name) {
  try {
    const response = await call('v1/examples/' + encodeURIComponent(name));
    const text = await response.text();
    state.example = name;
    state.channel = 'color';
    state.pin = null;
    setText(text);
    refresh(isFirst && !isSeveral());
  } catch (error) {
    showErrors(error);
  }
}
