// SPDX-License-Identifier: Apache-2.0
// The viewer: a stream (WorkerPlayer), its picture (Stage), where in it one is (Timeline, the clock), and the panel.
/* global LIMBER_WORKER, LIMBER_MODULE */
import { WorkerPlayer } from '../worker-player.js';
import { clusterColor, cssRamp, errorGradient, levelRamp } from './colors.js';
import { Color } from 'three';
import { Detail } from './detail.js';
import { icons } from './icons.js';
import { Looking } from './looking.js';
import { bytesFromBase64, settingsOfPage, streamOfPage } from './source.js';
import { Stage } from './stage.js';
import { Timeline } from './timeline.js';

const PREFETCH = 256 << 20; // bytes that are loaded without being looked at
const by = (id) => document.getElementById(id);
const format = (value, digits = 3) => value.toLocaleString('en', { maximumSignificantDigits: digits });
const count = (value) => value.toLocaleString('en');

function bytes(value) {
  if (value < 1000) return `${value} B`;
  return value < 1e6 ? `${format(value / 1e3)} kB` : `${format(value / 1e6)} MB`;
}

const workerUrl = URL.createObjectURL(new Blob([LIMBER_WORKER], { type: 'text/javascript' }));
const moduleBytes = bytesFromBase64(LIMBER_MODULE);
const settings = settingsOfPage();

const state = {
  player: null, info: null, source: null,
  frame: 0, wantedFrame: 0, clock: 0, isPlaying: false, isLooping: true, speed: 1,
  isShowing: false, needsShow: false, shown: null, framesShown: 0,
  look: { wireframe: false, flat: false, colors: 'none', flash: false },
  compare: 'off',
  blend: 0, // frames that a change takes
};

// ---- The picture

const stage = new Stage(by('canvas'), { onCamera: () => cameraMoved() });
const timeline = new Timeline(by('timeline'), { onSeek: (frame) => seek(frame) });
const detail = new Detail({
  by: by('by'), slider: by('amount'), number: by('number'), unit: by('unit'),
  onChange: () => cutChanged(),
});

const looking = new Looking({
  stage,
  controls: {
    seen: by('seen'), outlines: by('outlines'), focus: by('focus'), frozen: by('frozen'), along: by('along'), size: by('focus-size'),
  },
  onChange: () => {
    placeInset();
    cutChanged();
  },
});

function cutChanged() {
  timeline.forgetErrors();
  stage.errorScale = 0;
  show();
}

function cameraMoved() {
  if (!state.info) return;
  placeInset();
  if (looking.follows(detail.by)) show();
}

function cuts() {
  const { colors, flash } = state.look;
  const isCompared = state.compare !== 'off';
  const fetch = { errors: true, moved: true, levels: colors === 'levels', labels: isCompared && colors !== 'none' };
  const list = [{ ...detail.options(), view: looking.view(detail.by), blend: state.blend, fetch }];
  if (isCompared) list.push({ by: 'level', level: 0 });
  return list;
}

// Shows the wanted frame; what is wanted meanwhile is shown next.
async function show() {
  if (!state.info) return;
  state.needsShow = true;
  if (state.isShowing) return;
  state.isShowing = true;
  const { player } = state;
  let { last } = state;
  try {
    while (state.needsShow && state.player === player) {
      state.needsShow = false;
      const shown = await player.show(state.wantedFrame, cuts());
      if (!shown || state.player !== player) continue;
      use(shown);
      if (last) player.recycle(last); // what is shown is still painted from
      state.last = last = shown;
    }
  } catch (error) {
    if (state.player === player) fail(error);
  }
  if (state.player === player) state.isShowing = false;
}

