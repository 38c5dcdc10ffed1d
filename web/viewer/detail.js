// SPDX-License-Identifier: Apache-2.0
// The level of detail: what the slider and the number say, as options of a cut.

const STEPS = 1000;

// A slider over several powers of ten.
const logarithmic = (low, high) => ({
  toValue: (t) => low * (high / low) ** t,
  toPart: (value) => Math.log(Math.min(Math.max(value, low), high) / low) / Math.log(high / low),
});

function criteria(info) {
  const top = Math.max(4, info.levelSizes.at(-1));
  const finest = (low, high) => ({ ...logarithmic(low, Math.max(high, low + 1)), unit: '', round: Math.round });
  const round = (value) => Number(value.toPrecision(3));
  return {
    triangles: finest(2 * top, info.triangleCount),
    vertices: finest(top, info.vertexCount),
    pixels: { ...logarithmic(0.05, 20), unit: 'px', round },
    error: { ...logarithmic(0.002, 3), unit: '%', round },
    level: {
      toValue: (t) => (1 - t) * (info.levelSizes.length - 1),
      toPart: (value) => 1 - value / Math.max(1, info.levelSizes.length - 1),
      unit: '',
      round: Math.round,
    },
  };
}

export class Detail {
  constructor({ by, slider, number, unit, onChange }) {
    Object.assign(this, { buttons: by, slider, number, unit, onChange });
    this.by = 'triangles';
    this.values = {};
    by.addEventListener('click', (event) => {
      const button = event.target.closest('button');
      if (button) this.choose(button.dataset.value);
    });
    slider.addEventListener('input', () => this.set(this.criteria[this.by].toValue(Number(slider.value) / STEPS), false));
    number.addEventListener('change', () => this.set(Number(number.value.replace(/[^\d.]/g, '')), true));
    number.addEventListener('keydown', (event) => event.key === 'Enter' && number.blur());
  }

  setStream(info, { by, amount } = {}) {
    this.info = info;
    this.criteria = criteria(info);
    this.values = {
      triangles: Math.round(Math.min(20000, Math.max(500, info.triangleCount / 8))),
      vertices: Math.round(Math.min(10000, Math.max(250, info.vertexCount / 8))),
      pixels: 1,
      error: 0.05,
      level: Math.min(3, info.levelSizes.length - 1),
    };
    if (by in this.criteria) {
      this.by = by;
      if (amount > 0 || (by === 'level' && amount === 0)) this.values[by] = amount;
    }
    this.show();
  }

  choose(by) {
    if (!this.criteria || !(by in this.criteria)) return;
    this.by = by;
    this.show();
    this.onChange();
  }

  set(value) {
    if (!this.criteria || !Number.isFinite(value)) return this.show();
    const { round, toValue, toPart } = this.criteria[this.by];
    this.values[this.by] = round(toValue(Math.min(1, Math.max(0, toPart(value)))));
    this.show();
    this.onChange();
  }

  // More detail with 1, less with -1.
  nudge(way) {
    const { toValue, toPart, round } = this.criteria[this.by];
    if (this.by === 'level') return this.set(this.values.level - way);
    const isError = this.by === 'pixels' || this.by === 'error';
    const part = toPart(this.values[this.by]) + (isError ? -way : way) * 0.05;
    this.set(round(toValue(Math.min(1, Math.max(0, part)))));
  }

  show() {
    const { toPart, unit } = this.criteria[this.by];
    for (const button of this.buttons.children) {
      button.setAttribute('role', 'radio');
      button.setAttribute('aria-checked', String(button.dataset.value === this.by));
    }
    this.slider.value = Math.round(toPart(this.values[this.by]) * STEPS);
    this.number.value = this.values[this.by].toLocaleString('en', { maximumSignificantDigits: 6 });
    this.unit.textContent = unit;
  }

  // An error in pixels is one of a cut that is looked at by a camera.
  options() {
    const value = this.values[this.by];
    if (this.by === 'level') return { by: 'level', level: value };
    if (this.by === 'error' || this.by === 'pixels') return { by: 'error', errorBound: value };
    return { by: this.by, budget: value };
  }

  // As if the slider had been moved.
  setBy(by, value) {
    this.by = by;
    this.set(value);
  }
}
