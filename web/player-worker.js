// SPDX-License-Identifier: Apache-2.0
// Loads, decodes and cuts beside the page: what worker-player.js talks to. serve() can also be called in the page
// itself, where there are no workers.
//
//   in:  open {from, module, prefetch}   show {id, frame, cuts}   recycle {buffers}
//   out: info {info, sizes, keys}   progress {bytesThere, there}   frame {id, meshes, ...}   error {code, message, id}
import { LimberError, Player } from './player.js';
import { openSource } from './stream-source.js';

const PART = 1 << 18; // bytes asked for at once while loading ahead
const PROGRESS_EVERY = 100; // milliseconds
const MOST_SPARE = 24; // buffers kept for meshes to come

// Memory that the page has given back.
class Spares {
  constructor() {
    this.buffers = [];
  }

  add(buffers) {
    this.buffers.push(...buffers);
    if (this.buffers.length > MOST_SPARE) this.buffers.splice(0, this.buffers.length - MOST_SPARE);
  }

  copy(array) {
    if (!array) return null;
    const fits = (b) => b.byteLength >= array.byteLength && b.byteLength <= 2 * array.byteLength + 4096;
    const found = this.buffers.findIndex(fits);
    const buffer =
      found < 0 ? new ArrayBuffer(Math.ceil((array.byteLength * 1.25 + 64) / 8) * 8) : this.buffers.splice(found, 1)[0];
    const copied = new array.constructor(buffer, 0, array.length);
    copied.set(array);
    return copied;
  }
}

const ARRAYS = ['positions', 'normals', 'indices', 'nodes', 'levels', 'errors', 'moved', 'labels'];

class Session {
  constructor(post) {
    this.post = post;
    this.spares = new Spares();
    this.cuts = [];
    this.wanted = null; // the last show() that is not answered yet
    this.playhead = 0;
    this.lastProgress = 0;
    this.frameCount = 0; // that the page knows of
  }

  async open({ from, module, prefetch = Infinity }) {
    this.prefetch = prefetch;
    this.player = await Player.create(module);
    this.source = await openSource(from);
    if (this.source.size !== null) this.player.setSize(this.source.size);
    await this.load();
  }

  // Until the last byte is there, or for ever.
  async load() {
    for (;;) {
      if (this.source.size === null) {
        await this.source.read(0, 0, (_, bytes) => this.take(() => this.player.append(bytes)));
        this.arrived(true);
        this.source = { size: this.player.info?.bytesThere ?? 0, read: null };
      }
      const range = this.nextRange();
      if (range) {
        await this.read(range);
      } else {
        this.arrived(true);
        await new Promise((resolve) => (this.wake = resolve));
      }
    }
  }

  async read({ offset, size }) {
    this.reading = { offset, end: offset + size };
    this.abort = new AbortController();
    try {
      const take = (at, bytes) => this.take(() => this.player.supply(at, bytes));
      await this.source.read(offset, size, take, this.abort.signal);
    } catch (error) {
      if (error.name !== 'AbortError') throw error;
    }
    this.abort = null;
    this.reading = null;
    this.arrived(true);
  }

  take(feed) {
    feed();
    this.arrived(false);
    this.answer();
  }

  // What is read next: what the frame that is waited for needs; else ahead of the playhead.
  nextRange() {
    const { player, source } = this;
    if (!player.info) {
      const range = player.missing(0);
      if (!range) return null;
      const size = range.offset === 0 ? source.firstRead : Math.max(range.size, 4096);
      return { offset: range.offset, size: Math.min(size, source.size - range.offset) };
    }
    if (source.read === null) {
      if (this.wanted) this.answerOrFail();
      return null;
    }
    if (this.wanted) return player.missing(this.wanted.frame);
    return player.missing() ?? this.rangeAhead();
  }

  rangeAhead() {
    const { player } = this;
    const { availableFrames, hasIndex, bytesThere } = player.info;
    if (!hasIndex) {
      // Without an index only the next frame can be asked for.
      if (player.info.frameCount !== null && availableFrames >= player.info.frameCount) return null;
      const range = player.missing(availableFrames);
      return range && { offset: range.offset, size: Math.min(range.size, PART) };
    }
    if (bytesThere >= this.prefetch) return null;
    for (let i = 0; i < availableFrames; ++i) {
      const first = player.frame((this.playhead + i) % availableFrames);
      if (first.isThere) continue;
      const most = this.hasShown ? PART : 1; // until then, a frame at a time
      let size = 0;
      for (let n = (this.playhead + i) % availableFrames; n < availableFrames && size < most; ++n) {
        const next = player.frame(n);
        if (next.isThere) break;
        size = next.offset + next.size - first.offset;
      }
      return { offset: first.offset, size };
    }
    return null;
  }

