// draw.ts URL FILE.png: draws a scene by the types that openapi-typescript makes of /v1/openapi.json.
import type { components, paths } from './zraster.js';

type Scene = components['schemas']['scene'];
type Query = NonNullable<paths['/v1/render']['post']['parameters']['query']>;
declare const process: { argv: string[]; getBuiltinModule(name: string): any };

const lights: components['schemas']['light'][] = [
    { type: 'directional', direction: [-1, -2, -1], intensity: 0.8 },
    { type: 'spot', position: [0, 4, 2], direction: [0, -2, -1], intensity: 20, outerConeAngleDegrees: 30 },
];
const scene: Scene = {
    window: { width: 160, height: 120 },
    background: 'white',
    view: { preset: "front" },
    lights,
    meshes: [{ positions: [[0, 0, 0], [2, 0, 0], [1, 2, 0]], faces: [[0, 1, 2]] }],
    outputs: [{ channel: 'color' }],
};
const query: Query = { compress: 'small', strict: false };

async function main(): Promise<void> {
    const [url, file] = process.argv.slice(2);
    const answer = await fetch(`${url}/v1/render?${new URLSearchParams(query as Record<string, string>)}`, {
        method: 'POST',
        headers: { 'content-type': 'application/json' },
        body: JSON.stringify(scene),
    });
    if (!answer.ok) throw new Error(await answer.text());
    const bytes = new Uint8Array(await answer.arrayBuffer());
    if (bytes[0] !== 0x89) throw new Error('no PNG');
    process.getBuiltinModule('fs').writeFileSync(file!, bytes);
    console.log(`drawn by TypeScript: ${bytes.length} bytes`);
}

main();
