// SPDX-License-Identifier: Apache-2.0
// Chromium and `limber view`, for tests and for bench/viewer_bench.mjs. LIMBER_WEB: the folder that scripts/build-web
// made; LIMBER_PROGRAM: the program; LIMBER_CHROMIUM names another Chromium than Debian's.
import { spawn } from 'node:child_process';
import { readFileSync, readdirSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';

export const chromium = process.env.LIMBER_CHROMIUM ?? '/usr/bin/chromium';

// How long anything may take, in milliseconds: a machine may be busy with much else.
export const PATIENCE = 180_000;

const ARGUMENTS = [
  '--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update',
  '--disable-sync', '--enable-unsafe-swiftshader', '--js-flags=--expose-gc', '--enable-precise-memory-info',
];

// {browser, pid, close}. A browser that does not come up is started once more.
export async function launch() {
  const { chromium: launcher } = createRequire(join(process.env.LIMBER_WEB, 'node_modules/'))('playwright-core');
  const start = () => launcher.launchServer({ executablePath: chromium, timeout: PATIENCE, args: ARGUMENTS });
  const server = await start().catch(start);
  const browser = await launcher.connect(server.wsEndpoint(), { timeout: PATIENCE });
  const close = async () => {
    await browser.close();
    await server.close();
  };
  return { browser, pid: server.process().pid, close };
}

// Starts `limber view`: {url, stop}.
export function serve(...options) {
  const child = spawn(process.env.LIMBER_PROGRAM, ['view', ...options, '--no-open', '-q']);
  return new Promise((resolve, reject) => {
    let said = '';
    child.stdout.on('data', (text) => {
      said += text;
      if (said.includes('\n')) resolve({ url: said.trim(), stop: () => child.kill('SIGINT') });
    });
    child.once('error', reject);
    child.once('exit', (code) => reject(new Error(`limber view ended with ${code}`)));
  });
}

// What is resident of the processes that show pages, in bytes.
export function residentBytes(browserPid) {
  const children = new Map();
  for (const pid of readdirSync('/proc').filter((name) => /^\d+$/.test(name))) {
    try {
      const parent = Number(/^PPid:\s*(\d+)/m.exec(readFileSync(`/proc/${pid}/status`, 'utf8'))[1]);
      children.set(parent, [...(children.get(parent) ?? []), Number(pid)]);
    } catch {
      // It has ended meanwhile.
    }
  }
  let sum = 0;
  const visit = (pid) => {
    try {
      if (readFileSync(`/proc/${pid}/cmdline`, 'utf8').includes('--type=renderer'))
        sum += 1024 * Number(/^VmRSS:\s*(\d+)/m.exec(readFileSync(`/proc/${pid}/status`, 'utf8'))[1]);
    } catch {
      return;
    }
    for (const child of children.get(pid) ?? []) visit(child);
  };
  visit(browserPid);
  return sum;
}

// Watches a page from its start: call before it is opened. What is measured is in the page's `watched`.
export const watch = (page) =>
  page.addInitScript(() => {
    globalThis.watched = { longTasks: [] };
    new PerformanceObserver((list) => {
      for (const entry of list.getEntries()) watched.longTasks.push(entry.duration);
    }).observe({ type: 'longtask', buffered: true });
  });

// Plays for so many seconds. Milliseconds of the viewer's own work for each frame that is shown (filling buffers, the
// timeline, three.js) and, apart from it, of the calls to WebGL, which software rendering makes slow; tasks of the main
// thread that took more than 50; frames shown; growth of memory. With `draws` false nothing is drawn: what is left is the
// viewer's own.
export async function measurePlay(page, pid, seconds, { draws = true } = {}) {
  const heap = () => page.evaluate(() => (gc(), performance.memory.usedJSHeapSize));
  await page.evaluate((isDrawing) => {
    const { stage, timeline } = limberViewer;
    if (!isDrawing) stage.renderer.render = () => {};
    let drawing = 0;
    let own = 0;
    const timed = (object, name, add) => {
      const act = object[name];
      object[name] = function timedCall(...args) {
        const start = performance.now();
        try {
          return act.apply(this, args);
        } finally {
          add(performance.now() - start);
        }
      };
    };
    watched.own = [];
    watched.drawing = [];
    timed(stage.renderer, 'render', (t) => (drawing += t));
    for (const [object, name] of [[stage, 'setMeshes'], [stage, 'draw'], [timeline, 'drawNow']]) timed(object, name, (t) => (own += t));
    let shown = limberViewer.state.framesShown;
    const note = () => {
      if (limberViewer.state.framesShown > shown) {
        shown = limberViewer.state.framesShown;
        watched.own.push(own - drawing);
        watched.drawing.push(drawing);
        own = drawing = 0;
      }
      requestAnimationFrame(note);
    };
    note();
  }, draws);
  const heapBefore = await heap();
  const residentBefore = residentBytes(pid);
  await page.evaluate(() => {
    watched.longTasks.length = watched.own.length = watched.drawing.length = 0;
  });
  await page.waitForTimeout(1000 * seconds);
  const { longTasks, own, drawing } = await page.evaluate(() => ({ ...watched }));
  return {
    frames: own.length, longTasks, own, drawing,
    heapGrowth: (await heap()) - heapBefore,
    residentGrowth: residentBytes(pid) - residentBefore,
    resident: residentBefore,
  };
}

export function quantile(values, part) {
  const sorted = [...values].sort((a, b) => a - b);
  return sorted[Math.min(sorted.length - 1, Math.floor(part * sorted.length))] ?? NaN;
}
