/* wasi.mjs MODULE: runs a program for WASI that only writes. Not by node:wasi: that of Node 20 crashes once the memory has grown. */
import { readFileSync, writeSync } from 'node:fs';

const NO_FUNCTION = 52;
let memory;
const exit = new Error('exit');

/* The parts of an output, as (address, size) in pairs. */
function fdWrite(file, parts, count, written) {
  const view = new DataView(memory.buffer);
  let sum = 0;
  for (let i = 0; i < count; i++) {
    const at = view.getUint32(parts + 8 * i, true), size = view.getUint32(parts + 8 * i + 4, true);
    for (let done = 0; done < size;) done += writeSync(file, new Uint8Array(memory.buffer, at + done, size - done));
    sum += size;
  }
  view.setUint32(written, sum, true);
  return 0;
}

function procExit(code) {
  process.exitCode = code;
  throw exit;
}

const module = new WebAssembly.Module(readFileSync(process.argv[2])), imports = {};
for (const { module: from, name } of WebAssembly.Module.imports(module)) {
  imports[from] ??= {};
  imports[from][name] = { fd_write: fdWrite, proc_exit: procExit }[name] ?? (() => NO_FUNCTION);
}
const { exports } = new WebAssembly.Instance(module, imports);
memory = exports.memory;
try {
  exports._start();
} catch (error) {
  if (error !== exit) throw error;
}
