// Reads names of glTF files, one per line, and prints the errors of Khronos' validator: {"codes": {CODE: pointer}}.
//
//     node validate.mjs MODULES <names
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';

const validator = createRequire(join(resolve(process.argv[2]), '/'))('gltf-validator');
const read = (path) => new Uint8Array(readFileSync(path));

for (const path of readFileSync(0, 'utf8').split('\n').filter(Boolean)) {
    const codes = {};
    try {
        const beside = (uri) => Promise.resolve(read(join(dirname(path), decodeURIComponent(uri))));
        const report = await validator.validateBytes(read(path), { externalResourceFunction: beside });
        for (const { code, severity, pointer } of report.issues.messages) {
            if (severity === 0) codes[code] ??= pointer ?? '';
        }
    } catch (error) {
        codes.UNREADABLE = String(error).slice(0, 200);
    }
    console.log(JSON.stringify({ codes }));
}