function use({ frame, meshes, times, bytesThere }) {
  const [approximation, original = null] = meshes;
  state.bytesAtFirstPicture ??= bytesThere;
  state.frame = frame;
  state.shown = { frame, vertices: approximation.vertexCount, triangles: approximation.triangleCount, rmsError: approximation.rmsError, swaps: approximation.swapCount, seenError: approximation.seenError };
  if (stage.errorScale === 0) {
    stage.errorScale = 2.5 * (approximation.rmsError || state.info.tolerance || state.info.diagonal * 1e-4);
    drawLegend();
  }
  stage.setMeshes(approximation, original, approximation.labels);
  if (state.isFirstPicture) applySettings();
  timeline.setFrame(frame, { changes: approximation.swapCount, error: approximation.rmsError });
  ++state.framesShown;
  showNumbers(approximation, times);
}

function showNumbers(mesh, times) {
  const { info } = state;
  by('frame').innerHTML = `${state.frame + info.firstFrameNumber} <small>/ ${frameCount() - 1 + info.firstFrameNumber}</small>`;
  const part = (value, whole) => `${count(value)} <small>${format((100 * value) / Math.max(1, whole), 2)} %</small>`;
  by('s-triangles').innerHTML = part(mesh.triangleCount, info.triangleCount);
  by('s-vertices').innerHTML = part(mesh.vertexCount, info.vertexCount);
  by('s-error').innerHTML = `${format((100 * mesh.rmsError) / (info.diagonal || 1), 2)} <small>% of diagonal</small>`;
  const isSeen = looking.usesCamera(detail.by);
  by('s-seen').hidden = by('s-seen-name').hidden = !isSeen;
  by('s-seen').innerHTML = `${format(mesh.seenError, 2)} <small>px</small>`;
  let moved = 0;
  for (const one of mesh.moved) moved += one;
  by('s-moved').innerHTML = `${count(moved)} <small>of ${count(mesh.swapCount)} swaps</small>`;
  by('s-times').innerHTML = `${times.seek.toFixed(1)} + ${times.cut.toFixed(1)} <small>ms</small>`;
}

// ---- Time

const frameCount = () => state.info?.frameCount ?? state.info?.availableFrames ?? 0;

function seek(frame, { keepPlaying = true } = {}) {
  if (!state.info || frameCount() === 0) return;
  if (!keepPlaying) setPlaying(false);
  state.wantedFrame = Math.min(frameCount() - 1, Math.max(0, frame));
  state.clock = state.wantedFrame / state.info.framesPerSecond;
  timeline.setFrame(state.wantedFrame);
  show();
}

function setPlaying(isPlaying) {
  if (isPlaying && !state.isLooping && state.wantedFrame >= frameCount() - 1) seek(0);
  state.isPlaying = isPlaying && frameCount() > 1;
  by('play').innerHTML = state.isPlaying ? icons.pause : icons.play;
  by('play').setAttribute('aria-label', state.isPlaying ? 'Pause' : 'Play');
}

function advance(seconds) {
  const { info } = state;
  const isWaiting = state.isShowing && state.frame !== state.wantedFrame; // not for another look at the same frame
  if (!info || !state.isPlaying || isWaiting || timeline.isDragging) return;
  const length = frameCount() / info.framesPerSecond;
  state.clock += Math.min(seconds, 0.25) * state.speed;
  if (state.clock >= length) {
    if (state.isLooping && info.frameCount !== null) {
      state.clock %= length;
    } else {
      state.clock = length - 1e-6;
      if (info.frameCount !== null) setPlaying(false);
    }
  }
  const frame = Math.min(frameCount() - 1, Math.floor(state.clock * info.framesPerSecond));
  if (frame === state.wantedFrame) return;
  state.wantedFrame = frame;
  show();
}

let lastTime = performance.now();
const rate = { since: performance.now(), pictures: 0 };
function tick(now) {
  advance((now - lastTime) / 1000);
  lastTime = now;
  if (stage.draw(now)) ++rate.pictures;
  if (now - rate.since > 500) {
    by('s-rate').innerHTML = `${Math.round((1000 * rate.pictures) / (now - rate.since))} <small>per second</small>`;
    rate.since = now;
    rate.pictures = 0;
  }
  requestAnimationFrame(tick);
}

