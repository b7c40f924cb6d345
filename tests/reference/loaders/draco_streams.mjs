// Writes tests/support/input/draco_streams.h: small meshes of its own, compressed by Google's encoder (npm: draco3dgltf), each
// with a digest of what Google's decoder makes of it: FNV-1a of the counts, the corners and all attributes.
//     node draco_streams.mjs MODULES >tests/support/input/draco_streams.h
import path from 'node:path';
import { createRequire } from 'node:module';

const require = createRequire(path.join(path.resolve(process.argv[2]), '/'));
const draco3d = require('draco3dgltf');
const encoders = await draco3d.createEncoderModule(), decoders = await draco3d.createDecoderModule();

// A surface of columns * rows quads; each direction may be closed. Quads for which `isHole` is true are left out.
function surface(columns, rows, [isRound, isClosed], place, isHole = () => false) {
    const width = columns + (isRound ? 0 : 1), height = rows + (isClosed ? 0 : 1), points = [], faces = [];
    for (let j = 0; j < height; j++)
        for (let i = 0; i < width; i++) points.push(place(i / columns, j / rows));
    const at = (i, j) => (j % height) * width + (i % width);
    for (let j = 0; j < rows; j++)
        for (let i = 0; i < columns; i++)
            if (!isHole(i, j))
                faces.push(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1));
    return { points, faces };
}
const turn = (u) => [Math.cos(2 * Math.PI * u), Math.sin(2 * Math.PI * u)];
const torus = surface(9, 6, [true, true], (u, v) => {
    const [a, b] = turn(u), [c, d] = turn(v);
    return [(2 + c) * a, (2 + c) * b, d];
});
const sheet = surface(6, 5, [false, false], (u, v) => [u, v, u * v], (i, j) => i === 2 && j === 2);
const pipe = surface(7, 3, [true, false], (u, v) => [...turn(u), v]);
const field = surface(26, 20, [false, false], (u, v) => [u, v, 0.2 * Math.sin(6 * u) * Math.cos(4 * v)],
    (i, j) => i % 9 === 4 && j % 7 === 3);
// A cube of 24 points: each side has its own normals and texture coordinates.
const sides = [[0, 1, 2], [1, 2, 0], [2, 0, 1]].flatMap(([x, y, z]) => [-1, 1].map((up) => ({ x, y, z, up })));
const cube = { points: [], faces: [], normals: [], texcoords: [] };
for (const { x, y, z, up } of sides) {
    const first = cube.points.length, corner = [[-1, -1], [1, -1], [1, 1], [-1, 1]];
    for (const [a, b] of corner) {
        const point = [0, 0, 0], normal = [0, 0, 0];
        [point[x], point[y], point[z], normal[z]] = [a * up, b, up, up];
        cube.points.push(point);
        cube.normals.push(normal);
        cube.texcoords.push([(a + 1) / 2, (b + 1) / 2]);
    }
    cube.faces.push(...[0, 1, 2, 0, 2, 3].map((k) => first + k));
}
const islands = { points: [], faces: [] };
for (let k = 0; k < 3; k++) {
    islands.faces.push(...[0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2].map((i) => 4 * k + i));
    islands.points.push([k, 0, 0], [k + 0.5, 0, 0], [k, 0.5, 0], [k, 0, 0.5 + k]);
}

const { POSITION, NORMAL, COLOR, TEX_COORD, GENERIC } = encoders;
const unit = (p) => p.map((c) => c / Math.hypot(...p));
const lists = {
    normal: [NORMAL, 3, Float32Array, 'AddFloatAttributeToMesh', (mesh, i) => mesh.normals?.[i] ?? unit(mesh.points[i].map((c) => c + 0.1))],
    uv: [TEX_COORD, 2, Float32Array, 'AddFloatAttributeToMesh', (mesh, i) => mesh.texcoords?.[i] ?? mesh.points[i].slice(0, 2)],
    color: [COLOR, 4, Uint8Array, 'AddUInt8Attribute', (mesh, i) => [40 * i % 256, i, 255 - i, 255]],
    joints: [GENERIC, 4, Uint16Array, 'AddUInt16Attribute', (mesh, i) => [i % 3, i % 5, 1, 300]],
    weights: [GENERIC, 4, Float32Array, 'AddFloatAttributeToMesh', (mesh, i) => [0.5, 0.25, i / 100, 0]],
    steps: [GENERIC, 1, Int32Array, 'AddInt32Attribute', (mesh, i) => [i % 4 ? i : -1000 * i]],
};

