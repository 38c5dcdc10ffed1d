// SPDX-License-Identifier: Apache-2.0
// The WebAssembly player in Node. LIMBER_WEB: the folder that scripts/build-web made; LIMBER_PROGRAM, LIMBER_DUMP_CUTS:
// programs of the build; LIMBER_DATA: the real clips, if any.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { gzipSync } from 'node:zlib';

const web = process.env.LIMBER_WEB;
const { LimberError, Player } = await import(pathToFileURL(join(web, 'package/player.js')));
const folder = mkdtempSync(join(tmpdir(), 'limber-web-'));
after(() => rmSync(folder, { recursive: true }));

function build(clip, name, options = []) {
  const file = join(folder, `${name}.limber`);
  execFileSync(process.env.LIMBER_PROGRAM, ['build', clip, '-o', file, '-q', ...options]);
  return file;
}
let sampleFile;
// Without keys at jumps: every fifth frame is one.
const sampleOptions = ['--keys', '5', '--restart', '0'];
const sample = () => (sampleFile ??= build('sample:collapse?vertices=1500&frames=20', 'collapse', sampleOptions));

async function playerOf(file) {
  const player = await Player.create();
  assert.equal(player.append(readFileSync(file)), true);
  return player;
}

function bytesOf(mesh) {
  const counts = Uint32Array.of(mesh.frame, mesh.vertexCount, mesh.triangleCount, mesh.swapCount);
  const arrays = [counts, Float32Array.of(mesh.rmsError, mesh.seenError), mesh.positions, mesh.normals, mesh.indices, mesh.nodes];
  arrays.push(mesh.levels, mesh.errors, mesh.moved);
  return Buffer.concat(arrays.map((a) => Buffer.from(a.buffer, a.byteOffset, a.byteLength)));
}

// The words of dump_cuts for the view of some options.
function wordsOf({ view, hold = false, enough = 0, blend = 0 }) {
  const blending = ['blend', String(blend)];
  if (!view) return blending;
  const { camera, silhouettes = 1, facingAway = 1, focus, along } = view;
  const words = ['silhouettes', silhouettes, 'away', facingAway, 'hold', hold ? 1 : 0, 'enough', enough];
  if (camera) words.push('eye', ...camera.eye, 'target', ...camera.target, 'step', ...camera.step);
  if (focus) words.push('focus', ...focus.center, focus.radius);
  if (along) words.push('along', ['x', 'y', 'z'].indexOf(along.axis), along.from, along.to);
  return [...blending, ...words.map(String)];
}

async function expectSameCuts(file, by, amount, looking = {}) {
  const criterion = ['level', 'vertices', 'triangles', 'error'].indexOf(by);
  const native = execFileSync(process.env.LIMBER_DUMP_CUTS, [String(criterion), String(amount), ...wordsOf(looking)], {
    input: readFileSync(file),
    maxBuffer: 1 << 30,
  });
  const player = await playerOf(file);
  const cut = player.createCut();
  const options = { by, level: amount, budget: amount, errorBound: amount, ...looking };
  const camera = looking.view?.camera;
  let eye = camera?.eye;
  let at = 0;
  let frames = 0;
  while (player.step()) {
    if (camera) {
      options.view = { ...options.view, camera: { ...camera, eye } };
      eye = eye.map((x, k) => x + camera.step[k]);
    }
    const bytes = bytesOf(cut.update({ ...options, fetch: { levels: true, errors: true, moved: true } }));
    assert.equal(Buffer.compare(bytes, native.subarray(at, at + bytes.length)), 0, `${file}, frame ${frames}, by ${by}`);
    at += bytes.length;
    ++frames;
  }
  assert.equal(at, native.length);
  assert.equal(frames, player.info.frameCount);
  cut.destroy();
  player.destroy();
}

test('the module is at most 60 KB compressed and imports nothing', async () => {
  const bytes = readFileSync(join(web, 'package/player.wasm'));
  const compressed = gzipSync(bytes, { level: 9 }).length;
  assert.ok(compressed <= 60_000, `${compressed} bytes`);
  assert.deepEqual(WebAssembly.Module.imports(await WebAssembly.compile(bytes)), []);
});

test('native and WebAssembly players give the same bytes on generated clips', async () => {
  for (const by of [['level', 2], ['vertices', 300], ['triangles', 700], ['error', 0.2]]) await expectSameCuts(sample(), ...by);
  await expectSameCuts(build('sample:flag?vertices=1500&frames=4', 'lossless', ['--lossless']), 'vertices', 500);
  await expectSameCuts(build('sample:gallop?vertices=2000&frames=5', 'gallop'), 'triangles', 1500);
});

