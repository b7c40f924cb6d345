// judge.mjs BUILD MODULES PAIRS SEED: volumes that random pairs of solids share, beside those of manifold-3d: the stated error holds
// for each, and the median error of the IoU is at most 5e-6. Pairs with a thin plate are compared with precision=quick, too.
import { pathToFileURL } from "node:url";

import { compare, start } from "./daemon.mjs";
import { mesh, solid, stl } from "./meshes.mjs";

const [build, modules, pairs, seed] = process.argv.slice(2);
const peer = await (await import(pathToFileURL(`${modules}/node_modules/manifold-3d/manifold.js`))).default();
peer.setup();
const { Manifold } = peer;

let state = Number(seed) >>> 0;
function random(low = 0, high = 1) {
    state = (state + 0x6d2b79f5) >>> 0;
    let x = Math.imul(state ^ (state >>> 15), state | 1);
    x = (x + Math.imul(x ^ (x >>> 7), x | 61)) ^ x;
    return low + ((high - low) * ((x ^ (x >>> 14)) >>> 0)) / 2 ** 32;
}

const plate = () => Manifold.cube([random(1, 2), random(1, 2), random(0.005, 0.02)], true);
const kinds = {
    box: () => Manifold.cube([random(0.5, 2), random(0.5, 2), random(0.5, 2)], true),
    plate,
    sphere: () => Manifold.sphere(random(0.5, 1), 24 + 8 * Math.floor(random(0, 8))),
    cylinder: () => Manifold.cylinder(random(0.5, 2), random(0.2, 0.8), random(0.2, 0.8), 16 + Math.floor(random(0, 48)), true),
    ball: () => Manifold.sphere(0.8, 48).subtract(Manifold.cube([0.5, 0.5, 3], true)).subtract(Manifold.cylinder(3, 0.2, 0.2, 24, true).rotate([90, 0, 0])),
    drilled: () => {
        let made = Manifold.cube([2, 1.4, 0.3], true);
        for (let hole = 0; hole < 4; hole++) made = made.subtract(Manifold.cylinder(1, 0.1, 0.1, 32, true).translate([random(-0.8, 0.8), random(-0.5, 0.5), 0]));
        return made;
    },
};
const names = Object.keys(kinds);
const placed = (made) => made.rotate([random(0, 360), random(0, 360), random(0, 360)]).translate([random(-0.4, 0.4), random(-0.4, 0.4), random(-0.4, 0.4)]);

/** Returns two solids: of any kinds, or one moved a little, or with a hole. */
function pair() {
    const first = names[Math.floor(random(0, names.length))], way = random(), a = kinds[first]();
    if (way < 0.4) {
        const second = names[Math.floor(random(0, names.length))];
        return [`${first}, ${second}`, placed(a), placed(kinds[second]())];
    }
    if (way < 0.7) return [`${first} moved`, a, a.rotate([random(-5, 5), 0, random(-5, 5)]).translate([random(0, 0.1), random(0, 0.1), 0])];
    return [`${first} cut`, a, a.subtract(Manifold.cylinder(4, random(0.02, 0.2), -1, 24, true).translate([random(-0.3, 0.3), random(-0.3, 0.3), 0]))];
}

const daemon = await start(build);
const errors = [];
let failed = 0, refused = 0;
async function check(name, a, b, query) {
    const meshes = [a, b].map(mesh), [first, second] = meshes.map((one) => solid(peer, one)), shared = first.intersect(second);
    const both = shared.volume(), onlyA = first.volume() - both, onlyB = second.volume() - both, iou = both / (both + onlyA + onlyB);
    for (const one of [first, second, shared]) one.delete();
    const { volume } = await compare(daemon, ...meshes.map(stl), query);
    if (!volume) {
        refused++;
        return;
    }
    const error = Math.abs(volume.iou - iou), most = Math.max(...[[volume.both, both], [volume.onlyA, onlyA], [volume.onlyB, onlyB]].map(([x, y]) => Math.abs(x - y)));
    const holds = error <= volume.error + 1e-7 && most <= volume.volumeError + 1e-7;
    if (!query.includes("quick")) errors.push(error);
    if (holds) return;
    failed++;
    console.log(`not ok: ${name}${query}: IoU ${volume.iou} for ${iou} (stated ${volume.error}), volumes off by ${most} (stated ${volume.volumeError})`);
}
for (let number = 0; number < Number(pairs); number++) {
    const [name, a, b] = pair();
    await check(`pair ${number}: ${name}`, a, b, "?deviation=off&features=off");
    if (name.includes("plate")) await check(`pair ${number}: ${name}`, a, b, "?deviation=off&features=off&precision=quick");
}
daemon.stop();
errors.sort((x, y) => x - y);
const median = errors[errors.length >> 1];
console.log(`${errors.length} pairs: median error of the IoU ${median.toExponential(1)}, largest ${errors[errors.length - 1].toExponential(1)}; stated errors exceeded: ${failed}; open: ${refused}`);
process.exit(failed > 0 || median > 5e-6 ? 1 : 0);
