// agree.js - compares the schema of scenes, read by ajv, with a daemon.
//
//     node agree.js URL COUNT SEED FILE.json...
//
// Each file has to be valid and drawn. COUNT random scenes, half of them broken on purpose: a scene that the schema
// refuses is refused by the daemon; one that it accepts is drawn, or refused for reasons of unsayable.json alone, which
// no schema can say. Ends with status 1 after a difference. NODE_PATH leads to ajv.
'use strict';
const fs = require('fs');
const path = require('path');
const { Ajv2020 } = require('ajv/dist/2020');
const { Scenes } = require('./scenes.js');

const [url, count, seed, ...files] = process.argv.slice(2);
const reasons = JSON.parse(fs.readFileSync(path.join(__dirname, 'unsayable.json'), 'utf8')).map((row) => ({ ...row, pattern: new RegExp(row.detail), used: 0 }));

async function draw(scene) {
    for (;;) {
        const answer = await fetch(`${url}/v1/render`, { method: 'POST', headers: { 'content-type': 'application/json' }, body: typeof scene === 'string' ? scene : JSON.stringify(scene) });
        const bytes = Buffer.from(await answer.arrayBuffer());
        if (answer.status === 200) return [];
        const problem = JSON.parse(bytes.toString());
        if (answer.status === 503) continue;
        return problem.errors && problem.errors.length ? problem.errors : [{ pointer: '', detail: problem.detail }];
    }
}

/* Returns the faults for which there is no reason. */
function unexplained(faults) {
    return faults.filter((fault) => {
        const reason = reasons.find((row) => row.pattern.test(`${fault.pointer}: ${fault.detail}`));
        if (reason) reason.used++;
        return !reason;
    });
}

async function main() {
    const schema = await (await fetch(`${url}/v1/scene.schema.json`)).json();
    const ajv = new Ajv2020({ strict: true, strictTypes: false, strictRequired: false });
    const validate = ajv.compile(schema);
    const differences = [];
    const tell = (scene, text) => differences.push(`${text}\n    ${JSON.stringify(scene).slice(0, 700)}`);
    for (const file of files) {
        const text = fs.readFileSync(file, 'utf8');
        if (!validate(JSON.parse(text))) tell(file, `refused by the schema: ${ajv.errorsText(validate.errors)}`);
        for (const fault of await draw(text)) tell(file, `refused by the daemon: ${fault.pointer}: ${fault.detail}`);
    }
    console.log(`${files.length} files: valid and drawn, but for ${differences.length}`);
    const small = files.map((file) => fs.readFileSync(file, 'utf8')).filter((text) => text.length < 20000);
    const scenes = new Scenes(schema, small, Number(seed));
    const counts = { drawn: 0, refused: 0, unsayable: 0 };
    const work = Array.from({ length: Number(count) }, (_, i) => scenes.next(i % 2 === 1));
    await Promise.all(Array.from({ length: 3 }, async () => {
        for (let scene; (scene = work.pop()) !== undefined;) {
            const isValid = validate(scene), errors = validate.errors;
            const faults = await draw(scene);
            if (isValid && faults.length === 0) counts.drawn++;
            else if (!isValid && faults.length > 0) counts.refused++;
            else if (!isValid) tell(scene, `drawn, but refused by the schema: ${ajv.errorsText(errors)}`);
            else {
                const strange = unexplained(faults);
                if (strange.length === 0) counts.unsayable++;
                else tell(scene, `accepted by the schema, but refused: ${strange.map((fault) => `${fault.pointer}: ${fault.detail}`).join(' | ')}`);
            }
        }
    }));
    console.log(`${count} random scenes, seed ${seed}: ${counts.drawn} drawn, ${counts.refused} refused by both, ${counts.unsayable} refused for reasons that no schema says`);
    for (const row of reasons) if (process.env.VERBOSE) console.log(`  ${String(row.used).padStart(5)}  ${row.reason}`);
    for (const text of differences.slice(0, Number(process.env.SHOWN ?? 20))) console.log(`DIFFERENCE: ${text}`);
    console.log(`${differences.length} differences`);
    process.exitCode = differences.length > 0 ? 1 : 0;
}

main();
