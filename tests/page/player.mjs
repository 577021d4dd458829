/** The time of a recording, in node: python3 -m pytest tests/page/test_player.py */
import assert from 'node:assert/strict';
import './browserless.mjs';

const { Player } = await import('./js/player.js');
const END = 100;

function opened(search) {
  location.search = search;
  const home = { on() {}, tell() {}, line: { end: END, loaded: 0 }, series: new Map() }, player = new Player(home);
  Object.assign(player, { bar: {}, slider: {}, rate: {} });
  player.seek(player.time); // the scene may come before the end is known
  player.onLine();
  return player;
}

for (const [search, time] of [['?t=12.5', 12.5], ['?t=1e99', END], ['?t=Infinity', END], ['?t=-5', 0], ['?t=x', 0], ['', 0]]) {
  assert.equal(opened(search).time, time, search);
}
const player = opened('');
for (const [asked, time] of [[-1, 0], [50, 50], [1e9, END]]) {
  player.seek(asked);
  assert.equal(player.time, time);
}
