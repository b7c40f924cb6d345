// all.ts - each function and type of zraster.d.ts and worker.d.ts, as a program for tsc --strict; and words that it must refuse.
import { compile, load, Picture, Scene, Zraster, ZrasterError } from 'zraster';
import type { Body, Channel, ChannelName, DrawOptions, LoadOptions, Look, Numbers, Part, Source, Status } from 'zraster';
import * as worker from 'zraster/worker';

const body: Body = new Uint8Array(84), buffer: Body = new ArrayBuffer(84), text: Body = 'v 0 0 0', scene: Body = { meshes: [] };
const parts: Record<string, Part> = {
  'part.mtl': new Uint8Array(3), points: { data: new Float32Array(9), shape: [3, 3] }, faces: { data: new Uint32Array(3), shape: [1, 3], optional: true },
  'image.png': { data: new Uint8Array(3), optional: true },
};
const channels: Channel[] = ['color', { channel: 'position', space: 'world' }];
const pinned: Look = 'studio@1', depth: ChannelName = 'depth', window = [640, 480] as const;
const all: DrawOptions = {
  type: 'stl', query: { look: 'clay', width: 3, edges: true }, parts, channels, size: [640, 480], signal: new AbortController().signal,
  look: 'technical', samples: 4, creaseDegrees: 20, crease_degrees: 20, doubleSided: false, ground_shadow: true, color: 'tomato', section: 'x:0.5',
  background: [1, 1, 1], view: { eye: [1, 2, 3] }, hide: ['a', 'b'], environment: false, lights: [{ type: 'point' }], title: 'a title',
};
const few: LoadOptions = { memoryMax: 2 ** 28 };

export async function here(source: Source, file: URL, answer: Response, promise: Promise<Response>): Promise<string> {
  const module: WebAssembly.Module = await compile();
  await compile(answer);
  for (const from of [source, file, promise, module, new Uint8Array(8), 'zraster.wasm', undefined]) await load(from, few);
  const zraster: Zraster = await load();
  const version: string = zraster.version, numbers: number = zraster.rules + zraster.memory + zraster.memoryMax, why: string = zraster.ended;
  const looks: string[] = zraster.tables.looks, again: WebAssembly.Module = zraster.module;
  const picture: Picture = zraster.draw(body, all), other: Picture = zraster.draw(buffer, { look: pinned, channels: [depth], size: window });
  const { bytes, type } = picture.encode();
  picture.encode('depth');
  const response = new Response(bytes, { headers: { 'Content-Type': type } }), blob = new Blob([bytes], { type });
  const found = picture.channel('depth');
  const data: Numbers | undefined = found?.data, shape: number[] | undefined = found?.shape;
  const image: ImageData = picture.imageData(), facts: [boolean, string, string[]] = [picture.hasAlpha, picture.look, picture.warnings];
  const drawn: ImageData = zraster.imageData(text, { size: 64 });
  picture.free();
  const read: Scene = zraster.read(scene, { look: 'clay' }), size: number = read.memory;
  const view: Picture = read.draw({ view: { preset: 'front' } }, { azimuth: 30, size: 100 }), rough: ImageData = read.imageData({}, { size: 64 });
  read.free();
  const names: string[] = zraster.references(text, 'obj'), difference = zraster.compare(read, read, { sections: '3' });
  await zraster.reopen();
  zraster.close();
  return [version, numbers, why, looks, again, other, response, blob, data, shape, image, facts, drawn, size, view, rough, names, difference].join();
}

export async function there(file: URL, answer: Promise<Response>): Promise<string> {
  const zraster: worker.Zraster = await worker.load(file, few), other = await worker.load(answer);
  const facts: [string, number, string[]] = [zraster.version, zraster.rules, zraster.tables.looks];
  const picture: worker.Picture = await zraster.draw(body, all), known: [boolean, string, string[]] = [picture.hasAlpha, picture.look, picture.warnings];
  const { bytes, type } = await picture.encode('depth'), found = await picture.channel(), image: ImageData = await picture.imageData();
  const response = new Response(bytes, { headers: { 'Content-Type': type } });
  await picture.free();
  const scene: worker.Scene = await zraster.read(text), view: worker.Picture = await scene.draw({ look: 'clay' }, { azimuth: 3, signal: AbortSignal.timeout(9) });
  const drawn: ImageData[] = [await zraster.imageData(body, all), await scene.imageData({}, { size: 64 })];
  await scene.free();
  const names: string[] = await zraster.references(buffer), numbers = await zraster.compare(scene, scene, 'sections=3');
  await zraster.reopen();
  zraster.close();
  return [other, facts, known, found?.shape, found?.data.length, image, response, view, drawn, names, numbers].join();
}

export function told(error: unknown): string {
  if (!(error instanceof ZrasterError)) return String(error);
  const status: Status = error.status;
  if (error instanceof worker.ZrasterError && status === 'no-memory') return error.message;
  return error.faults.map(({ pointer, detail }) => `${pointer}: ${detail}`).join('\n');
}

export async function wrong(zraster: Zraster, picture: Picture, away: worker.Zraster): Promise<void> {
  // @ts-expect-error an unknown option
  zraster.draw(body, { lok: 'clay' });
  // @ts-expect-error a look is a text
  zraster.draw(body, { look: 3 });
  // @ts-expect-error a number is needed
  zraster.draw(body, { width: '640' });
  // @ts-expect-error true or false is needed
  zraster.draw(body, { doubleSided: 'yes' });
  // @ts-expect-error three sides
  zraster.draw(body, { size: [640, 480, 3] });
  // @ts-expect-error an array without its shape
  zraster.draw(body, { parts: { points: { data: new Float32Array(9) } } });
  // @ts-expect-error no body
  zraster.draw();
  // @ts-expect-error a body is no number
  zraster.draw(3);
  // @ts-expect-error no such method
  zraster.render(body);
  // @ts-expect-error a channel has a name
  picture.encode(3);
  // @ts-expect-error it may be null
  picture.channel('depth').data;
  // @ts-expect-error an image is no text
  const letters: string = picture.imageData();
  // @ts-expect-error a module is no text
  const words: string = zraster.module;
  // @ts-expect-error it is read only
  picture.look = 'clay';
  // @ts-expect-error load() makes it
  new Zraster();
  // @ts-expect-error bytes are a number
  await load(undefined, { memoryMax: '1 GiB' });
  // @ts-expect-error no such status
  const status: Status = 'bad-luck';
  // @ts-expect-error a promise has no bytes
  away.draw(body).encode();
  // @ts-expect-error load() makes it
  new worker.Zraster();
  // @ts-expect-error the memory of a Worker is unknown
  away.memory;
}
