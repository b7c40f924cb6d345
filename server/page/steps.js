// Steps of the lesson, made from the channel "trace" of the daemon: what an algorithm did, in its order. Rows count from
// the bottom, and the middle of a pixel has whole numbers.
//
// A step: {words, lines: of the code, id: of the primitive, row, writes: [{x, row, id, z}], lost: [{x, row}], dots: [[x, row]],
// sides: numbers of edges, boxes: [{x, y, width, height, kind}], pieces: [spans of one, of the other], list: {head, rows}}.

const counted = (count, one, many) => `${count} ${count === 1 ? one : many}`;
const depthText = (z) => z.toFixed(3).replace(/^0/, '');

// The name of a primitive in words: polygon 2, or 2b for the second triangle of polygon 2.
function labelOf(trace, id) {
  const { faceId } = trace.primitives[id - 1], same = trace.primitives.filter((primitive) => primitive.faceId === faceId);
  return faceId + (same.length > 1 ? String.fromCharCode(96 + id - same[0].id + 1) : '');
}

const namesOf = (trace, ids) => ids.map((id) => labelOf(trace, id)).join(' and ');
const pixelsText = (spans) => spans.map(([x0, x1]) => x1 - x0 === 1 ? `pixel ${x0}` : `pixels ${x0} to ${x1 - 1}`).join(' and ');

// A table: the rows near the current one, whose number is `seen`; -1: all rows.
function listOf(head, rows, seen) {
  const near = seen < 0 ? rows : rows.slice(Math.max(0, seen - 2), seen + 3);
  return { head, rows: near.map((cells) => ({ cells, isSeen: seen >= 0 && cells === rows[seen] })) };
}

const fateText = (written, lost) => lost
  ? `${counted(written, 'is', 'are')} nearer and written, ${counted(lost, 'is', 'are')} behind and ${lost === 1 ? 'stays' : 'stay'}`
  : `${counted(written, 'is', 'are')} nearer and written`;

// The pixels of a row against the z-buffer.
function rowOf(id, { row, spans, z, written, lost }) {
  const depths = new Map(spans.flatMap(([x0], i) => z[i].map((value, k) => [x0 + k, value])));
  return {
    id, row,
    writes: written.map((x) => ({ x, row, id, z: depths.get(x) })),
    lost: lost.map((x) => ({ x, row })),
    words: spans.length ? `row ${row}, ${pixelsText(spans)}: ${fateText(written.length, lost.length)}.` : `row ${row} has no pixel between its edges.`,
  };
}

// Runs of steps of the same primitive: [id, steps].
function runsOf(steps) {
  const runs = [];
  for (const step of steps) {
    if (!runs.length || runs[runs.length - 1][0] !== step.primitive) runs.push([step.primitive, []]);
    runs[runs.length - 1][1].push(step);
  }
  return runs;
}

