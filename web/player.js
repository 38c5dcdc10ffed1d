// SPDX-License-Identifier: Apache-2.0
// limber/player.h in JavaScript: a thin layer over the WebAssembly module. What the functions do, and in which order
// they may be called, is said there; the types are in player.d.ts.

const STATUS = ['ok', 'needs-more', 'bad-stream', 'unsupported', 'no-memory', 'wrong-call'];
const OK = 0;
const NEEDS_MORE = 1;
const NONE = 0xffffffff;
const CRITERIA = { level: 0, vertices: 1, triangles: 2, error: 3 };
const FETCH_LEVELS = 1;
const FETCH_ERRORS = 2;
const FETCH_MOVED = 4;
const VIEW_CAMERA = 1;
const VIEW_FOCUS = 2;
const VIEW_ALONG = 4;
const AXES = ['x', 'y', 'z'];

// Sizes of the structures for wasm32.
const INFO_SIZE = 208;
const FRAME_SIZE = 32;
const RANGE_SIZE = 16;
const OPTIONS_SIZE = 48;
const VIEW_SIZE = 168;
const MESH_SIZE = 60;

export class LimberError extends Error {
  constructor(code, message) {
    super(message);
    this.name = 'LimberError';
    this.code = code;
  }
}

async function readModule(source) {
  if (source instanceof WebAssembly.Module) return source;
  if (source instanceof ArrayBuffer || ArrayBuffer.isView(source)) return WebAssembly.compile(source);
  const url = new URL(source ?? new URL('player.wasm', import.meta.url), import.meta.url);
  if (url.protocol === 'file:' && globalThis.process?.versions?.node) {
    const { readFile } = await import('node:fs/promises');
    return WebAssembly.compile(await readFile(url));
  }
  const response = await fetch(url);
  if (!response.ok) throw new LimberError('no-module', `${url}: ${response.status} ${response.statusText}`);
  return WebAssembly.compile(await response.arrayBuffer());
}

// The module is compiled once for each place that it comes from.
const modules = new Map();

export function loadModule(source) {
  if (!modules.has(source)) {
    const loading = readModule(source);
    loading.catch(() => modules.delete(source));
    modules.set(source, loading);
  }
  return modules.get(source);
}

export class Player {
  static async create(source) {
    const { exports } = await WebAssembly.instantiate(await loadModule(source), {
      // libc may ask for a place to write to; there is none.
      wasi_snapshot_preview1: new Proxy({}, { get: () => () => 52 }),
    });
    exports._initialize();
    return new Player(exports);
  }

  constructor(exports) {
    this.wasm = exports;
    this.handle = exports.limber_player_create();
    this.scratch = exports.malloc(INFO_SIZE);
    this.staging = { at: 0, size: 0 };
  }

  // The instance, and all its memory, goes with the last reference.
  destroy() {
    this.wasm = null;
  }

  // A call that gives a status. Out of memory, the module traps.
  call(name, ...args) {
    if (!this.wasm) throw new LimberError('wrong-call', 'the player has been destroyed');
    let status;
    try {
      status = this.wasm[name](...args);
    } catch (trap) {
      this.wasm = null;
      throw new LimberError('no-memory', `not enough memory for this stream (${trap.message})`);
    }
    if (status > NEEDS_MORE) throw new LimberError(STATUS[status], this.message());
    return status === OK;
  }

  message() {
    const bytes = new Uint8Array(this.wasm.memory.buffer, this.wasm.limber_error(this.handle));
    return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
  }

  view(offset, size) {
    return new DataView(this.wasm.memory.buffer, offset, size);
  }

  // Copies bytes to where the module can read them.
  stage(bytes) {
    if (this.staging.size < bytes.byteLength) {
      this.wasm.free(this.staging.at);
      const at = this.wasm.malloc(bytes.byteLength);
      this.staging = { at, size: at === 0 ? 0 : bytes.byteLength };
      if (at === 0) throw new LimberError('no-memory', 'not enough memory for the bytes of the stream');
    }
    const from = ArrayBuffer.isView(bytes)
      ? new Uint8Array(bytes.buffer, bytes.byteOffset, bytes.byteLength)
      : new Uint8Array(bytes);
    new Uint8Array(this.wasm.memory.buffer).set(from, this.staging.at);
    return this.staging.at;
  }

