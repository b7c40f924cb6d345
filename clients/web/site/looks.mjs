/* looks.mjs PACKAGE: prints the list of looks, as GET /v1/looks answers it. */
import { pathToFileURL } from 'node:url';
import { resolve } from 'node:path';

const { load } = await import(pathToFileURL(resolve(process.argv[2], 'node.mjs')));
const { looks, words } = (await load()).tables;
const all = words.filter(word => word.kind === 'look').map(({ name, text }) => ({
  name,
  text,
  versions: looks.map(look => look.split('@')).filter(([other]) => other === name).map(([, version]) => Number(version)),
}));
console.log(JSON.stringify({ looks: all }));
