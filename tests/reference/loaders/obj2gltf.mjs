// Reads names of OBJ files, one per line. Prints the facts of obj2gltf's result for each, in the form of three.mjs, with
// "materials": {NAME: {"triangles", "color", "textures"}}. color: baseColorFactor.
//     node obj2gltf.mjs MODULES <names
import path from 'node:path';
import readline from 'node:readline';
import { createRequire } from 'node:module';

const obj2gltf = createRequire(path.join(path.resolve(process.argv[2]), '/'))('obj2gltf');

function factsOf({ accessors, meshes, materials, textures, images }) {
    const facts = { triangles: 0, min: Array(3).fill(Infinity), max: Array(3).fill(-Infinity), materials: {} };
    for (const primitive of meshes.flatMap((mesh) => mesh.primitives)) {
        const { name: own, pbrMetallicRoughness, normalTexture, emissiveTexture } = materials[primitive.material];
        const { baseColorFactor, baseColorTexture } = pbrMetallicRoughness;
        // Faces with other attributes get a second material, NAME-2.
        const base = own.replace(/-\d+$/, '');
        const name = materials.some((material) => material.name === base) ? base : own;
        const uses = [baseColorTexture, normalTexture, emissiveTexture].filter(Boolean)
            .map(({ index }) => images[textures[index].source].name);
        const { min, max } = accessors[primitive.attributes.POSITION];
        const triangles = accessors[primitive.indices].count / 3;
        facts.materials[name] ??= { triangles: 0, color: baseColorFactor, textures: uses };
        facts.materials[name].triangles += triangles;
        facts.triangles += triangles;
        facts.min = facts.min.map((value, axis) => Math.min(value, min[axis]));
        facts.max = facts.max.map((value, axis) => Math.max(value, max[axis]));
    }
    return facts;
}

for await (const file of readline.createInterface({ input: process.stdin })) {
    let facts;
    try {
        facts = factsOf(await obj2gltf(file, { logger: () => {} }));
    } catch (error) {
        facts = { error: String(error?.message ?? error) };
    }
    console.log(JSON.stringify(facts));
}
