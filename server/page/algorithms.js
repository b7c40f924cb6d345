// Five hidden-surface algorithms, compared by time and by bytes.

const ALGORITHMS = [
  ['halfspace', 'Half-spaces, tile by tile'],
  ['edgelist', 'Lists of edges and a z-buffer'],
  ['trapezoid', 'Trapezoids and a z-buffer'],
  ['scanline', 'Scan lines over all polygons'],
  ['painter', 'Depth sort, far to near'],
];
let comparedAlgorithms = '';

const same = (a, b) => a.length === b.length && a.every((byte, i) => byte === b[i]);

onRest(async (signal) => {
  const key = state.version + JSON.stringify(state.camera);
  if (chosen !== 'algorithms' || comparedAlgorithms === key || !state.isValid) return;
  const rows = [], body = byId('algorithm-rows');
  byId('algorithms-verdict').textContent = 'Drawing…';
  for (const [algorithm, title] of ALGORITHMS) {
    const changes = { ...smallKeys(320, 240), samples: 1, algorithm, occlusion: false, groundShadow: false, edges: false };
    try {
      let answer = await render(state.text, changes, '?channel=color', signal);
      const again = await render(state.text, changes, '?channel=color', signal);
      if (again.drawn < answer.drawn) answer = again;
      rows.push({ algorithm, title, ms: answer.drawn, bytes: new Uint8Array(await answer.blob.arrayBuffer()) });
    } catch (error) {
      if (error.name === 'AbortError') throw error;
      rows.push({ algorithm, title, fault: error.message });
    }
    const most = Math.max(...rows.map((row) => row.ms || 0), 0.01);
    body.replaceChildren(...rows.map((row) => {
      const bar = el('span', { className: 'bar' });
      bar.style.width = 100 * (row.ms || 0) / most + '%';
      return el('tr', {}, el('td', {}, el('code', {}, row.algorithm), el('br'), el('small', {}, row.fault || row.title)),
        el('td', { className: 'bars' }, bar), el('td', { className: 'number' }, row.fault ? '–' : row.ms.toFixed(2) + ' ms'));
    }));
  }
  const drawn = rows.filter((row) => row.bytes);
  const areSame = drawn.every((row) => same(row.bytes, drawn[0].bytes));
  byId('algorithms-verdict').textContent = !drawn.length ? 'None of them draws this scene.'
    : areSame ? `✓ The same PNG from ${drawn.length === 5 ? 'each' : drawn.length + ' of them'}, byte for byte: ${drawn[0].bytes.length.toLocaleString('en')} bytes.`
      : '✗ The pictures differ. Please report this.';
  comparedAlgorithms = key;
});
