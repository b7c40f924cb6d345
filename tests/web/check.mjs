/* check.mjs - tests of clients/web: TAP, and pictures by the bytes of their files. */
import { spawnSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';

let number = 0, failed = 0;

/** Runs a test, which throws if it fails. */
export async function test(name, run) {
  number++;
  try {
    await run();
    console.log(`ok ${number} - ${name}`);
  } catch (error) {
    failed++;
    console.log(`not ok ${number} - ${name}`);
    console.log(String(error.stack ?? error).replace(/^/gm, '# '));
  }
}

export function end() {
  console.log(`1..${number}`);
  process.exitCode = failed ? 1 : 0;
}

/** Throws if two files differ. */
export function sameBytes(a, b, place = 'here') {
  if (Buffer.compare(a, b) !== 0) throw new Error(`${place}: other bytes, ${a.length} and ${b.length} of them`);
}

/** Draws a file by the module z and by the command of a build, and throws if files or faults differ. True: drawn; false: refused by both. */
export function drawsAlike(z, build, file, options = {}, type) {
  const words = [file, '-j', '1', '-o', '-', ...Object.entries(options).flatMap(([name, value]) => [`--${name}`, value])];
  const { status, stdout, stderr } = spawnSync(join(build, 'zraster'), words, { maxBuffer: 2 ** 28 });
  let got = null, fault = '';
  try {
    const picture = z.draw(readFileSync(file), { query: options, type });
    got = picture.encode().bytes;
    picture.free();
  } catch (error) {
    if (!error.status) throw error;
    fault = error.message.split('\n')[0].replace(/^parameter \w+: /, ''); /* --NAME: in the command */
  }
  const isSame = got ? status === 0 : status !== 0 && String(stderr).includes(fault);
  if (!isSame) throw new Error(`command: ${status === 0 ? 'drawn' : stderr}; module: ${got ? 'drawn' : fault}`);
  if (got) sameBytes(stdout, got, file);
  return Boolean(got);
}