  append(bytes) {
    return this.feed(bytes, (at, size) => this.call('limber_append', this.handle, at, size));
  }

  setSize(size) {
    return this.call('limber_set_size', this.handle, BigInt(size));
  }

  supply(offset, bytes) {
    return this.feed(bytes, (at, size, done) =>
      this.call('limber_supply', this.handle, BigInt(offset + done), at, size));
  }

  // A megabyte at a time, so that the staging area stays small.
  feed(bytes, take) {
    const all = ArrayBuffer.isView(bytes)
      ? new Uint8Array(bytes.buffer, bytes.byteOffset, bytes.byteLength)
      : new Uint8Array(bytes);
    const most = 1 << 20;
    let isOpen = false;
    let done = 0;
    do {
      const part = all.subarray(done, done + most);
      isOpen = take(this.stage(part), part.length, done);
      done += part.length;
    } while (done < all.length);
    return isOpen;
  }

  missing(frame = NONE) {
    if (this.call('limber_missing', this.handle, frame, this.scratch)) return null;
    const view = this.view(this.scratch, RANGE_SIZE);
    return { offset: Number(view.getBigUint64(0, true)), size: Number(view.getBigUint64(8, true)) };
  }

  get info() {
    this.view(this.scratch, INFO_SIZE).setUint32(0, INFO_SIZE, true);
    if (!this.call('limber_get_info', this.handle, this.scratch)) return null;
    const view = this.view(this.scratch, INFO_SIZE);
    const u32 = (offset) => view.getUint32(offset, true);
    const frameCount = u32(4);
    const levelCount = u32(76);
    return {
      frameCount: frameCount === NONE ? null : frameCount,
      availableFrames: u32(8),
      firstFrameNumber: u32(12),
      framesPerSecond: view.getFloat64(16, true),
      tolerance: view.getFloat64(24, true),
      diagonal: view.getFloat64(32, true),
      size: Number(view.getBigUint64(40, true)) || null,
      bytesThere: Number(view.getBigUint64(48, true)),
      hasIndex: u32(56) !== 0,
      keyInterval: u32(60),
      vertexCount: u32(64),
      triangleCount: u32(68),
      nodeCount: u32(72),
      levelSizes: Array.from({ length: levelCount }, (_, level) => u32(80 + 4 * level)),
    };
  }

  frame(number) {
    this.view(this.scratch, FRAME_SIZE).setUint32(0, FRAME_SIZE, true);
    if (!this.call('limber_get_frame', this.handle, number, this.scratch)) return null;
    const view = this.view(this.scratch, FRAME_SIZE);
    return {
      key: view.getUint32(4, true),
      isThere: view.getUint32(8, true) !== 0,
      offset: Number(view.getBigUint64(16, true)),
      size: Number(view.getBigUint64(24, true)),
    };
  }

  get shownFrame() {
    const frame = this.wasm.limber_shown_frame(this.handle) >>> 0;
    return frame === NONE ? null : frame;
  }

  // Of the finest level; does not change.
  get vertexCount() {
    return (this.finestCount ??= this.info.vertexCount);
  }

  seek(frame) {
    return this.call('limber_seek', this.handle, frame);
  }

  step() {
    return this.call('limber_step', this.handle);
  }

  createCut() {
    return new Cut(this);
  }
}

const DEFAULT_CAMERA = { eye: [0, 0, 5], target: [0, 0, 0], up: [0, 1, 0], fov: 24 };
const DEFAULT_VIEW = { width: 1200, height: 900, silhouettes: 1, facingAway: 1 };
const DEFAULT_FOCUS = { center: [0, 0, 0], radius: 1, outside: 32 };
const DEFAULT_ALONG = { axis: 'x', from: 0, to: 1, coarsest: 64 };

