/** Places of texts that do not cover each other. */
import { inside, middleOf } from './home.js';

export const LETTER = 0.66; // of a text's height: the width of a letter
const LETTERS = 8; // of a room's name, at least
const STEPS = 10; // places across a room that are tried for its name
const BESIDE = 100; // things that a name may rather cover than be wider than its room
const SHARE = 3; // things, as many as a name that is all covered counts beside their number
const TOUCH = 1e-6; // m by which boxes that touch may seem to cover each other

/** Boxes that are taken: x y of the middle, half a width, half a height. */
export class Taken {
  constructor() {
    /** @type {number[][]} */
    this.boxes = [];
  }

  /** @param {number[]} box @returns {number} how many it covers */
  covered([x, y, w, h]) {
    return this.boxes.filter(([u, v, s, t]) => Math.abs(u - x) < w + s - TOUCH && Math.abs(v - y) < h + t - TOUCH).length;
  }

  /** @param {number[]} box @returns {number} the share of it that others cover, each by itself */
  share([x, y, w, h]) {
    const common = (/** @type {number} */ far, /** @type {number} */ one, /** @type {number} */ other) => Math.max(0, Math.min(2 * one, 2 * other, one + other - far));
    return this.boxes.reduce((sum, [u, v, s, t]) => sum + common(Math.abs(u - x), w, s) * common(Math.abs(v - y), h, t), 0) / (4 * w * h);
  }

  /**
   * Takes the first free one of some places for a box.
   * @param {number[]} box @param {number[][]} shifts of the box
   * @returns {number[] | null} the shift; null where none is free
   */
  put([x, y, w, h], shifts) {
    const free = shifts.find(([dx, dy]) => !this.covered([x + dx, y + dy, w, h])) ?? null;
    if (free) this.boxes.push([x + free[0], y + free[1], w, h]);
    return free;
  }
}

/** @param {string} text @param {number[][]} polygon of its room @param {number} wide m of a letter @param {string} [rest] after the text, if there is place @returns {string} as much as the room is wide */
export function fitted(text, polygon, wide, rest = '') {
  const xs = polygon.map(([x]) => x), most = Math.max(LETTERS, Math.floor((Math.max(...xs) - Math.min(...xs)) / wide));
  return text.length > most ? `${text.slice(0, most - 1)}…` : text.length + rest.length > most ? text : text + rest;
}

/**
 * Takes a place for the name of a room: within its walls if it fits there, near its middle, over few other things.
 * @param {number[][]} polygon @param {number} w half of its width @param {number} h half of its height @param {Taken} taken
 * @returns {number[]} x y
 */
export function nameOf(polygon, w, h, taken) {
  const [mx, my] = middleOf(polygon), xs = polygon.map(([x]) => x), ys = polygon.map(([, y]) => y);
  const left = Math.min(...xs), below = Math.min(...ys), wide = Math.max(...xs) - left, high = Math.max(...ys) - below;
  let best = [mx, my], least = Infinity;
  for (let i = 1; i < STEPS; i++) {
    for (let j = 1; j < STEPS; j++) {
      const x = i === STEPS / 2 ? mx : left + (i / STEPS) * wide, y = j === STEPS / 2 ? my : below + (j / STEPS) * high;
      const within = (/** @type {number[][]} */ shifts) => shifts.every(([dx, dy]) => inside(polygon, x + dx, y + dy));
      if (!within([[0, -h], [0, h]])) continue;
      const fits = within([[-w, -h], [w, -h], [w, h], [-w, h]]);
      const cost = taken.covered([x, y, w, h]) + SHARE * taken.share([x, y, w, h]) + 0.2 * Math.hypot(x - mx, y - my) + (fits ? 0 : BESIDE);
      if (cost < least) { least = cost; best = [x, y]; }
    }
  }
  taken.boxes.push([...best, w, h]);
  return best;
}

/**
 * Places for a label of a thing: above it, below, beside, at its corners, then farther away.
 * @param {number} gap to the thing's middle @param {number} w half of its width @param {number} h half of its height
 * @returns {number[][]} shifts x y
 */
export function around(gap, w, h) {
  const lines = [1, 2, 3, 4].map((line) => gap + h * (2 * line - 1));
  return [[0, lines[0]], [0, -lines[0]], [gap + w, 0], [-gap - w, 0], ...[w, -w].flatMap((x) => [[x, lines[0]], [x, -lines[0]]]), ...lines.slice(1).flatMap((y) => [[0, y], [0, -y]])];
}
