// SPDX-License-Identifier: Apache-2.0
// Where the detail goes: what "Finer where" in the panel says, as the view of a cut.

const OUTLINES = 4; // times finer
const FACING_AWAY = 8; // times coarser
const AXES = ['x', 'y', 'z'];

// "-z", from the high end to the low one of what is shown, or "z:0.9:-0.7".
function parseAlong(text, box) {
  const said = /^(-?)([xyz])(?::([^:]+):([^:]+))?$/.exec(text);
  if (!said) return null;
  const [, minus, axis, from, to] = said;
  if (from !== undefined) return Number(from) === Number(to) ? null : { axis, from: Number(from), to: Number(to) };
  const k = AXES.indexOf(axis);
  const ends = [box.low[k], box.high[k]];
  if (minus) ends.reverse();
  return { axis, from: ends[0], to: ends[1] };
}

export class Looking {
  // `controls`: {seen, outlines, focus, frozen: check boxes, along: a list, size: a slider of the ball}
  constructor({ stage, controls, onChange }) {
    Object.assign(this, { stage, controls, onChange });
    this.frozen = null;
    this.focus = null;
    this.along = null;
    const { seen, outlines, focus, frozen, along, size } = controls;
    for (const box of [seen, outlines]) box.addEventListener('change', () => this.onChange());
    focus.addEventListener('change', () => this.setFocus(focus.checked ? this.focusInMiddle() : null));
    frozen.addEventListener('change', () => this.setFrozen(frozen.checked));
    along.addEventListener('change', () => this.setAlong(along.value));
    size.addEventListener('input', () => this.focus && this.setFocus({ ...this.focus, radius: this.radiusOf(Number(size.value)) }));
  }

  // For a new stream. Settings are of the page's address.
  reset() {
    this.setFrozen(false, false);
    this.setFocus(null, false);
    this.setAlong('', false);
    this.controls.seen.checked = this.controls.outlines.checked = false;
  }

  // When the first frame is shown: what is said in terms of it.
  apply(settings) {
    const { seen, outlines, focus, along, freeze } = settings;
    if ([seen, outlines, focus, along, freeze].every((setting) => setting === undefined)) return;
    this.controls.seen.checked = seen !== undefined;
    this.controls.outlines.checked = outlines !== undefined;
    const numbers = focus?.split(',').map(Number) ?? [];
    if (numbers.length === 4 && numbers.every(Number.isFinite) && numbers[3] > 0) {
      this.setFocus({ center: numbers.slice(0, 3), radius: numbers[3] }, false);
    } else if (focus !== undefined) {
      this.setFocus(this.focusInMiddle(), false);
    }
    if (along) this.setAlong(along, false);
    if (freeze !== undefined) this.setFrozen(true, false);
    this.onChange();
  }

  radiusOf(part) {
    return this.stage.sphere.radius * 0.02 * 50 ** (part / 1000);
  }

  focusInMiddle() {
    return this.stage.sphere && { center: this.stage.controls.target.toArray(), radius: this.stage.sphere.radius * 0.25 };
  }

  setFocus(focus, tells = true) {
    this.focus = focus;
    const { controls, stage } = this;
    controls.focus.checked = focus !== null;
    controls.size.parentElement.hidden = focus === null;
    if (focus && stage.sphere) controls.size.value = (1000 * Math.log(focus.radius / this.radiusOf(0))) / Math.log(50);
    stage.setFocus(focus);
    if (tells) this.onChange();
  }

  setAlong(text, tells = true) {
    const box = this.stage.box();
    this.along = text && box ? parseAlong(text, box) : null;
    this.controls.along.value = this.along && [...this.controls.along.options].some((o) => o.value === text) ? text : '';
    if (tells) this.onChange();
  }

  // Keeps the eye where it is for the cut, and goes to look at it from elsewhere; or gives the eye back.
  setFrozen(isFrozen, tells = true) {
    this.frozen = isFrozen ? this.stage.eye() : null;
    this.controls.frozen.checked = isFrozen;
    this.stage.setFrozen(this.frozen);
    if (tells) this.onChange();
  }

  usesCamera(by) {
    const { seen, outlines, frozen } = this.controls;
    return by === 'pixels' || ((by === 'triangles' || by === 'vertices') && (seen.checked || outlines.checked || frozen.checked));
  }

  // Whether the cut changes with the camera.
  follows(by) {
    return this.usesCamera(by) && !this.frozen;
  }

  // The view of a cut that is chosen by that; null where it is not looked at.
  view(by) {
    if (by === 'level') return null;
    const view = this.usesCamera(by) ? { ...(this.frozen ?? this.stage.eye()) } : {};
    if (view.camera && this.controls.outlines.checked) view.silhouettes = OUTLINES;
    if (view.camera && this.controls.seen.checked) view.facingAway = FACING_AWAY;
    if (this.focus) view.focus = this.focus;
    if (this.along) view.along = this.along;
    return view.camera || view.focus || view.along ? view : null;
  }
}
