// SPDX-License-Identifier: Apache-2.0
// bundle.mjs BUILD_FOLDER OUTPUT.html: the viewer as one page: its script with three.js, its style, the worker and the
// player's module inside. BUILD_FOLDER holds node_modules and package/player.wasm (scripts/build-web).
import { mkdirSync, readFileSync, renameSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const [folder, output] = process.argv.slice(2).map((name) => resolve(name));
const web = dirname(fileURLToPath(import.meta.url));
const esbuild = createRequire(join(folder, 'node_modules/'))('esbuild');

function bundle(entry, options = {}) {
  const built = esbuild.buildSync({
    entryPoints: [join(web, entry)],
    bundle: true,
    minify: true,
    write: false,
    format: 'iife',
    target: 'es2022',
    nodePaths: [join(folder, 'node_modules')],
    external: ['node:*'],
    define: { 'import.meta.url': '"https://limber.invalid/"' },
    legalComments: 'none',
    ...options,
  });
  return built.outputFiles[0].text;
}

// Nothing within a script may end it.
const inScript = (text) => text.replaceAll('</script', '<\\/script').replaceAll('<!--', '<\\!--');

const worker = bundle('player-worker.js');
const script = bundle('viewer/main.js', {
  define: {
    'import.meta.url': '"https://limber.invalid/"',
    LIMBER_WORKER: JSON.stringify(worker),
    LIMBER_MODULE: JSON.stringify(readFileSync(join(folder, 'package/player.wasm')).toString('base64')),
  },
});
const style = bundle('viewer/style.css', { loader: { '.css': 'css' } });
const page = readFileSync(join(web, 'viewer/index.html'), 'utf8')
  .replace('/* style */', () => style)
  .replace('/* script */', () => inScript(script));
mkdirSync(dirname(output), { recursive: true });
writeFileSync(`${output}.part`, page);
renameSync(`${output}.part`, output);
