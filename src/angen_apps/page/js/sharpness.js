/** The number of pixels: all of them while the view rests, fewer while it moves and frames take long. */

const MOVING = 4.5e5; // pixels of a view that moves, at most
const SHARES = [1, 0.75, 0.55]; // of the width
const SLOW = 150, FAST = 45; // ms that a frame takes
const REST = 400; // ms

export class Sharpness {
  constructor() {
    this.level = 0;
    this.rests = true;
  }

  /** @param {number} pixels of the whole view */
  share(pixels) {
    return this.rests ? 1 : SHARES[this.level] * Math.min(1, Math.sqrt(MOVING / pixels));
  }

  /**
   * After a frame of a view that moves.
   * @param {number} took ms
   * @returns {boolean} whether the next one has other pixels
   */
  took(took) {
    const before = this.level;
    if (this.rests) return false;
    if (took > SLOW) this.level = Math.min(this.level + 1, SHARES.length - 1);
    else if (took < FAST) this.level = Math.max(this.level - 1, 0);
    return before !== this.level;
  }

  /**
   * @param {number} since ms since the view was moved
   * @returns {boolean} whether the next frame has other pixels
   */
  rest(since) {
    const before = this.rests;
    this.rests = since > REST;
    return before !== this.rests;
  }
}
