// Tabs of the panel, buttons of views, and dialogs.

const TABS = ['model', 'scene', 'channels', 'algorithms', 'pixel', 'lesson'];
let chosen = 'model';

// Arrow keys move within a list of tabs, and the tab that gets the focus is chosen (ARIA, tabs).
function roving(list, choose) {
  list.addEventListener('keydown', (event) => {
    const tabs = [...list.children], at = tabs.indexOf(document.activeElement);
    const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
    const to = event.key === 'Home' ? 0 : event.key === 'End' ? tabs.length - 1 : step ? (at + step + tabs.length) % tabs.length : -1;
    if (to < 0 || at < 0) return;
    event.preventDefault();
    choose(tabs[to]);
    tabs[to].focus();
  });
}

function choose(name) {
  chosen = name;
  for (const tab of TABS) {
    const is = tab === name, button = byId('tab-' + tab);
    button.setAttribute('aria-selected', String(is));
    button.tabIndex = is ? 0 : -1;
    byId('panel-' + tab).hidden = !is;
  }
  showStage();
  if (!isPumping && !motion.is) rest();
}

const VIEWS = {
  one: {},
  sheet: { sheet: 'balanced' },
  three: { sheet: 'threeView' },
  turntable: { turntable: { frames: 24 } },
};

// Which of the buttons says what the text has.
function viewsOf(scene) {
  if (scene.sheet === 'balanced') return 'sheet';
  if (scene.sheet === 'threeView') return 'three';
  if (scene.turntable && scene.sheet === undefined) return 'turntable';
  return SEVERAL.some((key) => scene[key] !== undefined) ? '' : 'one';
}

function setViews(name) {
  const none = Object.fromEntries(SEVERAL.map((key) => [key, undefined]));
  state.channel = 'color';
  setKeys({ ...none, ...VIEWS[name] });
}

const marksOf = (scene) => Array.isArray(scene.annotate) ? scene.annotate : [];

// Switches one of the marks over the picture on or off.
function setMark(word) {
  const marks = MARKS.filter((mark) => marksOf(state.scene).includes(mark) !== (mark === word));
  setKeys({ annotate: marks.length ? marks : undefined });
}

function showControls() {
  showLook();
  showModel();
  const views = viewsOf(state.scene);
  for (const button of byId('views').children) button.setAttribute('aria-pressed', String(button.value === views));
  for (const button of byId('marks').children) button.setAttribute('aria-pressed', String(marksOf(state.scene).includes(button.value)));
  for (const input of byId('channel-cards').querySelectorAll('input')) input.checked = input.value === state.channel;
  byId('example').value = state.example;
  byId('frame').classList.toggle('moves', canMove());
}

function setTheme(theme) {
  document.documentElement.style.colorScheme = theme;
  byId('theme').setAttribute('aria-pressed', String(theme === 'dark'));
}

const isDark = () => (document.documentElement.style.colorScheme || (matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light')) === 'dark';

function listenToTabs() {
  for (const tab of TABS) byId('tab-' + tab).onclick = () => choose(tab);
  roving(byId('tabs'), (tab) => choose(tab.id.slice(4)));
  for (const button of byId('views').children) button.onclick = () => setViews(button.value);
  byId('marks').replaceChildren(...MARKS.map((word) => el('button', { type: 'button', value: word }, word)));
  for (const button of byId('marks').children) button.onclick = () => setMark(button.value);
  for (const dialog of document.querySelectorAll('dialog')) {
    for (const button of dialog.querySelectorAll('.close')) button.onclick = () => dialog.close();
    dialog.onclick = (event) => { if (event.target === dialog && dialog.id !== 'token') dialog.close(); };
  }
  byId('help').onclick = () => byId('help-dialog').showModal();
  byId('theme').onclick = () => setTheme(isDark() ? 'light' : 'dark');
  setTheme(isDark() ? 'dark' : 'light');
}
