// SPDX-License-Identifier: Apache-2.0
// viewer_bench.mjs [--seconds N] STREAM [TRIANGLES]...: the viewer in Chromium on each stream, at so many triangles: what
// it has loaded when the first picture stands, then how it plays for N seconds (60). See tests/web/browser.mjs for the
// variables, and for what is measured.
import { statSync } from 'node:fs';
import { basename } from 'node:path';
import { PATIENCE, launch, measurePlay, quantile, serve, watch } from '../tests/web/browser.mjs';

const words = process.argv.slice(2);
let seconds = 60;
if (words[0] === '--seconds') seconds = Number(words.splice(0, 2)[1]);
const mega = (bytes) => `${(bytes / 1e6).toFixed(2)} MB`;
const { browser, pid, close } = await launch();
console.log(await browser.version(), '- 1280 x 800, software rendering; milliseconds for each frame shown: median, 95th percentile');
const times = (values) => `${quantile(values, 0.5).toFixed(1)}, ${quantile(values, 0.95).toFixed(1)}; at most ${Math.max(...values).toFixed(1)}`;
const tasks = ({ longTasks }) =>
  `${longTasks.length} over 50 ms${longTasks.length ? `, the longest ${Math.max(...longTasks).toFixed(0)}` : ''}`;

// A page that plays.
async function open(url, triangles) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 } });
  const page = await context.newPage();
  page.setDefaultTimeout(PATIENCE);
  await watch(page);
  await page.goto(`${url}#triangles=${triangles}`);
  await page.waitForFunction(() => limberViewer.state.framesShown > 30);
  return page;
}

for (let i = 0; i < words.length; i += 2) {
  const { url, stop } = await serve(words[i]);
  const page = await open(url, words[i + 1]);
  const first = await page.evaluate(() => limberViewer.state.bytesAtFirstPicture);
  const played = await measurePlay(page, pid, seconds);
  const { triangles } = await page.evaluate(() => limberViewer.state.shown);
  await page.context().close();
  const other = await open(url, words[i + 1]);
  const unseen = await measurePlay(other, pid, seconds, { draws: false });
  await other.context().close();
  stop();
  console.log(`${basename(words[i])}, ${triangles} triangles
  first picture    after ${mega(first)} of ${mega(statSync(words[i]).size)}
  played           ${played.frames} frames in ${seconds} s; ${unseen.frames} where nothing is drawn
  own work         ${times(played.own)}
  calls to WebGL   ${times(played.drawing)}
  long tasks       ${tasks(played)}; ${tasks(unseen)} where nothing is drawn
  memory           ${mega(played.heapGrowth)} more on the page's heap, ${mega(played.residentGrowth)} more resident than ${mega(played.resident)}`);
}
await close();
