/** The number of pixels: fewer while frames take long, all of them once the view rests. */

const SHARES = [1, 0.75, 0.55]; // of the width
const SLOW = 150, FAST = 45; // ms that a frame takes
const REST = 400; // ms

export class Sharpness {
  constructor() {
    this.level = 0;
    this.rests = true;
  }

  share() {
    return this.rests ? 1 : SHARES[this.level];
  }

  /**
   * After a frame of a view that moves.
   * @param {number} took ms
   * @returns {boolean} whether the next one has other pixels
   */
  took(took) {
    const before = this.share();
    if (this.rests) return false;
    if (took > SLOW) this.level = Math.min(this.level + 1, SHARES.length - 1);
    else if (took < FAST) this.level = Math.max(this.level - 1, 0);
    return before !== this.share();
  }

  /**
   * @param {boolean} moves whether there is something new to draw
   * @param {number} since ms since the last frame
   * @returns {boolean} whether the next one has other pixels
   */
  rest(moves, since) {
    const before = this.share();
    if (moves) this.rests = false;
    else if (since > REST) this.rests = true;
    return before !== this.share();
  }
}