function encode({ mesh, attributes = [], method, speed, bits = {} }) {
    const encoder = new encoders.Encoder(), builder = new encoders.MeshBuilder(), made = new encoders.Mesh();
    const count = mesh.points.length;
    builder.AddFacesToMesh(made, mesh.faces.length / 3, new Uint32Array(mesh.faces));
    builder.AddFloatAttributeToMesh(made, POSITION, count, 3, new Float32Array(mesh.points.flat()));
    for (const name of attributes) {
        const [kind, width, List, add, value] = lists[name];
        builder[add](made, kind, count, width, new List(mesh.points.flatMap((_, i) => value(mesh, i))));
    }
    encoder.SetEncodingMethod(method);
    encoder.SetSpeedOptions(speed, speed);
    for (const [kind, value] of Object.entries(bits)) encoder.SetAttributeQuantization(encoders[kind], value);
    const bytes = new encoders.DracoInt8Array(), size = encoder.EncodeMeshToDracoBuffer(made, bytes);
    return Buffer.from(Array.from({ length: size }, (_, i) => bytes.GetValue(i) & 255));
}

function digest(bytes) {
    const buffer = new decoders.DecoderBuffer(), decoder = new decoders.Decoder(), mesh = new decoders.Mesh();
    let sum = 0xcbf29ce484222325n;
    const add = (list) => {
        for (const byte of new Uint8Array(list.buffer, list.byteOffset, list.byteLength))
            sum = BigInt.asUintN(64, (sum ^ BigInt(byte)) * 0x100000001b3n);
    };
    const take = (size, read) => {
        const at = decoders._malloc(size);
        read(at);
        add(new Uint8Array(decoders.HEAPF32.buffer, at, size).slice());
        decoders._free(at);
    };
    buffer.Init(new Int8Array(bytes), bytes.length);
    if (!decoder.DecodeBufferToMesh(buffer, mesh).ok()) throw new Error('not decoded');
    const [points, faces] = [mesh.num_points(), mesh.num_faces()], sizes = [0, 1, 1, 2, 2, 4, 4, 8, 8, 4];
    add(new Uint32Array([points, faces]));
    take(12 * faces, (at) => decoder.GetTrianglesUInt32Array(mesh, 12 * faces, at));
    for (let i = 0; i < mesh.num_attributes(); i++) {
        const attribute = decoder.GetAttribute(mesh, i), type = attribute.data_type(), width = attribute.num_components();
        const size = points * width * sizes[type];
        add(new Uint32Array([attribute.unique_id(), type, width]));
        take(size, (at) => decoder.GetAttributeDataArrayForAllPoints(mesh, attribute, type, size, at));
    }
    return { points, faces, sum };
}

const [SEQUENTIAL, EDGEBREAKER] = [0, 1], Q8 = { POSITION: 8, NORMAL: 6, TEX_COORD: 7, GENERIC: 5 };
const streams = {
    sequential: { mesh: cube, attributes: ['normal', 'uv', 'color'], method: SEQUENTIAL, speed: 7, bits: Q8 },
    'sequential, exact': { mesh: islands, attributes: ['steps', 'uv'], method: SEQUENTIAL, speed: 10 },
    'cube, slow': { mesh: cube, attributes: ['normal', 'uv'], method: EDGEBREAKER, speed: 0, bits: Q8 },
    'cube, fast': { mesh: cube, attributes: ['normal', 'uv', 'color'], method: EDGEBREAKER, speed: 10, bits: Q8 },
    'torus, exact': { mesh: torus, attributes: ['normal', 'uv'], method: EDGEBREAKER, speed: 5 },
    'torus by degree': { mesh: torus, method: EDGEBREAKER, speed: 0, bits: Q8 },
    'torus with all': { mesh: torus, attributes: ['normal', 'uv', 'color', 'joints', 'weights'], method: EDGEBREAKER, speed: 3, bits: Q8 },
    'sheet with a hole': { mesh: sheet, attributes: ['uv', 'normal'], method: EDGEBREAKER, speed: 1, bits: Q8 },
    pipe: { mesh: pipe, attributes: ['normal', 'steps'], method: EDGEBREAKER, speed: 6, bits: Q8 },
    islands: { mesh: islands, method: EDGEBREAKER, speed: 4, bits: { POSITION: 10 } },
    'field by valence': { mesh: field, method: EDGEBREAKER, speed: 1, bits: { POSITION: 5 } },
};
console.log(`/* Draco meshes that tests/reference/loaders/draco_streams.mjs made from its own meshes by Google's encoder, and the
 * digests of what Google's decoder makes of them: FNV-1a of the counts, the corners and all attributes. */
#ifndef ZR_TESTS_DRACO_STREAMS_H
#define ZR_TESTS_DRACO_STREAMS_H

#include <stdint.h>

static const struct {
    const char *name;
    uint32_t points, faces;
    uint64_t digest;
    const char *base64;
} draco_streams[] = {`);
for (const [name, wanted] of Object.entries(streams)) {
    const bytes = encode(wanted), { points, faces, sum } = digest(bytes);
    const lines = bytes.toString('base64').match(/.{1,110}/g).map((line) => `     "${line}"`);
    console.log(`    {"${name}", ${points}, ${faces}, UINT64_C(0x${sum.toString(16).padStart(16, '0')}),\n${lines.join('\n')}},`);
}
console.log('};\n\n#endif');
