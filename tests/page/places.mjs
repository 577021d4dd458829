/** Places of names, in node: python3 -m pytest tests/page/test_places.py */
import assert from 'node:assert/strict';
import './browserless.mjs';

const { Taken, nameOf } = await import('./js/places.js');
const room = (/** @type {number} */ wide) => [[0, 0], [wide, 0], [wide, 3], [0, 3]];

for (const [wide, half] of [[3, 1], [1.5, 1], [1, 4]]) { // a room that is as wide as its name, and narrower ones
  const taken = new Taken();
  taken.boxes.push([wide / 2, 1.5, 0.3, 0.3]); // a lamp in its middle
  const [x, y] = nameOf(room(wide), half, 0.2, taken);
  assert.ok(Math.abs(x - wide / 2) < 0.01 && Math.abs(y - 1.5) >= 0.5, `${wide} m: ${x} ${y}`);
}

const taken = new Taken(), hall = [[0, 0], [3, 0], [3, 1], [0, 1]];
taken.boxes.push([1.5, 0.5, 0.3, 0.4]); // there is no place beside the lamp: the name covers its edge, not its middle
const [x] = nameOf(hall, 0.8, 0.2, taken);
assert.ok(Math.abs(x - 1.5) > 0.5, `${x}`);
assert.ok(Math.abs(new Taken().share([0, 0, 1, 1])) < 1e-9);
for (const [box, share] of [[[0, 0, 1, 1], 1], [[1, 0, 1, 1], 0.5], [[0, 0, 0.5, 0.5], 0.25], [[3, 0, 1, 1], 0]]) {
  const one = new Taken();
  one.boxes.push(box);
  assert.ok(Math.abs(one.share([0, 0, 1, 1]) - share) < 1e-9, `${box}`);
}