// ---- Streams

// `isAgain`: the same stream as before; where one was and from where one looked stays.
async function open(source, { isAgain = false } = {}) {
  state.player?.close();
  setPlaying(false);
  state.startFrame = isAgain ? state.wantedFrame : Number(settings.frame ?? 0) || 0;
  state.keepsCamera = isAgain;
  Object.assign(state, { player: null, info: null, source, isShowing: false, needsShow: false, shown: null, last: null, bytesAtFirstPicture: undefined });
  by('card').hidden = true;
  if (!isAgain) clearPicture();
  by('name').textContent = source.name;
  by('about').textContent = 'Loading…';
  document.title = `${source.name} – limber`;
  const player = new WorkerPlayer({ workerUrl, workerType: 'classic', module: moduleBytes });
  state.player = player;
  const listen = (name, act) => player.addEventListener(name, (event) => state.player === player && act(event.detail));
  listen('info', infoArrived);
  listen('progress', progressed);
  listen('failure', fail);
  await player.open(source.from, { prefetch: Number(settings.prefetch ?? PREFETCH) }).catch(() => {}); // 'failure' says it
}

// What is seen is never another stream's.
function clearPicture() {
  stage.clear();
  timeline.setStream(0);
  by('legend').hidden = true;
  for (const id of ['frame', 's-triangles', 's-vertices', 's-error', 's-seen', 's-moved', 's-times', 's-loaded']) by(id).textContent = '–';
}

function infoArrived({ info, sizes, keys }) {
  const isFirst = state.info === null;
  state.info = info;
  if (isFirst) {
    stage.setStream(info, state.keepsCamera);
    state.isFirstPicture = !state.keepsCamera;
    detail.setStream(info, { by: settings.by ?? detail.by, amount: settings.amount });
    timeline.setStream(frameCount(), info.firstFrameNumber);
    setPlaying(!('paused' in settings));
    seek(state.startFrame);
  }
  timeline.setFrames({ sizes, keys, frameCount: frameCount() });
  by('timeline').setAttribute('aria-valuemax', frameCount() - 1);
  const keyCount = keys.reduce((a, b) => a + b, 0);
  by('about').textContent = [
    `${count(info.vertexCount)} vertices`, `${count(info.triangleCount)} triangles`, `${count(frameCount())} frames`,
    `${info.levelSizes.length} levels`, `${keyCount} ${keyCount === 1 ? 'key' : 'keys'}`,
  ].map((fact) => fact.replace(' ', '\u00a0')).join(' · ');
}

function progressed({ bytesThere, size, there }) {
  state.bytesThere = bytesThere;
  timeline.setThere(there);
  const isWhole = size !== null && bytesThere >= size;
  by('s-loaded').innerHTML = isWhole || size === null ? bytes(bytesThere) : `${bytes(bytesThere)} <small>of ${bytes(size)}</small>`;
}

const HEADINGS = {
  'bad-stream': 'This stream cannot be read',
  unsupported: 'This stream is of another version of limber',
  'no-memory': 'This stream is too large for this page',
  network: 'The connection was lost',
};

function fail(error) {
  setPlaying(false);
  if (!state.info) by('about').textContent = '';
  let heading = HEADINGS[error.code] ?? 'Something went wrong';
  if (/not a \.limber stream/.test(error.message)) heading = 'This is not a .limber stream';
  else if (error.code === 'bad-stream' && state.shown)
    heading = /ends before/.test(error.message) ? 'This stream ends too early' : 'A part of this stream cannot be read';
  say(heading, error.message, { retry: error.code === 'network' });
}

// Where some of the stream is there the card can be put away, and that looked at.
function say(heading, text, { retry = false } = {}) {
  const card = by('card');
  by('close').hidden = !state.shown;
  card.querySelector('h2').textContent = heading;
  card.querySelector('p').textContent = text;
  by('retry').hidden = !retry;
  card.hidden = false;
}

