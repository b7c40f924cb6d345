// node.ts - a program for Node without the types of browsers.
import { readFile, writeFile } from 'node:fs/promises';
import { load, ZrasterError } from 'zraster';
import { load as open } from 'zraster/worker';

const zraster = await load(), picture = zraster.draw(await readFile('part.stl'), { look: 'clay', size: [64, 48] });
await writeFile('part.png', picture.encode().bytes);
try {
  const other = await open(), depth = await (await other.draw(await readFile('part.stl'), { channels: 'depth' })).channel('depth');
  console.log(depth?.shape, zraster.module);
} catch (error) {
  if (error instanceof ZrasterError) console.log(error.faults);
}
