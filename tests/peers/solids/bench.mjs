// bench.mjs BUILD MODULES ROUNDS: two spheres of 65 024 triangles, compared over HTTP on two threads, in turns with the three
// boolean operations of manifold-3d that give the same volumes. Least time of each; of ours also the median processor time.
import { pathToFileURL } from "node:url";

import { compare, processor, start } from "./daemon.mjs";
import { solid, sphere, stl } from "./meshes.mjs";

const [build, modules, rounds] = process.argv.slice(2);
const peer = await (await import(pathToFileURL(`${modules}/node_modules/manifold-3d/manifold.js`))).default();
peer.setup();

const meshes = [sphere(128, 256, [0, 0, 0], 1), sphere(128, 256, [0.25, 0.1, 0.05], 1)], files = meshes.map(stl);
const daemon = await start(build, "--threads=2");

async function booleans() {
    const [a, b] = meshes.map((one) => solid(peer, one)), both = a.intersect(b), onlyA = a.subtract(b), onlyB = b.subtract(a);
    const volumes = [both.volume(), onlyA.volume(), onlyB.volume()];
    for (const one of [a, b, both, onlyA, onlyB]) one.delete();
    return volumes;
}

const rows = [
    ["volumes and regions", 80, () => compare(daemon, ...files, "?deviation=off&features=off")],
    ["volumes, regions and a picture", 80, () => compare(daemon, ...files, "?show=difference&deviation=off&features=off")],
    ["all numbers", NaN, () => compare(daemon, ...files)],
    ["deviation map", 300, () => compare(daemon, ...files, "?show=deviation")],
    ["manifold-3d: both, onlyA, onlyB", NaN, booleans],
].map(([name, goal, run]) => ({ name, goal, run, times: [], work: [] }));
for (let round = 0; round < Number(rounds); round++)
    for (const row of rows) {
        const before = processor(daemon.pid), begin = performance.now();
        row.result = await row.run();
        row.times.push(performance.now() - begin);
        row.work.push(processor(daemon.pid) - before);
    }
daemon.stop();
console.log("| two spheres of 65 024 triangles | ms, least | processor ms, median | goal |\n|---|---|---|---|");
for (const { name, goal, times, work } of rows) {
    const middle = work.sort((x, y) => x - y)[work.length >> 1];
    console.log(`| ${name} | ${Math.min(...times).toFixed(0)} | ${middle > 0 ? middle : "-"} | ${goal || "-"} |`);
}
const ours = rows[0].result.volume, theirs = rows[4].result;
console.log(`both ${ours.both} (theirs ${theirs[0]}), onlyA ${ours.onlyA} (${theirs[1]}), onlyB ${ours.onlyB} (${theirs[2]}); stated error ${ours.volumeError}`);