// ---- The panel

// Settings that need a picture to mean anything. They are of the stream that the page was opened with.
function applySettings() {
  state.isFirstPicture = false;
  looking.reset();
  const { preset } = settings;
  looking.apply(settings);
  if (preset in presets) applyPreset(preset);
  for (const name of ['seen', 'outlines', 'focus', 'along', 'freeze', 'preset']) delete settings[name];
}

// The longer of the axes that lie flat.
function bodyAxis() {
  const { low, high } = stage.box();
  const side = stage.up === 'y' ? 2 : 1;
  return high[0] - low[0] >= high[side] - low[side] ? 0 : side;
}

// A place within the high end of it.
function bodyEnd() {
  const { low, high } = stage.box();
  const place = low.map((x, k) => (x + high[k]) / 2);
  const axis = bodyAxis();
  place[axis] += 0.3 * (high[axis] - low[axis]);
  return place;
}

const presets = {
  plain: () => detail.setBy('triangles', state.info.triangleCount / 8),
  pixel: () => detail.setBy('pixels', 1),
  fig12() {
    detail.setBy('vertices', 0.07 * state.info.vertexCount);
    looking.setAlong(`-${'xyz'[bodyAxis()]}`);
    look({ wireframe: true });
  },
  part() {
    detail.setBy('triangles', 0.08 * state.info.triangleCount);
    looking.setFocus({ center: bodyEnd(), radius: 0.3 * stage.sphere.radius });
    look({ wireframe: true });
  },
  frozen() {
    detail.setBy('pixels', 1);
    by('seen').checked = true;
    look({ wireframe: true });
    stage.approach(bodyEnd(), 0.4);
    looking.setFrozen(true);
  },
};

function applyPreset(name) {
  looking.reset();
  stage.flight = null;
  stage.fit(false);
  look({ wireframe: false });
  presets[name]();
  by('preset').value = name;
}

function placeInset() {
  const inset = by('inset');
  inset.hidden = !looking.frozen;
  if (inset.hidden) return;
  const { left, bottom, width, height } = stage.insetBox();
  const top = by('canvas').clientHeight - bottom - height;
  for (const [name, value] of Object.entries({ left, top, width, height })) inset.style[name] = `${value}px`;
}

function look(change) {
  Object.assign(state.look, change);
  by('wireframe').checked = state.look.wireframe;
  by('flat').checked = state.look.flat;
  by('flash').checked = state.look.flash;
  by('colors').value = state.look.colors;
  stage.setLook(change);
  drawLegend();
  show();
}

function setBlend(frames) {
  const choices = [...by('blend').options].map((option) => Number(option.value));
  state.blend = choices.findLast((choice) => choice <= frames) ?? 0;
  by('blend').value = state.blend;
  show();
}

function setCompare(compare) {
  state.compare = compare;
  for (const button of by('compare').children) {
    button.setAttribute('role', 'radio');
    button.setAttribute('aria-checked', String(button.dataset.value === compare));
  }
  stage.setCompare(compare);
  by('divider').hidden = compare !== 'split';
  by('tag-left').hidden = by('tag-right').hidden = compare === 'off';
  placeTags();
  show();
}

function placeTags() {
  const at = state.compare === 'side' ? 0.5 : stage.split;
  by('divider').style.left = `${100 * at}%`;
  by('tag-left').style.right = `calc(${100 * (1 - at)}% + 14px)`;
  by('tag-right').style.left = `calc(${100 * at}% + 14px)`;
}

function setSplit(part) {
  stage.split = Math.min(0.97, Math.max(0.03, part));
  stage.isDirty = true;
  placeTags();
}