const STEPS_OF = {
  edgelist(trace, lines, add) {
    for (const [id, rows] of runsOf(trace.steps)) {
      const name = `Polygon ${labelOf(trace, id)}`, dotsOf = ({ row, xs }) => xs.map((x) => [x, row]);
      const list = (at) => listOf(['row', 'its list: x of the crossings, sorted'], [...rows].reverse().map(({ row, xs }) => [row, xs.join('  ')]), at < 0 ? -1 : rows.length - 1 - at);
      add({ id, lines: lines.lists, words: `${name}: each edge puts its crossings into the lists of the rows, below.`, dots: rows.flatMap(dotsOf), list: list(-1) });
      rows.forEach((step, at) => {
        const row = rowOf(id, step);
        add({ ...row, lines: lines.row, words: `${name}, ${row.words}`, dots: dotsOf(step), list: list(at) });
      });
    }
  },

  trapezoid(trace, lines, add) {
    let sides = [];
    const list = () => listOf(['edge', 'x', 'excess', 'each row', 'parts'], sides.map(({ side, edge, x, excess, step, rest, parts }) =>
      [`${side}, ${edge + 1}`, x, excess, `x ${step < 0 ? '−' : '+'} ${Math.abs(step)}, − ${rest}`, parts]), -1);
    for (const step of trace.steps) {
      const id = step.primitive, name = `Polygon ${labelOf(trace, id)}`;
      if (step.trapezoids) {
        sides = step.trapezoids.flatMap(({ left, right }) => [{ side: 'left', ...left }, { side: 'right', ...right }]);
        const words = `${name}, rows ${step.bottom} to ${step.top - 1}: ${counted(step.trapezoids.length, 'trapezoid', 'trapezoids')} between two edges. An edge at x and excess begins at pixel x.`;
        add({ id, lines: lines.band, words, sides: sides.map(({ edge }) => edge), dots: sides.map(({ x }) => [x, step.bottom]), list: list() });
        continue;
      }
      const row = rowOf(id, step);
      add({ ...row, lines: lines.row, words: `${name}, ${row.words}`, sides: sides.map(({ edge }) => edge), dots: sides.map(({ x }) => [x, step.row]), list: list() });
      for (const side of sides) {
        side.x += side.step;
        side.excess -= side.rest;
        if (side.excess >= 0) continue;
        side.x++;
        side.excess += side.parts;
      }
    }
  },

  scanline(trace, lines, add) {
    for (const { row, active, spans } of trace.steps) {
      const dots = active.map(([, x]) => [x, row]);
      add({ row, lines: lines.active, words: `Row ${row}: ${counted(active.length, 'edge is', 'edges are')} active, from left to right.`, dots,
        list: listOf(['active edge of polygon', 'x'], active.map(([id, x]) => [labelOf(trace, id), x]), -1) });
      for (const { x0, x1, inside, left, shown } of spans) {
        const kind = inside.length === 1 ? 'one' : shown.length === 1 ? 'compared' : 'cut', names = namesOf(trace, inside.map(([id]) => id));
        const reason = {
          one: `only polygon ${names} is inside.`,
          compared: `polygons ${names} are inside, and ${namesOf(trace, shown.map(([, , id]) => id))} is the nearest everywhere.`,
          cut: `polygons ${names} are inside. ${namesOf(trace, left)} cut each other, and so the span is cut.`,
        }[kind];
        add({ row, lines: lines[kind], words: `Row ${row}, ${pixelsText([[x0, x1]])}: ${reason}`, dots,
          writes: shown.flatMap(([from, to, id]) => Array.from({ length: to - from }, (_, k) => ({ x: from + k, row, id }))),
          list: listOf(['inside', 'depth at the left end', 'at the right end', 'result'], inside.map(([id, z0, z1]) =>
            [labelOf(trace, id), depthText(z0), depthText(z1), shown.some(([, , other]) => other === id) ? 'visible' : 'hidden']), -1) });
      }
    }
  },

  painter(trace, lines, add) {
    const pieces = new Map();
    let order = [];
    const take = (piece) => { pieces.set(piece.piece, piece); return piece.piece; };
    const spansOf = (piece) => pieces.get(piece).spans;
    const name = (piece) => piece <= trace.primitives.length ? labelOf(trace, piece) : `${labelOf(trace, pieces.get(piece).primitive)} (piece ${piece})`;
    const list = (p, q) => listOf(['still to paint', 'nearest', 'farthest', 'role'], order.map((piece) =>
      [name(piece), depthText(pieces.get(piece).near), depthText(pieces.get(piece).far), piece === p ? 'p' : piece === q ? 'q' : '']), order.indexOf(p));
    for (const step of trace.steps) {
      if (step.order) {
        order = step.order.map(take);
        add({ lines: lines.order, words: `The polygons by their farthest depth: ${order.map(name).join(', ')}.`, list: list() });
      } else if (step.compare) {
        const [p, q] = step.compare;
        const reason = step.nearer ? `No: ${name(p)} hides a part of it.` : { depth: 'Yes: their depths are apart.', box: 'Yes: their boxes are apart.', pixels: `Yes: ${name(p)} is nowhere nearer.` }[step.test];
        add({ lines: lines[step.test], words: `May ${name(p)} be painted before ${name(q)}? ${reason}`, pieces: [spansOf(p), spansOf(q)], list: list(p, q) });
      } else if (step.swap) {
        const [p, q] = step.swap;
        order = [q, ...order.filter((piece) => piece !== q)];
        add({ lines: lines.swap, words: `${name(q)} has to come first: it is tried in place of ${name(p)}.`, pieces: [spansOf(q), spansOf(p)], list: list(q, p) });
      } else if (step.cycle) {
        add({ lines: lines.cycle, words: `${step.cycle.map(name).join(', ')}: each hides a part of the next, in a ring. One of them is cut.`, list: list(step.cycle[0]) });
      } else if (step.split) {
        const into = step.into.map(take);
        add({ lines: lines.split, words: `${name(step.split)} is cut in two where it crosses ${name(step.by)}: pieces ${into.join(' and ')} take its place.`,
          pieces: into.map(spansOf), list: (order = order.flatMap((piece) => piece === step.split ? into : piece), list(into[0], into[1])) });
      } else {
        const id = pieces.get(step.draw).primitive;
        const writes = spansOf(step.draw).flatMap(([row, x0, x1]) => Array.from({ length: x1 - x0 }, (_, k) => ({ x: x0 + k, row, id })));
        order = order.filter((piece) => piece !== step.draw);
        add({ lines: lines.draw, words: `${name(step.draw)} is painted over all that is there.`, writes, list: list() });
      }
    }
  },

  halfspace(trace, lines, add) {
    for (const { primitive: id, box, edges, tiles = [], rows = [] } of trace.steps) {
      const name = `Polygon ${labelOf(trace, id)}`, [x0, y0, x1, y1] = box, all = { x: x0, y: y0, width: x1 - x0 + 1, height: y1 - y0 + 1, kind: 'box' };
      if (edges) {
        const words = `${name}: each edge has a function that is positive on its inner side. Its box has ${counted(tiles.length, 'tile', 'tiles')}.`;
        add({ id, lines: lines.edges, words, boxes: [all], list: listOf(['edge', 'a', 'b', 'c'], edges.map((edge, i) => [i + 1, ...edge]), -1) });
      }
      tiles.forEach((tile, at) => {
        const parts = tile.rows.map((row) => rowOf(id, row));
        const writes = parts.flatMap((part) => part.writes), lost = parts.flatMap((part) => part.lost);
        const reason = {
          outside: 'one function is negative at all corners. No pixel is inside.',
          inside: `all functions are positive at all corners. Of its pixels, ${fateText(writes.length, lost.length)}.`,
          mixed: `an edge may cross it, so each pixel is tested. ${writes.length + lost.length ? `Of those inside, ${fateText(writes.length, lost.length)}` : 'None is inside'}.`,
        }[tile.is];
        add({ id, lines: lines[tile.is], writes, lost, words: `${name}, tile at ${tile.x}, ${tile.y}: ${reason}`,
          boxes: [all, ...tiles.slice(0, at + 1).map((seen) => ({ ...seen, kind: seen === tile ? 'now' : seen.is }))],
          list: listOf(['tile at', 'is', 'written', 'behind'], tiles.slice(0, at + 1).map((seen) =>
            [`${seen.x}, ${seen.y}`, seen.is, ...['written', 'lost'].map((fate) => seen.rows.reduce((sum, row) => sum + row[fate].length, 0))]), at) });
      });
      rows.forEach((step, at) => {
        const row = rowOf(id, step);
        add({ ...row, lines: lines.flips, words: `${name}, ${row.words}`, boxes: [all], dots: step.flips.map((x) => [x, step.row]),
          list: listOf(['row', 'edges flip the pixels from x on'], [...rows].reverse().map((other) => [other.row, other.flips.join('  ')]), rows.length - 1 - at) });
      });
    }
  },
};

function stepsOf(trace) {
  const steps = [{ lines: [-1, -1], words: 'The window is empty.' }], lettered = trace.primitives.some((primitive) => /[a-z]/.test(labelOf(trace, primitive.id)));
  if (lettered) steps[0].words += ' Polygons of four corners are drawn as triangles, a and b.';
  STEPS_OF[trace.algorithm](trace, CODE_LINES[trace.algorithm], (step) => steps.push(step));
  steps.push({ lines: [-1, -1], words: 'Done. Each algorithm ends with the same picture.' });
  return steps;
}

// The window after the first `count` steps: id and depth of each pixel, rows from the bottom.
function replay(trace, steps, count) {
  const { width, height } = trace.window;
  const held = { ids: new Uint32Array(width * height), depths: new Float32Array(width * height).fill(NaN) };
  for (const { writes = [] } of steps.slice(0, count)) {
    for (const { x, row, id, z = NaN } of writes) {
      held.ids[row * width + x] = id;
      held.depths[row * width + x] = z;
    }
  }
  return held;
}