  show(request) {
    if (this.wanted) this.post({ type: 'frame', id: this.wanted.id, meshes: null });
    this.wanted = request;
    this.playhead = request.frame;
    this.answer();
    if (!this.wanted) return;
    if (!this.isComing(request.frame)) this.abort?.abort();
    this.wake?.();
  }

  // Whether what is being read brings what the frame needs first.
  isComing(frame) {
    if (!this.reading || !this.player.info) return true;
    const range = this.player.missing(frame);
    return range !== null && range.offset >= this.reading.offset && range.offset < this.reading.end;
  }

  // Shows the frame that is waited for, if all its bytes are there.
  answer() {
    const { wanted, player } = this;
    if (!wanted || !player?.info) return;
    const start = performance.now();
    try {
      if (!player.seek(wanted.frame)) return;
      const sought = performance.now();
      const meshes = wanted.cuts.map((options, i) => this.cut(i, options));
      const done = performance.now();
      this.wanted = null;
      this.hasShown = true;
      const buffers = meshes.flatMap((mesh) => ARRAYS.map((name) => mesh[name]?.buffer)).filter(Boolean);
      const times = { seek: sought - start, cut: done - sought };
      this.post({ type: 'frame', id: wanted.id, frame: wanted.frame, meshes, times, bytesThere: player.info.bytesThere }, buffers);
    } catch (error) {
      this.wanted = null;
      this.fail(error, wanted.id);
    }
  }

  answerOrFail() {
    this.answer();
    if (!this.wanted) return;
    const { id, frame } = this.wanted;
    this.wanted = null;
    this.fail(new LimberError('bad-stream', `the stream ends before frame ${frame}`), id);
  }

  cut(i, options) {
    this.cuts[i] ??= this.player.createCut();
    const mesh = this.cuts[i].update(options);
    const copied = { ...mesh };
    for (const name of ARRAYS) copied[name] = this.spares.copy(mesh[name]);
    return copied;
  }

  recycle({ buffers }) {
    this.spares.add(buffers);
  }

  // Tells the page what is there.
  arrived(now) {
    const { info } = this.player;
    if (!info) return;
    const frames = info.availableFrames;
    if (frames !== this.frameCount || !this.told) {
      if (!now && frames > 0 && this.told && performance.now() - this.lastProgress < PROGRESS_EVERY) return;
      this.frameCount = frames;
      this.told = true;
      const sizes = new Uint32Array(frames);
      const keys = new Uint8Array(frames);
      for (let i = 0; i < frames; ++i) {
        const frame = this.player.frame(i);
        sizes[i] = frame.size;
        keys[i] = frame.key === i ? 1 : 0;
      }
      this.post({ type: 'info', info, sizes, keys });
    }
    if (!now && performance.now() - this.lastProgress < PROGRESS_EVERY) return;
    this.lastProgress = performance.now();
    const there = Uint8Array.from({ length: frames }, (_, i) => (this.player.frame(i).isThere ? 1 : 0));
    this.post({ type: 'progress', bytesThere: info.bytesThere, size: info.size ?? this.source.size, there });
  }

  fail(error, id) {
    const known = error instanceof LimberError;
    this.post({ type: 'error', code: known ? error.code : 'failure', message: String(error.message ?? error), id });
  }
}

// Answers messages until the other side is gone. `post` sends one, with what is transferred.
export function serve(post) {
  let session = null;
  return (message) => {
    if (message.type === 'open') {
      session = new Session(post);
      session.open(message).catch((error) => session.fail(error));
    } else {
      session?.[message.type]?.(message);
    }
  };
}

if (typeof WorkerGlobalScope !== 'undefined' && globalThis instanceof WorkerGlobalScope) {
  const receive = serve((message, transfer = []) => globalThis.postMessage(message, transfer));
  globalThis.onmessage = (event) => receive(event.data);
}
