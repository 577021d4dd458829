/** The part of a plan that is shown: the wheel or two fingers zoom, a drag moves it. */

const MOST = 8; // times
const CLICK = 6; // px: a shorter drag is a click
const REST = 200; // ms until what is seen now is drawn anew, with marks and names of its size

export class Zoom {
  /** @param {HTMLElement} element @param {() => void} change after it has changed @param {() => void} rest once nothing more changes */
  constructor(element, change, rest) {
    this.times = 1;
    this.all = [0, 0, 1, 1]; // x y width height
    this.middle = [0, 0];
    this.change = change;
    this.rest = rest;
    this.element = element;
    this.far = 0; // px that a pointer moved
    /** @type {Map<number, number[]>} x y px by pointer */
    this.pointers = new Map();
    element.addEventListener('wheel', (e) => { e.preventDefault(); this.by(Math.exp(-e.deltaY / 400), [e.clientX, e.clientY]); }, { passive: false });
    element.addEventListener('pointerdown', () => { if (!this.pointers.size) this.far = 0; }, true); // also of one that others take
    element.addEventListener('pointerdown', (e) => this.pointers.set(e.pointerId, [e.clientX, e.clientY]));
    for (const end of /** @type {const} */ (['pointerup', 'pointercancel', 'pointerleave'])) element.addEventListener(end, (e) => this.pointers.delete(e.pointerId));
    element.addEventListener('pointermove', (e) => this.move(e));
    element.addEventListener('click', (e) => { if (this.far >= CLICK) e.stopImmediatePropagation(); this.far = 0; }, true);
  }

  /** @param {PointerEvent} e */
  move(e) {
    const was = this.pointers.get(e.pointerId), now = [e.clientX, e.clientY], other = [...this.pointers].find(([id]) => id !== e.pointerId)?.[1];
    if (!was) return;
    this.pointers.set(e.pointerId, now);
    const [dx, dy] = [now[0] - was[0], now[1] - was[1]];
    if (other) this.by(Math.hypot(now[0] - other[0], now[1] - other[1]) / (Math.hypot(was[0] - other[0], was[1] - other[1]) || 1), [(was[0] + other[0]) / 2, (was[1] + other[1]) / 2], [dx / 2, dy / 2]);
    else if (this.times > 1) this.by(1, now, [dx, dy]);
    this.far += Math.hypot(dx, dy);
  }

  /** @param {number[]} all that is drawn */
  within(all) {
    this.all = all;
    if (this.times === 1) this.middle = [all[0] + all[2] / 2, all[1] + all[3] / 2];
  }

  whole() {
    if (this.times > 1) this.by(1 / this.times, [0, 0]);
  }

  /** @returns {number[]} what is seen: x y width height */
  get box() {
    const [left, top, width, height] = this.all, w = width / this.times, h = height / this.times;
    const inside = (/** @type {number} */ value, /** @type {number} */ low, /** @type {number} */ most, /** @type {number} */ part) => Math.min(low + most - part / 2, Math.max(low + part / 2, value)) - part / 2;
    return [inside(this.middle[0], left, width, w), inside(this.middle[1], top, height, h), w, h];
  }

  /** @returns {number} px of a unit */
  get scale() { return Math.min(this.element.clientWidth / this.box[2], this.element.clientHeight / this.box[3]) || 1; }

  /** @param {number} factor @param {number[]} at px that stays where it is @param {number[]} [shift] px by which all moves */
  by(factor, at, shift = [0, 0]) {
    const { left, top, width, height } = this.element.getBoundingClientRect(), [x, y, w, h] = this.box, before = this.scale;
    this.times = Math.min(MOST, Math.max(1, this.times * factor));
    const more = 1 / before - 1 / this.scale;
    this.middle = [x + w / 2 + (at[0] - left - width / 2) * more - shift[0] / this.scale, y + h / 2 + (at[1] - top - height / 2) * more - shift[1] / this.scale];
    this.change();
    clearTimeout(this.timer);
    this.timer = setTimeout(this.rest, REST);
  }
}
