// The pointer, touch and the keyboard on the picture.

const pointers = new Map();
let pinch = null, travelled = 0;

function shareOf(event) {
  const box = byId('frame').getBoundingClientRect();
  return [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
}

const middleOf = () => {
  const points = [...pointers.values()], count = points.length;
  const x = points.reduce((sum, point) => sum + point.x, 0) / count, y = points.reduce((sum, point) => sum + point.y, 0) / count;
  return { x, y, spread: count > 1 ? Math.hypot(points[0].x - points[1].x, points[0].y - points[1].y) : 0 };
};

function listenToPointer() {
  const frame = byId('frame');
  frame.onpointerdown = (event) => {
    if (event.button > 2) return;
    frame.setPointerCapture(event.pointerId);
    if (!pointers.size) travelled = 0;
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    pinch = middleOf();
  };
  frame.onpointermove = (event) => {
    if (!pointers.has(event.pointerId)) {
      hover(shareOf(event));
      return;
    }
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    const now = middleOf(), dx = now.x - pinch.x, dy = now.y - pinch.y, before = pinch;
    travelled += Math.abs(dx) + Math.abs(dy) + Math.abs(now.spread - before.spread);
    pinch = now;
    if (travelled < 4) return;
    const height = frame.clientHeight;
    move((camera) => {
      if (pointers.size > 1) {
        if (before.spread && now.spread) zoom(camera, now.spread / before.spread);
        pan(camera, dx / height, dy / height);
      } else if (event.buttons & 6 || event.shiftKey) {
        pan(camera, dx / height, dy / height);
      } else {
        orbit(camera, dx * 0.4, dy * 0.4);
      }
    });
  };
  const end = (event) => {
    if (!pointers.delete(event.pointerId)) return;
    if (pointers.size) pinch = middleOf();
    else if (event.type === 'pointerup' && travelled < 4 && event.button === 0 && !isSeveral()) pin(shareOf(event));
  };
  frame.onpointerup = end;
  frame.onpointercancel = end;
  frame.oncontextmenu = (event) => event.preventDefault();
  frame.ondblclick = () => setKeys({ view: undefined });
  frame.addEventListener('wheel', (event) => {
    if (!canMove() || event.ctrlKey) return;
    event.preventDefault();
    move((camera) => zoom(camera, Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0015))));
  }, { passive: false });
}

const PRESETS = ['front', 'back', 'left', 'right', 'top', 'bottom', 'isometric'];

function movePin(right, down) {
  const { width, height } = pictureSize(), [x, y] = state.pin || [0.5, 0.5];
  pin([Math.max(0, Math.min(0.9999, x + right / width)), Math.max(0, Math.min(0.9999, y + down / height))]);
}

function preset(name) {
  const camera = state.camera || state.info && cameraOf(state.info);
  setKeys({ view: { preset: name, ...(camera && camera.isPerspective ? { perspective: { yfovDegrees: round(camera.yfov, 4) } } : {}) } });
}

function listenToKeys() {
  addEventListener('keydown', (event) => {
    // In the text, the browser undoes typing as long as the last change was typed.
    const isTyped = event.target.id === 'text' && typed === state.text;
    if (!(event.ctrlKey || event.metaKey) || event.shiftKey || event.key !== 'z' || isTyped || event.target.tagName === 'INPUT') return;
    event.preventDefault();
    undo();
  });
  byId('frame').addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey) return;
    const arrow = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    const index = '1234567'.indexOf(event.key);
    if (arrow && event.altKey) movePin(...arrow);
    else if (event.altKey) return;
    else if (arrow && event.shiftKey) move((camera) => pan(camera, arrow[0] * 0.05, arrow[1] * 0.05));
    else if (arrow) move((camera) => orbit(camera, arrow[0] * 5, arrow[1] * 5));
    else if (event.key === '+' || event.key === '=') move((camera) => zoom(camera, 1.1));
    else if (event.key === '-') move((camera) => zoom(camera, 1 / 1.1));
    else if (event.key === '0') setKeys({ view: undefined });
    else if (index >= 0 && event.key.length === 1) preset(PRESETS[index]);
    else if (event.key === '[') nextLook(-1);
    else if (event.key === ']') nextLook(1);
    else if (event.key === 'c') setChannel(CHANNELS[(CHANNELS.findIndex(([name]) => name === state.channel) + 1) % CHANNELS.length][0]);
    else if (event.key === 'Enter') pin(state.pin || [0.5, 0.5]);
    else if (event.key === 'Escape') pin(null);
    else if (event.key === 'o') byId('file').click();
    else if (event.key === '?') byId('help-dialog').showModal();
    else return;
    event.preventDefault();
  });
}
