import type { ChannelName, Look, Options } from './options.js';

export type { ChannelName, Look };

/* Names of engines, which programs for Node or for browsers may lack. */
type Engine<Name extends string> = typeof globalThis extends { [name in Name]: { prototype: infer Type } } ? Type : never;
type Module = typeof globalThis extends { WebAssembly: { Module: { prototype: infer Type } } } ? Type : object;
type Image = Engine<'ImageData'>;
type Bytes = ReturnType<typeof Uint8Array.from>; /* not shared, where TypeScript tells */

export type Status = 'bad-syntax' | 'bad-type' | 'bad-request' | 'bad-scene' | 'no-memory' | 'cancelled' | 'internal' | 'ended';
export type Numbers = Uint8Array | Float32Array | Float64Array | Int32Array | Uint32Array | BigInt64Array | BigUint64Array;
/** Bytes of a file, its text, or a scene as in the format of scenes. */
export type Body = Uint8Array | ArrayBuffer | string | object;
/** A file, or an array in place of a list: { data, shape: [n, 3] }. optional: no warning if nothing uses it. */
export type Part = Uint8Array | { data: Uint8Array; optional?: boolean } | { data: Numbers; shape: number[]; optional?: boolean };
export type Channel = ChannelName | { channel: ChannelName; [key: string]: unknown };

export interface DrawOptions extends Options {
  /** "stl", "model/stl", ...; else by the bytes */
  type?: string;
  /** parameters as in a URL */
  query?: string | Record<string, string | number | boolean>;
  parts?: Record<string, Part>;
  /** width and height, or one number for both */
  size?: number | readonly [number, number];
  channels?: Channel | readonly Channel[];
  /** in a Worker: ends the call, and the Worker. Else: looked at before the call. */
  signal?: AbortSignal;
}
export interface LoadOptions {
  /** bytes that the module may take; 1 GiB; in workerd 100 MiB */
  memoryMax?: number;
}
export type Source = URL | string | Engine<'Response'> | ArrayBuffer | ArrayBufferView | Module;

/** Opens the renderer. source: by default the module of this package. */
export function load(source?: Source | Promise<Source>, options?: LoadOptions): Promise<Zraster>;

/** Compiles the module once, for several load(). */
export function compile(source?: Source | Promise<Source>): Promise<Module>;

export class Zraster {
  private constructor();
  readonly version: string;
  /** rises when the same scene gets other pixels */
  readonly rules: number;
  /** parameters, keys, looks, channels, encodings, formats and limits */
  readonly tables: any;
  /** bytes that the module has taken */
  readonly memory: number;
  readonly memoryMax: number;
  readonly module: Module;
  /** why it cannot be used, such as a fault; '' if it can */
  readonly ended: string;
  draw(body: Body, options?: DrawOptions): Picture;
  /** draws the colours for a canvas, and frees the picture */
  imageData(body: Body, options?: DrawOptions): Image;
  read(body: Body, options?: DrawOptions): Scene;
  /** files that a file refers to, to give as parts */
  references(body: Body, type?: string): string[];
  /** the numbers of "Comparing models" */
  compare(a: Scene, b: Scene, query?: string | Record<string, string>): any;
  /** opens it anew, with empty memory; scenes and pictures are gone */
  reopen(): Promise<void>;
  close(): void;
}

export class Scene {
  private constructor();
  /** other keys: view, look, poses, ... */
  draw(change?: object, options?: DrawOptions): Picture;
  /** draws the colours for a canvas, and frees the picture */
  imageData(change?: object, options?: DrawOptions): Image;
  readonly memory: number;
  free(): void;
}

export class Picture {
  private constructor();
  encode(channel?: ChannelName): { bytes: Bytes; type: string };
  /** a copy of the numbers; row 0 is the top */
  channel(name?: ChannelName): { data: Numbers; shape: number[] } | null;
  imageData(): Image;
  readonly hasAlpha: boolean;
  readonly look: string;
  readonly warnings: string[];
  free(): void;
}

export class ZrasterError extends Error {
  readonly status: Status;
  readonly faults: { pointer: string; detail: string }[];
}