const css = (color) => `#${color.getHexString()}`;
function drawLegend() {
  const { colors } = state.look;
  const legend = by('legend');
  legend.hidden = colors === 'none' || !state.info;
  if (legend.hidden) return;
  const color = new Color();
  if (colors === 'errors') {
    const most = (100 * stage.errorScale) / (state.info.diagonal || 1);
    legend.innerHTML = `0 <span class="ramp" style="background:${errorGradient}"></span> ${format(most, 2)} % of diagonal`;
  } else if (colors === 'levels') {
    const levels = state.info.levelSizes.length;
    legend.innerHTML = Array.from({ length: levels }, (_, level) =>
      `<span><i style="background:${css(levelRamp(level / Math.max(1, levels - 1), color))}"></i>${level}</span>`).join('');
  } else {
    const stops = Array.from({ length: 9 }, (_, i) => css(clusterColor(i * 7 + 3, color)));
    legend.innerHTML = `<span class="ramp" style="background:${cssRamp(stops)}"></span> a colour per vertex of the cut`;
  }
}

function applyTheme(theme) {
  document.documentElement.dataset.theme = theme;
  by('theme').textContent = theme === 'dark' ? 'Light' : 'Dark';
  const style = getComputedStyle(document.documentElement);
  const color = (name) => style.getPropertyValue(`--${name}`).trim();
  stage.setTheme({ clay: color('clay'), wire: color('wire'), accent: color('accent') });
  timeline.draw();
}

function toast(text) {
  const box = by('toast');
  box.textContent = text;
  box.classList.add('shown');
  clearTimeout(toast.timer);
  toast.timer = setTimeout(() => box.classList.remove('shown'), 1100);
}

const COMPARE = ['off', 'side', 'split'];
const actions = {
  play: () => setPlaying(!state.isPlaying),
  back: () => seek(state.wantedFrame - 1, { keepPlaying: false }),
  forth: () => seek(state.wantedFrame + 1, { keepPlaying: false }),
  loop() {
    state.isLooping = !state.isLooping;
    by('loop').setAttribute('aria-pressed', String(state.isLooping));
  },
  fit: () => stage.fit(),
  up() {
    stage.setUp(stage.up === 'y' ? 'z' : 'y');
    by('up').textContent = `${stage.up.toUpperCase()} up`;
  },
  theme: () => applyTheme(document.documentElement.dataset.theme === 'dark' ? 'light' : 'dark'),
  open: () => by('file').click(),
  choose: () => by('file').click(),
  retry: () => open(state.source, { isAgain: true }),
  close: () => (by('card').hidden = true),
  help: () => by('keys').showModal(),
  more: () => by('panel').classList.toggle('open'),
};
for (const [id, act] of Object.entries(actions)) by(id)?.addEventListener('click', act);
for (const id of ['back', 'forth', 'loop', 'more']) by(id).innerHTML = icons[id];
by('speed').addEventListener('change', (event) => (state.speed = parseFloat(event.target.value)));
for (const id of ['wireframe', 'flat', 'flash']) by(id).addEventListener('change', (event) => look({ [id]: event.target.checked }));
by('colors').addEventListener('change', (event) => look({ colors: event.target.value }));
by('blend').addEventListener('change', (event) => setBlend(Number(event.target.value)));
by('preset').addEventListener('change', (event) => state.shown && event.target.value && applyPreset(event.target.value));
by('compare').addEventListener('click', (event) => event.target.dataset.value && setCompare(event.target.dataset.value));
by('canvas').addEventListener('dblclick', (event) => {
  const place = looking.focus && stage.pick(event);
  if (place) looking.setFocus({ ...looking.focus, center: place });
  else stage.fit();
});
by('canvas').addEventListener('pointerdown', () => by('panel').classList.remove('open'));
by('file').addEventListener('change', (event) => {
  const [file] = event.target.files;
  event.target.value = '';
  if (file) open({ name: file.name, from: file });
});

const divider = by('divider');
divider.addEventListener('pointerdown', (event) => divider.setPointerCapture(event.pointerId));
divider.addEventListener('pointermove', (event) => {
  if (!divider.hasPointerCapture(event.pointerId)) return;
  const box = by('stage').getBoundingClientRect();
  setSplit((event.clientX - box.left) / box.width);
});

