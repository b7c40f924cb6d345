// three_page.mjs - redraws of a mesh, 640 x 480: three by WebGL, flat Lambert, frame and readPixels, and the module in textbook, frame and pixels.
// In turns, each view another one; says the milliseconds of each round.
import * as THREE from 'three';
import { load } from '/package/browser.mjs';

const WIDTH = 640, HEIGHT = 480, query = new URLSearchParams(location.search), rounds = Number(query.get('rounds')), WARM = 8;
const text = await (await fetch('/mesh')).text();
const lines = text.split('\n').map(line => line.trim().split(/\s+/)), geometry = new THREE.BufferGeometry();
const points = lines.filter(([kind]) => kind === 'v').flatMap(([, x, y, z]) => [+x, +y, +z]);
const corners = lines.filter(([kind]) => kind === 'f').flatMap(([, ...words]) => words.slice(2).flatMap((_, i) => [0, i + 1, i + 2].map(k => parseInt(words[k], 10) - 1)));
geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(points), 3));
geometry.setIndex(corners);
geometry.computeBoundingSphere();

const renderer = new THREE.WebGLRenderer({ antialias: false }), gl = renderer.getContext();
renderer.setPixelRatio(1);
renderer.setSize(WIDTH, HEIGHT);
renderer.setClearColor(0xffffff);
const stage = new THREE.Scene(), { center, radius } = geometry.boundingSphere, camera = new THREE.PerspectiveCamera(30, WIDTH / HEIGHT, radius / 10, 20 * radius);
stage.add(new THREE.Mesh(geometry, new THREE.MeshLambertMaterial({ color: 0xdddddd, flatShading: true })), camera, new THREE.AmbientLight(0xffffff, 0.5));
camera.add(new THREE.DirectionalLight(0xffffff, 3));
const pixels = new Uint8Array(4 * WIDTH * HEIGHT), scene = (await load()).read(text);

function drawThree(degrees) {
  const angle = (degrees * Math.PI) / 180, distance = (0.85 * radius) / Math.sin(Math.PI / 12);
  camera.position.set(Math.sin(angle), 0.35, Math.cos(angle)).normalize().multiplyScalar(distance).add(center);
  camera.lookAt(center);
  renderer.render(stage, camera);
  gl.readPixels(0, 0, WIDTH, HEIGHT, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
}
const drawOurs = azimuth => scene.imageData({}, { look: 'textbook', azimuth, size: [WIDTH, HEIGHT] });

function taken(draw, degrees) {
  const begin = performance.now();
  draw(degrees);
  return performance.now() - begin;
}

for (let i = 0; i < WARM; i++) drawThree(i), drawOurs(i);
const times = Array.from({ length: rounds }, (_, i) => [taken(drawThree, 7 * i), taken(drawOurs, 7 * i)]);
const facts = gl.getExtension('WEBGL_debug_renderer_info');
drawThree(30);
await say('three.rgba', pixels);
await say('ours.rgba', drawOurs(30).data);
await say('name', `three ${THREE.REVISION}, ${gl.getParameter(facts ? facts.UNMASKED_RENDERER_WEBGL : gl.RENDERER)}`);
await say('times', JSON.stringify(times));
await say('end', '');
