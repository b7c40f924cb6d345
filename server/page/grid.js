// The window of the lesson: a square per pixel, with marks of the current step.

const GRID = { cell: 30, margin: 24 };
const MARK = '#d0245c';

function colorOf(trace, id) {
  const { faceId } = trace.primitives[id - 1];
  const { color } = (state.scene.polygons || [])[faceId - 1] || {};
  return typeof color === 'string' && /^#[0-9a-f]{6}$/i.test(color) ? color : PALETTE[(faceId - 1) % PALETTE.length];
}

// The luminance of a colour (WCAG 2.2), and black or white, whichever has more contrast with it.
function luminanceOf(hex) {
  const [r, g, b] = rgb(hex).map((value) => value > 10 ? ((value / 255 + 0.055) / 1.055) ** 2.4 : value / 255 / 12.92);
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}
const inkOn = (hex) => luminanceOf(hex) > 0.179 ? '#000000' : '#ffffff';

// Places on the canvas: the left side of a column, the upper side of a row, and any point.
const leftOf = (x) => GRID.margin + x * GRID.cell;
const topOf = (trace, row) => (trace.window.height - 1 - row) * GRID.cell;
const pointOf = (trace, [x, y]) => [leftOf(x + 0.5), topOf(trace, y - 0.5)];

function drawSquares(context, trace, held) {
  const { width, height } = trace.window, { cell, margin } = GRID;
  context.fillStyle = '#fff';
  context.fillRect(0, 0, context.canvas.width, context.canvas.height);
  context.font = '11.5px system-ui, sans-serif';
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  context.lineWidth = 1;
  context.fillStyle = '#52606d';
  for (let x = 0; x < width; x += 4) context.fillText(x, leftOf(x) + cell / 2, height * cell + margin / 2);
  for (let row = 0; row < height; row += 4) context.fillText(row, margin / 2, topOf(trace, row) + cell / 2);
  held.ids.forEach((id, at) => {
    const left = leftOf(at % width), top = topOf(trace, Math.floor(at / width));
    context.strokeStyle = id ? '#ffffff80' : '#dfe5ea';
    if (id) {
      context.fillStyle = colorOf(trace, id);
      context.fillRect(left, top, cell, cell);
    }
    context.strokeRect(left + 0.5, top + 0.5, cell, cell);
    if (!id) return;
    const z = held.depths[at];
    context.fillStyle = inkOn(colorOf(trace, id));
    context.fillText(Number.isNaN(z) ? labelOf(trace, id) : depthText(z), left + cell / 2, top + cell / 2 + 1);
  });
}

function drawLines(context, trace, lines) {
  context.beginPath();
  for (const [from, to] of lines) {
    context.moveTo(...pointOf(trace, from));
    context.lineTo(...pointOf(trace, to));
  }
  context.stroke();
}

function drawOutline(context, trace, step) {
  const { corners, edges } = trace.primitives[step.id - 1], lineOf = ([x0, y0, x1, y1]) => [[x0, y0], [x1, y1]];
  context.strokeStyle = '#1a232d';
  context.lineWidth = 2;
  drawLines(context, trace, corners ? corners.map((corner, i) => [corner, corners[(i + 1) % corners.length]]) : edges.map(lineOf));
  context.strokeStyle = MARK;
  context.lineWidth = 4;
  drawLines(context, trace, (step.sides || []).map((side) => lineOf(edges[side])));
}

const BOXES = { box: ['#1a232d', 1.5], outside: ['#6b7680', 1], inside: ['#1a7f37', 2], mixed: ['#9a6200', 2], now: [MARK, 4] };

function frame(context, trace, color, { x, row }) {
  context.strokeStyle = color;
  context.strokeRect(leftOf(x) + 3.5, topOf(trace, row) + 3.5, GRID.cell - 6, GRID.cell - 6);
}

function drawMarks(context, trace, step) {
  const { cell } = GRID, each = ([row, x0, x1]) => Array.from({ length: x1 - x0 }, (_, k) => ({ x: x0 + k, row }));
  context.lineWidth = 2.5;
  for (const place of step.writes || []) frame(context, trace, '#fff', place);
  for (const place of step.lost || []) frame(context, trace, '#000', place);
  const [first = [], second = []] = step.pieces || [];
  for (const place of second.flatMap(each)) frame(context, trace, '#1a232d', place);
  context.lineWidth = 1.5;
  for (const { x, row } of first.flatMap(each)) {
    context.strokeStyle = MARK;
    context.strokeRect(leftOf(x) + 8.5, topOf(trace, row) + 8.5, cell - 16, cell - 16);
  }
  for (const { x, y, width, height, kind } of step.boxes || []) {
    [context.strokeStyle, context.lineWidth] = BOXES[kind];
    context.strokeRect(leftOf(x) + 1, topOf(trace, y + height - 1) + 1, width * cell - 2, height * cell - 2);
  }
  context.strokeStyle = context.fillStyle = MARK;
  context.lineWidth = 2;
  if (step.row !== undefined) context.strokeRect(leftOf(0) + 1, topOf(trace, step.row), trace.window.width * cell - 2, cell);
  for (const [x, row] of step.dots || []) {
    context.beginPath();
    context.arc(leftOf(x), topOf(trace, row) + cell / 2, 5, 0, 7);
    context.fill();
  }
}

function drawGrid(canvas, trace, held, step) {
  canvas.width = leftOf(trace.window.width) + 2;
  canvas.height = trace.window.height * GRID.cell + GRID.margin;
  const context = canvas.getContext('2d');
  drawSquares(context, trace, held);
  if (step.id) drawOutline(context, trace, step);
  drawMarks(context, trace, step);
}