const keys = {
  ' ': actions.play,
  ArrowLeft: (event) => (event.shiftKey ? seekKey(-1) : actions.back()),
  ArrowRight: (event) => (event.shiftKey ? seekKey(1) : actions.forth()),
  Home: () => seek(0),
  End: () => seek(frameCount() - 1),
  '[': () => nudge(-1),
  ']': () => nudge(1),
  w: () => look({ wireframe: !state.look.wireframe }),
  s: () => look({ flat: !state.look.flat }),
  m: () => look({ flash: !state.look.flash }),
  g: () => {
    setBlend(state.blend > 0 ? 0 : 4);
    toast(state.blend > 0 ? `Changes blended over ${state.blend} frames` : 'Changes at once');
  },
  1: () => look({ colors: 'none' }),
  2: () => look({ colors: 'levels' }),
  3: () => look({ colors: 'clusters' }),
  4: () => look({ colors: 'errors' }),
  v: () => by('seen').click(),
  b: () => by('focus').click(),
  z: () => by('frozen').click(),
  c: () => setCompare(COMPARE[(COMPARE.indexOf(state.compare) + 1) % COMPARE.length]),
  f: actions.fit,
  u: actions.up,
  l: actions.loop,
  t: actions.theme,
  o: actions.open,
  Escape: () => by('close').hidden || actions.close(),
  '?': actions.help,
};

function seekKey(way) {
  let frame = state.wantedFrame + way;
  while (frame > 0 && frame < frameCount() && !timeline.keys[frame]) frame += way;
  seek(frame, { keepPlaying: false });
}

function nudge(way) {
  if (!state.info) return;
  detail.nudge(way);
  toast(`${by('number').value}${detail.unit.textContent ? ` ${detail.unit.textContent}` : ''} ${detail.by}`);
}

addEventListener('keydown', (event) => {
  const isText = event.target.matches?.('input:not([type=range]):not([type=checkbox]), select, dialog *');
  if (event.ctrlKey || event.metaKey || event.altKey || isText) return;
  if (event.target.matches?.('input[type=range]') && event.key.startsWith('Arrow')) return;
  const act = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
  if (!act) return;
  event.preventDefault();
  act(event);
});

let dragDepth = 0;
addEventListener('dragenter', () => (by('drop').hidden = ++dragDepth === 0));
addEventListener('dragleave', () => (by('drop').hidden = --dragDepth <= 0));
addEventListener('dragover', (event) => event.preventDefault());
addEventListener('drop', (event) => {
  event.preventDefault();
  dragDepth = 0;
  by('drop').hidden = true;
  const [file] = event.dataTransfer.files;
  if (file) open({ name: file.name, from: file });
});

// ---- Start

const prefersLight = matchMedia('(prefers-color-scheme: light)');
applyTheme(settings.theme ?? (prefersLight.matches ? 'light' : 'dark'));
prefersLight.addEventListener('change', (event) => applyTheme(event.matches ? 'light' : 'dark'));
setPlaying(false);
look({
  colors: ['levels', 'clusters', 'errors'].includes(settings.colors) ? settings.colors : 'none',
  wireframe: 'wireframe' in settings, flat: 'flat' in settings, flash: 'flash' in settings,
});
setBlend(Number(settings.blend ?? 0) || 0);
if (settings.up === 'z') actions.up();
setCompare(COMPARE.includes(settings.compare) ? settings.compare : 'off');
const first = streamOfPage();
if (first) open(first);
else say('Nothing is open', 'Drop a .limber stream here, or open one. “limber build” makes them.');
requestAnimationFrame(tick);

// For tests, and for who likes the console.
globalThis.limberViewer = { state, stage, timeline, detail, looking, applyPreset, open, seek, setPlaying, look, setBlend, setCompare, setSplit };
