// A link that holds the scene: '#' and the text, deflated, in base64url; in the manual, percent-encoded.

const LINK_MOST = 32768;

async function through(bytes, stream) {
  return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());
}

// The address of the text. Files that are no example's have their hashes in it; null if it would be too long.
async function linkOf(text) {
  const edits = assetsOf(text).filter(({ name }) => { const file = files.get(name); return file && file.sha256 && !file.isExample; })
    .map(({ name, from, to }) => ({ from, to, text: `"sha256:${files.get(name).sha256}"` }));
  const bytes = await through(new TextEncoder().encode(withKeys(text, {}, edits)), new CompressionStream('deflate-raw'));
  const code = btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join('')).replace(/\+/g, '-').replace(/\//g, '_').replace(/=/g, '');
  return code.length > LINK_MOST ? null : location.href.replace(/#.*/, '') + '#' + code;
}

async function textOfLink() {
  const code = location.hash.slice(1);
  if (code.length < 8) return null;
  try {
    if (code.startsWith('%7B')) return decodeURIComponent(code);
    const bytes = Uint8Array.from(atob(code.replace(/-/g, '+').replace(/_/g, '/')), (c) => c.charCodeAt(0));
    return new TextDecoder().decode(await through(bytes, new DecompressionStream('deflate-raw')));
  } catch {
    return null;
  }
}