// Writes a limber_view.
function writeView(to, view) {
  const { width, height, silhouettes, facingAway } = { ...DEFAULT_VIEW, ...view };
  const camera = { ...DEFAULT_CAMERA, ...view.camera };
  const focus = { ...DEFAULT_FOCUS, ...view.focus };
  const along = { ...DEFAULT_ALONG, ...view.along };
  const axis = AXES.indexOf(along.axis);
  if (axis < 0) throw new LimberError('wrong-call', `an axis is x, y or z, not ${along.axis}`);
  const point = (offset, from) => {
    for (let k = 0; k < 3; ++k) to.setFloat64(offset + 8 * k, from[k], true);
  };
  to.setUint32(0, VIEW_SIZE, true);
  to.setUint32(4, (view.camera ? VIEW_CAMERA : 0) | (view.focus ? VIEW_FOCUS : 0) | (view.along ? VIEW_ALONG : 0), true);
  point(8, camera.eye);
  point(32, camera.target);
  point(56, camera.up);
  to.setFloat64(80, camera.fov, true);
  to.setUint32(88, width, true);
  to.setUint32(92, height, true);
  to.setFloat32(96, silhouettes, true);
  to.setFloat32(100, facingAway, true);
  point(104, focus.center);
  to.setFloat64(128, focus.radius, true);
  to.setFloat32(136, focus.outside, true);
  to.setFloat32(140, along.coarsest, true);
  to.setFloat64(144, along.from, true);
  to.setFloat64(152, along.to, true);
  to.setUint32(160, axis, true);
}

export class Cut {
  constructor(player) {
    this.player = player;
    this.handle = player.wasm.limber_cut_create(player.handle);
    this.options = player.wasm.malloc(OPTIONS_SIZE);
    this.view = player.wasm.malloc(VIEW_SIZE);
    this.mesh = player.wasm.malloc(MESH_SIZE);
  }

  destroy() {
    const { wasm } = this.player;
    if (!wasm) return;
    wasm.limber_cut_destroy(this.handle);
    wasm.free(this.options);
    wasm.free(this.view);
    wasm.free(this.mesh);
    this.player = null;
  }

  update({
    by = 'level', level = 0, budget = 0, errorBound = 1, hysteresis = 1.6, fetch = {}, view = null, hold = false, enough = 0,
    blend = 0,
  } = {}) {
    const { player } = this;
    if (!(by in CRITERIA)) throw new LimberError('wrong-call', `a cut is by level, vertices, triangles or error, not by ${by}`);
    const options = player.view(this.options, OPTIONS_SIZE);
    options.setUint32(0, OPTIONS_SIZE, true);
    options.setUint32(4, CRITERIA[by], true);
    options.setUint32(8, level, true);
    options.setUint32(12, budget, true);
    options.setFloat32(16, errorBound, true);
    options.setFloat32(20, hysteresis, true);
    options.setUint32(24, (fetch.levels ? FETCH_LEVELS : 0) | (fetch.errors ? FETCH_ERRORS : 0) | (fetch.moved ? FETCH_MOVED : 0), true);
    options.setUint32(28, hold ? 1 : 0, true);
    options.setFloat32(32, enough, true);
    options.setUint32(36, view ? this.view : 0, true);
    options.setUint32(40, blend, true);
    options.setUint32(44, 0, true);
    if (view) writeView(player.view(this.view, VIEW_SIZE), view);
    const finestCount = fetch.labels ? player.vertexCount : 0;
    player.view(this.mesh, MESH_SIZE).setUint32(0, MESH_SIZE, true);
    if (!player.call('limber_cut_update', this.handle, this.options, this.mesh)) return null;

    const mesh = player.view(this.mesh, MESH_SIZE);
    const u32 = (offset) => mesh.getUint32(offset, true);
    const vertexCount = u32(8);
    const triangleCount = u32(12);
    const list = (Type, offset, length) =>
      u32(offset) === 0 && length > 0 ? null : new Type(player.wasm.memory.buffer, u32(offset), length);
    return {
      frame: u32(4),
      vertexCount,
      triangleCount,
      swapCount: u32(16),
      rmsError: mesh.getFloat32(20, true),
      seenError: mesh.getFloat32(56, true),
      positions: list(Float32Array, 24, 3 * vertexCount),
      normals: list(Float32Array, 28, 3 * vertexCount),
      indices: list(Uint32Array, 32, 3 * triangleCount),
      nodes: list(Uint32Array, 36, vertexCount),
      levels: fetch.levels ? list(Uint8Array, 40, vertexCount) : null,
      errors: fetch.errors ? list(Float32Array, 44, vertexCount) : null,
      moved: fetch.moved ? list(Uint8Array, 48, vertexCount) : null,
      labels: fetch.labels ? list(Uint32Array, 52, finestCount) : null,
    };
  }
}