// A camera that comes nearer and turns, and everything else that a view can say.
const camera = (scale) => ({
  eye: [2.5 * scale, 0.75 * scale, 2 * scale],
  target: [0.25 * scale, 0.125 * scale, 0],
  step: [-0.0625 * scale, 0, -0.03125 * scale],
});
const views = (scale) => [
  ['error', 2, { view: { camera: camera(scale) } }],
  ['error', 4, { view: { camera: camera(scale) }, hold: true }],
  ['triangles', 600, { view: { camera: camera(scale), silhouettes: 4, facingAway: 8 }, enough: 1.5 }],
  ['vertices', 400, { view: { focus: { center: [0.25 * scale, 0, 0], radius: 0.25 * scale } } }],
  ['vertices', 400, { view: { along: { axis: 'z', from: 0.5 * scale, to: -0.5 * scale } } }],
  ['error', 0.5, {
    view: {
      camera: camera(scale), silhouettes: 2, facingAway: 2,
      focus: { center: [0, 0.25 * scale, 0], radius: 0.5 * scale }, along: { axis: 'x', from: -scale, to: scale },
    },
  }],
];

test('native and WebAssembly players give the same bytes when looked at', async () => {
  for (const view of views(1)) await expectSameCuts(sample(), ...view);
});

test('native and WebAssembly players give the same bytes where changes are blended', async () => {
  for (const [by, amount] of [['vertices', 300], ['triangles', 700], ['error', 0.2]]) await expectSameCuts(sample(), by, amount, { blend: 4 });
  await expectSameCuts(sample(), 'error', 2, { blend: 3, view: { camera: camera(1) } });
});

test('what is blended has vertices on their way, and in the end none', async () => {
  const player = await playerOf(sample());
  const cut = player.createCut();
  const { nodeCount, levelSizes } = player.info;
  const options = { by: 'vertices', budget: 300, blend: 4, fetch: { levels: true, errors: true } };
  const moving = (mesh) => mesh.nodes.reduce((sum, node) => sum + (node >= nodeCount ? 1 : 0), 0);
  player.seek(10);
  assert.equal(moving(cut.update(options)), 0); // the first is shown as it is
  player.seek(11);
  const mesh = cut.update(options);
  assert.ok(moving(mesh) > 0);
  assert.ok(mesh.levels.every((level) => level < levelSizes.length));
  assert.ok(mesh.errors.every((error) => error >= 0));
  assert.equal(moving(cut.update({ ...options, blend: 0 })), 0);
});

test('a view outside its ranges is refused, and the next one is not', async () => {
  const player = await playerOf(sample());
  const cut = player.createCut();
  const refuse = (view) => assert.throws(() => cut.update({ view }), { code: 'wrong-call' });
  refuse({ camera: { eye: [NaN, 0, 0], target: [0, 0, 0] } });
  refuse({ camera: { eye: [0, 0, 1], target: [0, 0, 0], fov: 0 } });
  refuse({ focus: { center: [0, 0, 0], radius: 0 } });
  refuse({ along: { axis: 'w', from: 0, to: 1 } });
  const mesh = cut.update({ by: 'error', errorBound: 3, view: { camera: { eye: [0, 0.5, 3], target: [0, 0, 0] } } });
  assert.ok(mesh.seenError > 0 && mesh.seenError <= 3, `${mesh.seenError} pixels`);
});

const data = process.env.LIMBER_DATA ?? join(web, '../../data');
const horse = data && existsSync(join(data, 'horse-gallop/0001.obj'));
test('native and WebAssembly players give the same bytes on real clips', { skip: horse ? false : 'no real clips here' }, async () => {
  const file = build(join(data, 'horse-gallop/%04d.obj'), 'horse', ['--last', '12']);
  for (const by of [['vertices', 800], ['triangles', 6000], ['error', 0.1], ...views(0.5)]) await expectSameCuts(file, ...by);
});

test('bytes may arrive one at a time', async () => {
  const player = await Player.create();
  const bytes = readFileSync(build('sample:flag?vertices=200&frames=5', 'small'));
  let frames = 0;
  for (let i = 0; i < bytes.length; ++i) {
    player.append(bytes.subarray(i, i + 1));
    while (player.info && player.step()) ++frames;
  }
  assert.equal(frames, 5);
});

