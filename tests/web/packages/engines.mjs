// engines.mjs - the package in another engine, and in a Worker of it.
import { load } from 'zraster';
import { load as open } from 'zraster/worker';

const OBJ = 'v 0 0 0\nv 1 0 0\nv 1 1 0.5\nv 0 1 0\nf 1 2 3 4\n', there = await open(), picture = await there.draw(OBJ, { size: 40 });
const [a, b] = [(await load()).draw(OBJ, { size: 40 }).encode().bytes, (await picture.encode()).bytes];
console.log(a.length > 500 && a.join() === b.join() ? 'the same' : 'others');
there.close();
