// SPDX-License-Identifier: Apache-2.0
// Frames from left to right: changes as columns, the error as a line, keys as marks above, what is loaded as a strip below.

const KEY_ROW = 9;
const STRIP = 4;

export class Timeline {
  constructor(canvas, { onSeek }) {
    this.canvas = canvas;
    this.context = canvas.getContext('2d');
    this.onSeek = onSeek;
    this.hover = null;
    this.setStream(0);
    new ResizeObserver(() => this.draw()).observe(canvas);
    const seek = (event) => this.onSeek(this.frameAt(event));
    canvas.addEventListener('pointerdown', (event) => {
      canvas.setPointerCapture(event.pointerId);
      this.isDragging = true;
      seek(event);
    });
    canvas.addEventListener('pointermove', (event) => {
      this.hover = event.pointerType === 'mouse' || this.isDragging ? this.frameAt(event) : null;
      if (this.isDragging) seek(event);
      else this.draw();
    });
    for (const name of ['pointerup', 'pointercancel']) canvas.addEventListener(name, () => (this.isDragging = false));
    canvas.addEventListener('pointerleave', () => {
      this.hover = null;
      this.draw();
    });
  }

  setStream(frameCount, firstNumber = 0) {
    this.frameCount = frameCount;
    this.firstNumber = firstNumber;
    this.frame = 0;
    this.sizes = [];
    this.keys = [];
    this.there = [];
    this.changes = new Float32Array(frameCount).fill(NaN);
    this.errors = new Float32Array(frameCount).fill(NaN);
    this.draw();
  }

  setFrames({ sizes, keys, frameCount }) {
    if (frameCount > this.frameCount) {
      const grow = (old) => {
        const longer = new Float32Array(frameCount).fill(NaN);
        longer.set(old);
        return longer;
      };
      this.changes = grow(this.changes);
      this.errors = grow(this.errors);
      this.frameCount = frameCount;
    }
    this.sizes = sizes;
    this.keys = keys;
    this.draw();
  }

  setThere(there) {
    this.there = there;
    this.draw();
  }

  forgetErrors() {
    this.errors.fill(NaN);
  }

  setFrame(frame, { changes, error } = {}) {
    this.frame = frame;
    if (changes !== undefined) this.changes[frame] = changes;
    if (error !== undefined) this.errors[frame] = error;
    this.canvas.setAttribute('aria-valuenow', frame);
    this.draw();
  }

  frameAt(event) {
    const box = this.canvas.getBoundingClientRect();
    const part = (event.clientX - box.left) / Math.max(1, box.width);
    return Math.min(this.frameCount - 1, Math.max(0, Math.floor(part * this.frameCount)));
  }

  // Drawn once per picture of the page, however often it is asked for.
  draw() {
    if (this.isAsked) return;
    this.isAsked = true;
    requestAnimationFrame(() => {
      this.isAsked = false;
      this.drawNow();
    });
  }

  drawNow() {
    const { canvas, context: c, frameCount } = this;
    const ratio = Math.min(globalThis.devicePixelRatio || 1, 2);
    const w = canvas.clientWidth;
    const h = canvas.clientHeight;
    if (canvas.width !== Math.round(w * ratio) || canvas.height !== Math.round(h * ratio)) {
      canvas.width = Math.round(w * ratio);
      canvas.height = Math.round(h * ratio);
    }
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    c.clearRect(0, 0, w, h);
    if (frameCount === 0) return;
    const style = getComputedStyle(document.documentElement);
    const color = (name) => style.getPropertyValue(`--${name}`);
    const column = w / frameCount;
    const gap = column > 5 ? 1 : 0;
    const bottom = h - STRIP - 4;
    const room = bottom - KEY_ROW;

    // Until a frame has been shown its bytes stand for its changes.
    const most = (values) => values.reduce((a, b) => (b > a ? b : a), 0) || 1;
    const mostChanges = most(this.changes);
    const steps = Array.from(this.sizes, (size, i) => (this.keys[i] ? 0 : size));
    const mostBytes = most(steps);
    for (let i = 0; i < frameCount; ++i) {
      const isKnown = !Number.isNaN(this.changes[i]);
      const part = isKnown ? this.changes[i] / mostChanges : (steps[i] ?? 0) / mostBytes;
      const height = Math.max(isKnown ? 1 : 0, part * room * 0.72);
      c.globalAlpha = isKnown ? 1 : 0.28;
      c.fillStyle = color('changes');
      c.fillRect(i * column, bottom - height, Math.max(column - gap, 0.6), height);
    }
    c.globalAlpha = 1;

    // What is loaded.
    c.fillStyle = color('line');
    c.fillRect(0, h - STRIP, w, STRIP);
    c.fillStyle = color('strip');
    for (let i = 0; i < frameCount; ) {
      if (!this.there[i]) {
        ++i;
        continue;
      }
      let end = i;
      while (this.there[end]) ++end;
      c.fillRect(i * column, h - STRIP, (end - i) * column, STRIP);
      i = end;
    }

    // Keys.
    c.fillStyle = color('quiet');
    for (let i = 0; i < frameCount; ++i) {
      if (!this.keys[i]) continue;
      const x = (i + 0.5) * column;
      c.beginPath();
      c.moveTo(x, 1);
      c.lineTo(x + 3, 4);
      c.lineTo(x, 7);
      c.lineTo(x - 3, 4);
      c.fill();
    }

    // The error.
    const mostError = most(this.errors);
    c.strokeStyle = color('accent');
    c.lineWidth = 1.5;
    c.lineJoin = 'round';
    c.beginPath();
    let isDown = false;
    for (let i = 0; i < frameCount; ++i) {
      if (Number.isNaN(this.errors[i])) {
        isDown = false;
        continue;
      }
      const x = (i + 0.5) * column;
      const y = bottom - (this.errors[i] / mostError) * room * 0.94;
      if (isDown) c.lineTo(x, y);
      else c.moveTo(x, y);
      isDown = true;
    }
    c.stroke();

    // Where the mouse is, and what is shown.
    if (this.hover !== null && this.hover !== this.frame) this.drawMark(this.hover, column, h, color('quiet'), 1);
    this.drawMark(this.frame, column, h, color('text'), 2);
    if (this.hover !== null) {
      const text = String(this.hover + this.firstNumber);
      c.font = '11px system-ui, sans-serif';
      const width = c.measureText(text).width + 8;
      const x = Math.min(w - width, Math.max(0, (this.hover + 0.5) * column - width / 2));
      c.fillStyle = color('raised');
      c.beginPath();
      c.roundRect(x, 8, width, 16, 4);
      c.fill();
      c.fillStyle = color('text');
      c.fillText(text, x + 4, 20);
    }
  }

  drawMark(frame, column, h, style, width) {
    const { context: c } = this;
    c.fillStyle = style;
    c.fillRect((frame + 0.5) * column - width / 2, 0, width, h);
  }
}
