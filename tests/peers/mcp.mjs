// mcp.mjs FOLDER URL ZRASTER: clients of MCP by others, from FOLDER/node_modules, ask the daemon at URL and the program
// ZRASTER. Every structured answer is checked by ajv. Prints TAP.
import { createRequire } from "node:module";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import assert from "node:assert";

const [folder, url, zraster] = process.argv.slice(2);
const require = createRequire(resolve(folder, "x.js"));
const load = async (name) => {
    const found = await import(pathToFileURL(require.resolve(name)));
    return found.default && !found.Client ? { ...found.default, ...found } : found;
};
const modern = await load("@modelcontextprotocol/client");
const modernStdio = await load("@modelcontextprotocol/client/stdio");
const old = await load("@modelcontextprotocol/sdk/client/index.js");
const oldHttp = await load("@modelcontextprotocol/sdk/client/streamableHttp.js");
const oldStdio = await load("@modelcontextprotocol/sdk/client/stdio.js");
const Ajv = (await load("ajv/dist/2020.js")).default;
const ajv = new Ajv({ strict: false });

const box =
    [0, 5].flatMap((z) => [0, 10].flatMap((y) => [0, 20].map((x) => `v ${x} ${y} ${z}\n`))).join("") +
    "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
const root = mkdtempSync("/tmp/zraster-peers-");
writeFileSync(join(root, "box.obj"), box);

let count = 0, failed = 0;
const test = async (name, body) => {
    try {
        await body();
        console.log(`ok ${++count} - ${name}`);
    } catch (error) {
        failed++;
        console.log(`not ok ${++count} - ${name}`);
        console.error(name, error);
    }
};

// What every client does: list, call each tool, meet an error that can be mended and one that cannot.
const use = async (client, transport, model) => {
    await client.connect(transport);
    const { tools } = await client.listTools();
    assert.deepEqual(tools.map((tool) => tool.name), ["render", "facts", "pick"]);
    for (const tool of tools) ajv.compile(tool.inputSchema);
    const call = async (name, args) => {
        const result = await client.callTool({ name, arguments: { model, ...args } });
        if (!result.isError) {
            const valid = ajv.compile(tools.find((tool) => tool.name === name).outputSchema);
            assert(valid(result.structuredContent), ajv.errorsText(valid.errors));
        }
        return result;
    };
    assert.equal((await call("facts", {})).structuredContent.volume, 1000);
    const drawn = await call("render", { views: ["front", "isometric"] });
    assert.deepEqual(drawn.content.map((block) => block.type), ["text", "text", "image", "text", "image"]);
    const sheet = await call("render", {});
    assert.equal(sheet.structuredContent.views.length, 4);
    const picked = await call("pick", { views: ["front"], x: 400, y: 300 });
    assert(picked.structuredContent.hit);
    const wrong = await call("render", { look: "studoi" });
    assert(wrong.isError && wrong.content[0].text.includes("did you mean studio?"));
    let refused = false;
    try {
        refused = (await client.callTool({ name: "rendr", arguments: {} })).isError;
    } catch (error) {
        refused = true;
    }
    assert(refused);
    await client.close();
};

const who = { name: "peer", version: "1" };
const http = () => [new modern.StreamableHTTPClientTransport(new URL(url)), { text: box }];
const pipe = () => [new modernStdio.StdioClientTransport({ command: zraster, args: ["mcp", "--root", root] }), { path: "box.obj" }];
const modes = { default: undefined, auto: "auto", pinned: { pin: "2026-07-28" }, legacy: "legacy" };
for (const [mode, value] of Object.entries(modes))
    for (const [way, make] of [["HTTP", http], ["stdio", pipe]])
        await test(`client ${mode} over ${way}`, async () =>
            use(new modern.Client(who, value ? { versionNegotiation: { mode: value } } : {}), ...make()));
await test("sdk over HTTP", async () =>
    use(new old.Client(who), new oldHttp.StreamableHTTPClientTransport(new URL(url)), { text: box }));
await test("sdk over stdio", async () =>
    use(new old.Client(who), new oldStdio.StdioClientTransport({ command: zraster, args: ["mcp", "--root", root] }), { path: "box.obj" }));
rmSync(root, { recursive: true });
console.log(`1..${count}`);
process.exit(failed ? 1 : 0);
