// The start: the lists of looks and examples, the scene of the link or the first example, its picture.

async function start() {
  listenForFiles();
  listenToText();
  listenToTabs();
  listenToPointer();
  listenToKeys();
  listenToCopy();
  listenToLesson();
  listenToModel();
  buildChannels();
  let sized = 0;
  new ResizeObserver(() => {
    fitStage();
    clearTimeout(sized);
    sized = setTimeout(() => {
      if (state.picture && !state.scene.window && state.picture.keys.window.width !== pictureKeys().window.width) refresh();
    }, 200);
  }).observe(byId('stage'));
  addEventListener('hashchange', async () => {
    const text = await textOfLink();
    if (text) {
      state.example = '';
      setText(text);
      refresh();
    }
  });
  const text = await textOfLink();
  if (text !== null) byId('poster')?.remove();
  const lists = [call('v1/looks'), call(HAS_DAEMON ? 'v1/examples' : 'v1/examples/index.json')].map(async (answer) => (await answer).json());
  try {
    const first = text === null ? openExample('bearing') : null;
    const [looksList, examplesList] = await Promise.all(lists);
    looks = looksList.looks;
    byId('example').append(...examplesList.examples.map(({ name, title }) => el('option', { value: name }, title)));
    byId('example').onchange = (event) => { if (event.target.value) openExample(event.target.value); };
    buildLooks();
    await first;
    if (text !== null) {
      setText(text);
      refresh(!isSeveral());
    }
    showControls();
    if (!isPumping) rest();
  } catch (error) {
    showErrors(error);
  }
}

if (HAS_DAEMON && HAS_ENGINE) onRest(() => openEngine().catch(() => {})); // so that it is there when the model turns
if (!HAS_DAEMON && 'serviceWorker' in navigator) navigator.serviceWorker.register('offline.js').catch(() => {});
start();
