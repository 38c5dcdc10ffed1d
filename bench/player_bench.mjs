// SPDX-License-Identifier: Apache-2.0
// player_bench.mjs STREAM: the WebAssembly player in Node, looked at: a step of the clip and 2 degrees of the eye at once,
// around what is shown, by an estimated error of one pixel of 1280 x 960. Processor milliseconds of the step (decoding)
// and of the cut with its buffers. LIMBER_WEB: the folder that scripts/build-web made.
import { readFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { quantile } from '../tests/web/browser.mjs';

const { Player } = await import(pathToFileURL(resolve(join(process.env.LIMBER_WEB, 'package/player.js'))));
const player = await Player.create();
player.append(readFileSync(process.argv[2]));
const cut = player.createCut();
const { positions } = cut.update({ by: 'level', level: 0 });
const low = [Infinity, Infinity, Infinity];
const high = low.map((x) => -x);
positions.forEach((x, i) => {
  low[i % 3] = Math.min(low[i % 3], x);
  high[i % 3] = Math.max(high[i % 3], x);
});
const target = low.map((x, k) => (x + high[k]) / 2);
const distance = 2 * Math.hypot(...low.map((x, k) => high[k] - x));

const REPEAT = 10;
const WARM = 2; // runs that are not counted
const now = () => process.cpuUsage().user / 1000;
const steps = [];
const cuts = [];
const vertices = [];
let turn = 0;
for (let run = 0; run < REPEAT; ++run) {
  for (let frame = 0; frame < player.info.frameCount; ++frame) {
    turn += Math.PI / 90;
    const eye = [target[0] + distance * Math.cos(turn), target[1] + 0.3 * distance, target[2] + distance * Math.sin(turn)];
    const start = now();
    player.seek(frame);
    const sought = now();
    const mesh = cut.update({ by: 'error', errorBound: 1, view: { camera: { eye, target }, width: 1280, height: 960 } });
    const done = now();
    if (run < WARM) continue;
    steps.push(sought - start);
    cuts.push(done - sought);
    vertices.push(mesh.vertexCount);
  }
}
const times = (values) => `${quantile(values, 0.5).toFixed(2)} median, ${quantile(values, 0.95).toFixed(2)} 95th percentile`;
console.log(`${cuts.length} frames, ${quantile(vertices, 0.5)} vertices in the median; processor milliseconds
decoding a step   ${times(steps)}
cut and buffers   ${times(cuts)}`);
