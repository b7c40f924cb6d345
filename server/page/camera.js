// The camera of a picture, taken from `info`, so that the first move goes on from what is seen.

const radians = (degrees) => degrees * Math.PI / 180;
const at4 = (matrix, row, column) => matrix[column * 4 + row];

// Axes of a camera in the world, by its angles: right, up, back (towards the eye).
function axesOf(camera) {
  const a = radians(camera.azimuth), e = radians(camera.elevation);
  const axes = [
    [Math.cos(a), 0, -Math.sin(a)],
    [-Math.sin(e) * Math.sin(a), Math.cos(e), -Math.sin(e) * Math.cos(a)],
    [Math.cos(e) * Math.sin(a), Math.sin(e), Math.cos(e) * Math.cos(a)],
  ];
  return camera.up === 'z' ? axes.map(([x, y, z]) => [x, -z, y]) : axes;
}

function cameraOf(info) {
  const { worldToCamera: w, projectionMatrix: p, azimuthDegrees, elevationDegrees, up } = info.camera;
  if (!w || !p || azimuthDegrees === undefined) return null;
  const bounds = info.bounds || { min: [-1, -1, -1], max: [1, 1, 1] };
  const middle = bounds.min.map((low, i) => (low + bounds.max[i]) / 2);
  const eyeSpace = [0, 1, 2].map((row) => at4(w, row, 0) * middle[0] + at4(w, row, 1) * middle[1] + at4(w, row, 2) * middle[2] + at4(w, row, 3));
  const isPerspective = at4(p, 3, 2) !== 0;
  const camera = { azimuth: azimuthDegrees, elevation: elevationDegrees, up, isPerspective };
  const given = (state.scene.view || {}).up;
  if (up !== 'z' && Array.isArray(given) && given[0] === 0 && given[1] === 0 && given[2] > 0) {
    // A view of its own upward axis, z: its angles are about that axis.
    camera.up = 'z';
    camera.viewUp = [0, 0, 1];
    camera.elevation = Math.asin(Math.max(-1, Math.min(1, at4(w, 2, 2)))) * 180 / Math.PI;
    camera.azimuth = Math.atan2(at4(w, 2, 0), -at4(w, 2, 1)) * 180 / Math.PI;
  }
  // The target is the point of the optical axis beside the middle of the scene.
  let shift = [eyeSpace[0], eyeSpace[1]];
  if (isPerspective) {
    camera.distance = Math.max(-eyeSpace[2], 1e-6);
    camera.yfov = 2 * Math.atan(1 / at4(p, 1, 1)) * 180 / Math.PI;
  } else {
    camera.xmag = 1 / at4(p, 0, 0);
    camera.ymag = 1 / at4(p, 1, 1);
    shift = [shift[0] + at4(p, 0, 3) * camera.xmag, shift[1] + at4(p, 1, 3) * camera.ymag];
  }
  const rows = [0, 1].map((row) => [0, 1, 2].map((column) => at4(w, row, column)));
  camera.target = middle.map((value, i) => value - shift[0] * rows[0][i] - shift[1] * rows[1][i]);
  return camera;
}

function viewOf(camera) {
  const view = {
    azimuthDegrees: round(camera.azimuth, 6),
    elevationDegrees: round(camera.elevation, 6),
    target: camera.target.map((value) => Math.abs(value) < 1e-9 ? 0 : round(value)),
  };
  if (camera.viewUp) view.up = camera.viewUp;
  if (camera.isPerspective) {
    view.distance = round(camera.distance);
    view.perspective = { yfovDegrees: round(camera.yfov) };
  } else {
    view.orthographic = { xmag: round(camera.xmag), ymag: round(camera.ymag) };
  }
  return view;
}

function orbit(camera, right, down) {
  camera.azimuth = ((camera.azimuth - right) % 360 + 360) % 360;
  camera.elevation = Math.max(-90, Math.min(90, camera.elevation + down));
}

// Half of the window's height, in units of the scene at the target.
const halfHeight = (camera) => camera.isPerspective ? camera.distance * Math.tan(radians(camera.yfov) / 2) : camera.ymag;

// Shares of the window's height.
function pan(camera, right, down) {
  const [x, y] = axesOf(camera), step = 2 * halfHeight(camera);
  camera.target = camera.target.map((value, i) => value - step * (right * x[i] - down * y[i]));
}

function zoom(camera, factor) {
  for (const key of ['distance', 'xmag', 'ymag']) if (camera[key]) camera[key] /= factor;
}
