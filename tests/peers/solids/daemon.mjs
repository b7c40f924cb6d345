// A daemon of the build, and comparisons by it.
import { spawn } from "node:child_process";
import { readFileSync } from "node:fs";

/** Starts a daemon on a free port. */
export async function start(build, ...flags) {
    const child = spawn(`${build}/zrasterd`, ["--port=0", "--cost-max-ms=60000", ...flags], { stdio: ["ignore", "pipe", "pipe"] });
    const url = await new Promise((resolve, reject) => {
        let said = "";
        const listen = (bytes) => {
            said += bytes;
            const found = /listening on (http:\S+)/.exec(said);
            if (found) resolve(found[1]);
        };
        child.stdout.on("data", listen);
        child.stderr.on("data", listen);
        child.on("exit", (code) => reject(new Error(`zrasterd ended with ${code}: ${said}`)));
    });
    child.removeAllListeners("exit");
    return { url, pid: child.pid, stop: () => child.kill() };
}

/** Returns the processor time of a process so far, ms. */
export function processor(pid) {
    const words = readFileSync(`/proc/${pid}/stat`, "latin1").split(") ")[1].split(" ");
    return 10 * (Number(words[11]) + Number(words[12]));
}

/** Posts two models, bytes of STL. Returns the answer's numbers, or null with a picture alone. */
export async function compare(daemon, a, b, query = "") {
    const form = new FormData();
    form.append("a", new Blob([a], { type: "model/stl" }), "a.stl");
    form.append("b", new Blob([b], { type: "model/stl" }), "b.stl");
    const response = await fetch(`${daemon.url}/v1/compare${query}`, { method: "POST", body: form });
    const bytes = Buffer.from(await response.arrayBuffer());
    if (!response.ok) throw new Error(`${response.status}: ${bytes}`);
    return response.headers.get("content-type") === "application/json" ? JSON.parse(bytes) : null;
}
