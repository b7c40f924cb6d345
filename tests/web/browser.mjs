/* browser.mjs - a page in a headless Chromium, which is installed. */
import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { existsSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { extname, join } from 'node:path';

const TYPES = { '.mjs': 'text/javascript', '.js': 'text/javascript', '.wasm': 'application/wasm', '.html': 'text/html' };
const CHROMIUM = ['--headless=new', '--no-sandbox', '--disable-dev-shm-usage', '--no-first-run', '--disable-background-networking'];

/** Begin of the scripts of pages: say(NAME, BYTES or TEXT) hands a result over; say('end', FAULT) ends the visit. */
export const SAY = `const to = new URLSearchParams(location.search).get('to');
const say = (name, body) => fetch(to + 'got/' + name, { method: 'POST', mode: 'no-cors', body });
`;

/** Opens a page and returns a Map of what it said. fileOf(PATH) is a file, a text of HTML or null; address: of another server that has the page. */
export async function visit(fileOf, { address, flags = ['--disable-gpu'], seconds = 120 } = {}) {
  const got = new Map();
  let finish;
  const finished = new Promise(resolve => (finish = resolve));
  const server = createServer(async (request, response) => {
    const parts = [], path = new URL(request.url, 'http://page').pathname;
    for await (const part of request) parts.push(part);
    if (path.startsWith('/got/')) got.set(path.slice(5), Buffer.concat(parts));
    const found = path.startsWith('/got/') ? '' : fileOf(path), isPage = found === '' || found?.startsWith('<');
    response.setHeader('Content-Type', isPage ? 'text/html' : TYPES[extname(found ?? '')] ?? 'application/octet-stream');
    try {
      response.end(isPage ? found : readFileSync(found));
    } catch {
      response.writeHead(404).end();
    }
    if (path === '/got/end') finish();
  }).listen(0, '127.0.0.1');
  await once(server, 'listening');
  const profile = mkdtempSync(join(tmpdir(), 'zraster-')), own = `http://127.0.0.1:${server.address().port}/`;
  const words = [...CHROMIUM, ...flags, `--user-data-dir=${profile}`, `${address ?? own}?to=${own}`];
  const browser = spawn(process.env.CHROMIUM || 'chromium', words, { stdio: 'ignore', detached: true });
  const timer = setTimeout(() => { got.set('end', Buffer.from(`Chromium said nothing for ${seconds} s`)); finish(); }, 1000 * seconds);
  await finished;
  clearTimeout(timer);
  process.kill(-browser.pid, 'SIGKILL'); /* with its children, which write to the profile */
  await once(browser, 'exit');
  server.close();
  server.closeAllConnections();
  for (let i = 0; existsSync(profile); i++) {
    try {
      rmSync(profile, { recursive: true, force: true });
    } catch (error) {
      if (i === 50) throw error;
      await new Promise(done => setTimeout(done, 100));
    }
  }
  return got;
}
