import type { Body, ChannelName, DrawOptions, LoadOptions, Numbers, Picture as Drawn, Source } from './zraster.js';

export { ZrasterError } from './zraster.js';

type Image = ReturnType<Drawn['imageData']>;

/** Opens the renderer in a Worker. Calls run in turn. An aborted signal takes a call out of the queue. If it runs already, its Worker ends:
 * scenes and pictures are gone, and the next call starts another. */
export function load(source?: Source | Promise<Source>, options?: LoadOptions): Promise<Zraster>;

export class Zraster {
  private constructor();
  readonly version: string;
  readonly rules: number;
  readonly tables: any;
  draw(body: Body, options?: DrawOptions): Promise<Picture>;
  /** draws the colours for a canvas, and frees the picture */
  imageData(body: Body, options?: DrawOptions): Promise<Image>;
  read(body: Body, options?: DrawOptions): Promise<Scene>;
  references(body: Body, type?: string): Promise<string[]>;
  compare(a: Scene, b: Scene, query?: string | Record<string, string>): Promise<any>;
  /** ends all calls and starts another Worker; scenes and pictures are gone */
  reopen(): Promise<void>;
  close(): void;
}

export class Scene {
  private constructor();
  draw(change?: object, options?: DrawOptions): Promise<Picture>;
  /** draws the colours for a canvas, and frees the picture */
  imageData(change?: object, options?: DrawOptions): Promise<Image>;
  free(): Promise<void>;
}

export class Picture {
  private constructor();
  readonly hasAlpha: boolean;
  readonly look: string;
  readonly warnings: string[];
  encode(channel?: ChannelName): Promise<ReturnType<Drawn['encode']>>;
  channel(name?: ChannelName): Promise<{ data: Numbers; shape: number[] } | null>;
  imageData(): Promise<Image>;
  free(): Promise<void>;
}
