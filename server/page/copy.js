// The picture as a command, a program or a link that draws it again, byte for byte.

const quoted = (text) => /^[\w.:/@%+=-]+$/.test(text) ? text : `'${text.replace(/'/g, "'\\''")}'`;

// The scene with the keys that the page adds for this picture.
function copiedScene() {
  const text = state.isValid ? withKeys(state.text, pictureKeys()) : state.text;
  return text.endsWith('\n') ? text : text + '\n';
}

const copiedNames = () => state.isValid ? [...new Set(assetsOf(state.text).map(({ name }) => name))] : [];

function downloads(names) {
  const examples = names.filter((name) => (files.get(name) || {}).isExample);
  return examples.length ? `curl -s${examples.map((name) => ` -O ${new URL('v1/examples/' + encodeURIComponent(name), location.href)}`).join('')}\n` : '';
}

const COPIES = {
  curl: () => copyCurl(),
  command() {
    const names = copiedNames();
    const parts = names.map((name) => ` --part ${quoted(`${name}=${name}`)}`).join('');
    const encoding = isMovie() ? ' -c color --encoding apng' : state.scene.outputs ? ' -c color' : '';
    return `${downloads(names)}zraster - picture.png${encoding}${parts} <<'END'\n${copiedScene()}END\n`;
  },
  python() {
    const names = copiedNames(), examples = names.filter((name) => (files.get(name) || {}).isExample);
    const fetches = examples.length ? `import urllib.request\n` : '';
    const lines = examples.map((name) => `urllib.request.urlretrieve(${JSON.stringify(new URL('v1/examples/' + encodeURIComponent(name), location.href).href)}, ${JSON.stringify(name)})\n`).join('');
    const options = isMovie() ? ', encoding="apng"' : state.scene.outputs ? ', "color"' : '';
    return `import pathlib\n${fetches}\nimport zraster\n\n${lines}pathlib.Path("scene.json").write_text(r"""\n${copiedScene()}""")\nzraster.render("scene.json"${options}).save("picture.${isMovie() ? 'apng' : 'png'}")\n`;
  },
  json: () => copiedScene(),
};

let copyKind = HAS_DAEMON ? 'curl' : 'command';

async function showCopy(kind) {
  copyKind = kind;
  for (const tab of byId('copy-tabs').children) {
    tab.setAttribute('aria-selected', String(tab.value === kind));
    tab.tabIndex = tab.value === kind ? 0 : -1;
  }
  byId('copy-panel').setAttribute('aria-labelledby', 'copy-' + kind);
  byId('copied').textContent = '';
  const text = kind === 'link' ? await linkOf(state.text) || 'This scene is too long for a link.' : COPIES[kind]();
  if (copyKind === kind) byId('copied').textContent = text;
  byId('copy-do').textContent = 'Copy';
}

async function copyNow() {
  const text = byId('copied').textContent;
  try {
    await navigator.clipboard.writeText(text);
    byId('copy-do').textContent = 'Copied';
  } catch {
    // Without https there is no clipboard: select, so that Ctrl+C copies.
    getSelection().selectAllChildren(byId('copied'));
    byId('copy-do').textContent = 'Selected: press Ctrl+C';
  }
}

function listenToCopy() {
  byId('copy').onclick = () => {
    byId('copy-dialog').showModal();
    showCopy(copyKind);
  };
  for (const tab of byId('copy-tabs').children) tab.onclick = () => showCopy(tab.value);
  roving(byId('copy-tabs'), (tab) => showCopy(tab.value));
  byId('copy-do').onclick = copyNow;
  byId('save').onclick = () => {
    if (!state.picture) return;
    const link = el('a', { href: URL.createObjectURL(state.picture.blob), download: 'picture.png' });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  };
}