test('a seek needs no more than its key and what follows', async () => {
  const bytes = readFileSync(sample());
  const player = await Player.create();
  player.setSize(bytes.length);
  let fetched = 0;
  for (let range; (range = player.missing(12)); fetched += range.size)
    player.supply(range.offset, bytes.subarray(range.offset, range.offset + range.size));
  assert.equal(player.seek(12), true);
  assert.equal(player.shownFrame, 12);
  assert.equal(player.frame(12).key, 10);
  assert.equal(player.frame(19).isThere, false);
  assert.equal(player.seek(3), false);
  assert.equal(player.info.bytesThere, fetched);
  assert.ok(fetched < bytes.length / 2, `${fetched} of ${bytes.length}`);
});

test('errors have a code and one line that names the place', async () => {
  const player = await Player.create();
  assert.throws(() => player.append(Buffer.from('<!doctype html>')), (error) => {
    assert.ok(error instanceof LimberError);
    assert.equal(error.code, 'bad-stream');
    assert.match(error.message, /not a \.limber stream/);
    return true;
  });
  const damaged = Buffer.from(readFileSync(sample()));
  const good = await playerOf(sample());
  const { offset, size } = good.frame(7);
  damaged[offset + (size >> 1)] ^= 1;
  const other = await Player.create();
  other.append(damaged);
  assert.throws(() => other.seek(8), /frame 7, byte/);
  assert.equal(other.shownFrame, null);
  assert.equal(other.seek(11), true);
  assert.throws(() => good.createCut().update({ by: 'colour' }), /by level, vertices, triangles or error/);
});

test('a player on a worker answers the last question, and takes its arrays back', async () => {
  // Node has no workers of this kind: the same code runs beside the test.
  const { WorkerPlayer } = await import(pathToFileURL(join(web, 'package/worker-player.js')));
  const player = new WorkerPlayer();
  const info = await player.open(readFileSync(sample()));
  assert.equal(info.frameCount, 20);
  const cuts = [{ by: 'vertices', budget: 200, fetch: { labels: true, levels: true } }, { by: 'level', level: 0 }];
  for (const frame of [3, 17, 0]) {
    const shown = await player.show(frame, cuts);
    assert.equal(shown.frame, frame);
    assert.equal(shown.meshes[1].vertexCount, info.vertexCount);
    assert.equal(shown.meshes[0].labels.length, info.vertexCount);
    assert.ok(shown.meshes[0].vertexCount <= 200);
    player.recycle(shown);
  }
  await assert.rejects(player.show(20, cuts), /has no frame 20/);
  player.close();
  const other = new WorkerPlayer();
  await assert.rejects(other.open(Buffer.from('something else, not a stream')), { code: 'bad-stream' });
  other.close();
});

test('memory stays as it is while playing', async () => {
  const player = await playerOf(sample());
  const cut = player.createCut();
  const playThrough = () => {
    for (let frame = 0; frame < 20; ++frame) {
      player.seek(frame);
      cut.update({ by: 'vertices', budget: 500, fetch: { errors: true, moved: true, levels: true } });
      const eye = [2, 1, 2 - frame / 20];
      cut.update({ by: 'error', errorBound: 3, view: { camera: { eye, target: [0, 0, 0] } }, hold: frame % 5 === 0 });
    }
  };
  playThrough();
  const before = player.wasm.memory.buffer.byteLength;
  for (let i = 0; i < 20; ++i) playThrough();
  assert.equal(player.wasm.memory.buffer.byteLength, before);
});

test('the packed package works in a fresh folder', () => {
  const npm = (args, cwd) => execFileSync('npm', [...args, '--offline', '--no-audit', '--no-fund'], { cwd, encoding: 'utf8' });
  const packed = npm(['pack', join(web, 'package'), '--pack-destination', folder, '--json'], folder);
  const [{ filename, files }] = JSON.parse(packed);
  assert.ok(files.some((file) => file.path === 'player.d.ts'));
  npm(['install', '--prefix', folder, '--legacy-peer-deps', join(folder, filename)], folder);
  const script = `
    import { Player } from 'limber-player';
    import { readFileSync } from 'node:fs';
    const player = await Player.create();
    player.append(readFileSync(process.argv[2]));
    console.log(player.createCut().update({ by: 'vertices', budget: 100 }).vertexCount);`;
  execFileSync('sh', ['-c', 'cat >try.mjs'], { cwd: folder, input: script });
  const said = execFileSync(process.execPath, ['try.mjs', sample()], { cwd: folder, encoding: 'utf8' });
  assert.ok(Number(said) > 10 && Number(said) <= 100, said);
});
