/* check.mjs - tests of clients/web: TAP, and pictures by their pixels. */
import { spawnSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { inflateSync } from 'node:zlib';

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

/** Chunks of a PNG without the compressed ones, and their rows. */
function pngParts(bytes) {
  const chunks = [], data = [], view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  for (let at = 8; at < bytes.length;) {
    const size = view.getUint32(at), type = Buffer.from(bytes.subarray(at + 4, at + 8)).toString('latin1'), body = bytes.subarray(at + 8, at + 8 + size);
    if (type === 'IDAT') data.push(body);
    else if (type === 'fdAT') data.push(body.subarray(4));
    else chunks.push(type === 'fcTL' ? type : type + Buffer.from(body).toString('latin1'));
    at += 12 + size;
  }
  return { chunks: chunks.join('\n'), data };
}

/* Streams of animations follow one another. */
function rows(data) {
  const all = [];
  let rest = Buffer.concat(data);
  while (rest.length) {
    const { buffer, engine } = inflateSync(rest, { info: true });
    all.push(buffer);
    rest = rest.subarray(engine.bytesWritten);
  }
  return Buffer.concat(all);
}

/* Members of a ZIP without compression, as zraster writes it: by its directory. */
function members(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength), all = new Map();
  let end = bytes.length - 22;
  while (end > 0 && view.getUint32(end, true) !== 0x06054b50) end--;
  for (let i = 0, at = view.getUint32(end + 16, true); i < view.getUint16(end + 10, true); i++) {
    const size = view.getUint32(at + 20, true), name = view.getUint16(at + 28, true), from = view.getUint32(at + 42, true);
    if (view.getUint16(at + 10, true) !== 0) throw new Error('a member is compressed');
    const begin = from + 30 + view.getUint16(from + 26, true) + view.getUint16(from + 28, true);
    all.set(Buffer.from(bytes.subarray(at + 46, at + 46 + name)).toString(), bytes.subarray(begin, begin + size));
    at += 46 + name + view.getUint16(at + 30, true) + view.getUint16(at + 32, true);
  }
  return all;
}

const begins = (bytes, text) => Buffer.from(bytes.subarray(0, text.length)).toString('latin1') === text;

/** '' if two files are the same: byte for byte, PNG by its chunks and rows, ZIP by its members; else the difference. */
export function difference(a, b) {
  if (Buffer.compare(a, b) === 0) return '';
  if (begins(a, '\x89PNG') && begins(b, '\x89PNG')) {
    const p = pngParts(a), q = pngParts(b);
    if (p.chunks !== q.chunks) return 'other chunks';
    return Buffer.compare(rows(p.data), rows(q.data)) === 0 ? '' : 'other pixels';
  }
  if (begins(a, 'PK') && begins(b, 'PK')) {
    const p = members(a), q = members(b);
    if ([...p.keys()].join() !== [...q.keys()].join()) return 'other members';
    return [...p].map(([name, bytes]) => [name, difference(bytes, q.get(name))]).filter(([, text]) => text).map(x => x.join(': ')).join('; ');
  }
  return 'other bytes';
}

/** Draws a file by the module z and by the command of a build, and throws if pixels or faults differ. True: drawn; false: refused by both. */
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
  const text = got ? difference(stdout, got) : '';
  if (text) throw new Error(text);
  return Boolean(got);
}
