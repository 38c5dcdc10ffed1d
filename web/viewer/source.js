// SPDX-License-Identifier: Apache-2.0
// Which stream the page shows: one inside the page, one that its address names, or none until somebody chooses one.

export const bytesFromBase64 = (text) => {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
};

// {name, from}, or null.
export function streamOfPage() {
  const inside = document.getElementById('limber-stream');
  if (inside) {
    const bytes = bytesFromBase64(inside.textContent.trim());
    inside.remove();
    return { name: inside.dataset.name, from: bytes };
  }
  const address = new URLSearchParams(location.search).get('stream');
  if (!address) return null;
  const url = new URL(address, location.href);
  return { name: decodeURIComponent(url.pathname.split('/').at(-1)), from: url };
}

// What the part after the # says: #vertices=800&compare=split&frame=12&paused
export function settingsOfPage() {
  const said = new URLSearchParams(location.hash.slice(1));
  const settings = Object.fromEntries(said);
  for (const by of ['triangles', 'vertices', 'pixels', 'error', 'level']) {
    if (said.has(by)) Object.assign(settings, { by, amount: Number(said.get(by)) });
  }
  return settings;
}
