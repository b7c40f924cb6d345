// Reads names of glTF files, one per line. Writes one GLB per file and variant by the library of @gltf-transform/cli:
// FOLDER/NUMBER.VARIANT.glb. Reads the meshopt and Draco variants again and writes them without compression:
// FOLDER/NUMBER.VARIANT.read.glb. Prints one line of JSON per file: {VARIANT: null, or the reason why it is missing}.
//     node variants.mjs MODULES FOLDER <names
import path from 'node:path';
import readline from 'node:readline';
import { createRequire } from 'node:module';

const [modules, folder] = process.argv.slice(2);
const require = createRequire(path.join(path.resolve(modules), '/'));
const { NodeIO, Logger } = require('@gltf-transform/core');
const { ALL_EXTENSIONS, EXTMeshoptCompression, EXTTextureWebP, KHRDracoMeshCompression } =
    require('@gltf-transform/extensions');
const { meshopt, quantize, sparse } = require('@gltf-transform/functions');
const { MeshoptDecoder, MeshoptEncoder } = require('meshoptimizer');
const draco3d = require('draco3dgltf');
const sharp = require('sharp');

await Promise.all([MeshoptDecoder.ready, MeshoptEncoder.ready]);
const silent = new Logger(Logger.Verbosity.SILENT);
const io = new NodeIO().setLogger(silent).registerExtensions(ALL_EXTENSIONS).registerDependencies({
    'draco3d.decoder': await draco3d.createDecoderModule(), 'draco3d.encoder': await draco3d.createEncoderModule(),
    'meshopt.decoder': MeshoptDecoder, 'meshopt.encoder': MeshoptEncoder,
});
const required = (Extension) => (document) => void document.createExtension(Extension).setRequired(true);

// Like textureCompress(), which cannot keep colours under an alpha of 0.
async function webp(document) {
    const textures = document.getRoot().listTextures();
    if (!textures.length) return 'no textures';
    document.createExtension(EXTTextureWebP).setRequired(true);
    for (const texture of textures) {
        const image = await sharp(texture.getImage()).webp({ lossless: true, exact: true, effort: 0 }).toBuffer();
        texture.setImage(new Uint8Array(image)).setMimeType('image/webp');
    }
}
const [SEQUENTIAL, EDGEBREAKER] = [0, 1];
const draco = (options) => (document) => {
    const primitives = document.getRoot().listMeshes().flatMap((mesh) => mesh.listPrimitives());
    const isCompressed = (primitive) => primitive.getMode() === 4 && primitive.getIndices();
    if (!primitives.some(isCompressed)) return 'no indexed triangles';
    document.createExtension(KHRDracoMeshCompression).setRequired(true).setEncoderOptions(options);
};
const speed = (value) => ({ encodeSpeed: value, decodeSpeed: value });
const bits = (position, others) => ({
    quantizationBits: { POSITION: position, NORMAL: others, COLOR: others, TEX_COORD: others, GENERIC: others },
});
const variants = {
    plain: () => {},
    sparse: sparse({ ratio: 1 }),
    'meshopt-lossless': required(EXTMeshoptCompression),
    'meshopt-medium': meshopt({ encoder: MeshoptEncoder, level: 'medium' }),
    quantize: quantize(),
    webp,
    'draco-edgebreaker': draco({ method: EDGEBREAKER }),
    'draco-slow': draco({ method: EDGEBREAKER, ...speed(0), ...bits(16, 11) }),
    'draco-fast': draco({ method: EDGEBREAKER, ...speed(10), ...bits(12, 14) }),
    'draco-exact': draco({ method: EDGEBREAKER, ...speed(3), ...bits(0, 0) }),
    'draco-sequential': draco({ method: SEQUENTIAL, ...bits(15, 12) }),
    'draco-sequential-exact': draco({ method: SEQUENTIAL, ...bits(0, 0) }),
};

let number = 0;
for await (const file of readline.createInterface({ input: process.stdin })) {
    const made = {};
    for (const [name, change] of Object.entries(variants)) {
        const output = path.join(folder, `${number}.${name}.glb`);
        try {
            const document = await io.read(file);
            document.setLogger(silent);
            made[name] = await change(document);
            if (typeof made[name] === 'string') continue;
            made[name] = null;
            await io.write(output, document);
            if (!/^(meshopt|draco)/.test(name)) continue;
            const read = await io.read(output), Compression = [EXTMeshoptCompression, KHRDracoMeshCompression];
            for (const used of read.getRoot().listExtensionsUsed())
                if (Compression.some((Extension) => used instanceof Extension)) used.dispose();
            await io.write(output.replace('.glb', '.read.glb'), read);
        } catch (error) {
            made[name] = String(error?.message ?? error);
        }
    }
    number++;
    console.log(JSON.stringify(made));
}
