import type { Body, DrawOptions, LoadOptions, Numbers, Source } from './zraster.js';

export { ZrasterError } from './zraster.js';

/** Opens the renderer in a Worker. */
export function load(source?: Source | Promise<Source>, options?: LoadOptions): Promise<Zraster>;

export class Zraster {
  readonly version: string;
  readonly rules: number;
  readonly tables: any;
  draw(body: Body, options?: DrawOptions): Promise<Picture>;
  read(body: Body, options?: DrawOptions): Promise<Scene>;
  references(body: Body, type?: string): Promise<string[]>;
  compare(a: Scene, b: Scene, query?: string | Record<string, string>): Promise<any>;
  reopen(): Promise<void>;
  close(): void;
}

export class Scene {
  draw(change?: object, options?: DrawOptions): Promise<Picture>;
  free(): Promise<void>;
}

export class Picture {
  readonly hasAlpha: boolean;
  readonly look: string;
  readonly warnings: string[];
  encode(channel?: string): Promise<{ bytes: Uint8Array; type: string }>;
  channel(name?: string): Promise<{ data: Numbers; shape: number[] } | null>;
  imageData(): Promise<ImageData>;
  free(): Promise<void>;
}
