// Reads names of model files, one per line, and prints the result of three's loaders for each, as a line of JSON:
// {"triangles", "points", "lines", "min", "max", "colors"} or {"error"}. Pictures are not decoded.
//     node three.mjs NODE_MODULES <names
import fs from 'node:fs';
import path from 'node:path';
import readline from 'node:readline';
import { pathToFileURL } from 'node:url';

const modules = path.resolve(process.argv[2]);
const load = (name) => import(pathToFileURL(path.join(modules, name)).href);
const loader = async (name) => (await load(`three/examples/jsm/loaders/${name}.js`))[name];
const THREE = await load('three/build/three.module.js');
const { DOMParser } = await load('linkedom/esm/index.js');
const { MeshoptDecoder } = await load('three/examples/jsm/libs/meshopt_decoder.module.js');
const OBJ = await loader('OBJLoader'), STL = await loader('STLLoader'), PLY = await loader('PLYLoader');
const GLTF = await loader('GLTFLoader'), MF3 = (await load('three/examples/jsm/loaders/3MFLoader.js')).ThreeMFLoader;

// Browser functions that Node lacks. fetch reads files and data URIs only.
globalThis.self = globalThis;
// Selectors in browsers ignore the prefix of an element; selectors in linkedom do not.
globalThis.DOMParser = class extends DOMParser {
    parseFromString(text, type) {
        return super.parseFromString(text.replace(/<(\/?)[A-Za-z_][\w.-]*:/g, '<$1'), type);
    }
};
globalThis.ProgressEvent ??= class extends Event {};
globalThis.document = { createElementNS: () => new EventTarget() };
const decode = globalThis.fetch;
globalThis.fetch = async (request) => {
    const url = request.url ?? String(request);
    if (url.startsWith('data:')) return decode(url);
    return new Response(fs.readFileSync(new URL(url)), { status: 200 });
};
for (const name of ['warn', 'error', 'log']) console[name] = () => {};

const bytesOf = (file) => {
    const bytes = fs.readFileSync(file);
    return bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
};
// A plugin of GLTFLoader that loads textures without pictures.
const noPictures = () => ({ name: 'none', loadTexture: async () => new THREE.Texture() });
const readers = {
    obj: async (file) => new OBJ().parse(fs.readFileSync(file, 'utf8')),
    stl: async (file) => new THREE.Mesh(new STL().parse(bytesOf(file))),
    ply: async (file) => {
        const header = fs.readFileSync(file, 'latin1').split('end_header')[0];
        return new (/^element face 0*[1-9]/m.test(header) ? THREE.Mesh : THREE.Points)(new PLY().parse(bytesOf(file)));
    },
    '3mf': async (file) => new MF3().parse(bytesOf(file)),
    gltf: async (file) => {
        const made = new GLTF().setMeshoptDecoder(MeshoptDecoder).register(noPictures);
        const folder = pathToFileURL(path.dirname(file)).href + '/';
        return (await made.parseAsync(bytesOf(file), folder)).scene;
    },
};
readers.glb = readers.gltf;

// Returns the matrices of an object: one, or one per instance of EXT_mesh_gpu_instancing.
function matricesOf(object) {
    if (!object.isInstancedMesh) return [object.matrixWorld];
    return Array.from({ length: object.count }, (_, i) => {
        const matrix = new THREE.Matrix4();
        object.getMatrixAt(i, matrix);
        return matrix.premultiply(object.matrixWorld);
    });
}

function factsOf(scene) {
    const facts = { triangles: 0, points: 0, lines: 0, colors: 0 }, box = new THREE.Box3(), point = new THREE.Vector3();
    scene.updateMatrixWorld(true);
    scene.traverse((object) => {
        const position = object.geometry?.attributes.position;
        if (!position) return;
        const { index, attributes, drawRange } = object.geometry, matrices = matricesOf(object);
        const count = Math.min(index ? index.count : position.count, drawRange.count);
        if (object.isMesh) facts.triangles += Math.floor(count / 3) * matrices.length;
        else facts[object.isPoints ? 'points' : 'lines'] += count;
        if (attributes.color) facts.colors += attributes.color.count;
        for (let i = 0; i < count; i++) {
            const vertex = index ? index.getX(i) : i;
            for (const matrix of matrices) {
                if (object.isMesh) object.getVertexPosition(vertex, point);
                else point.fromBufferAttribute(position, vertex);
                box.expandByPoint(point.applyMatrix4(matrix));
            }
        }
    });
    if (box.isEmpty()) return { error: 'nothing to draw' };
    return { ...facts, min: box.min.toArray(), max: box.max.toArray() };
}

for await (const file of readline.createInterface({ input: process.stdin })) {
    let facts;
    try {
        facts = factsOf(await readers[path.extname(file).slice(1).toLowerCase()](file));
    } catch (error) {
        facts = { error: String(error?.message ?? error) };
    }
    process.stdout.write(JSON.stringify(facts) + '\n');
}
