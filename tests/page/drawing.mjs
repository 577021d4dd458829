/** Edits of drawings, in node: python3 -m pytest tests/page/test_drawing.py */
import assert from 'node:assert/strict';
import { History, SORTS, apply, copied, directionOf, empty, hostOf, itemOf, keysOf, lengthOf, liftOf, mirrored, moved, openingOf, removed, roomWalls, shifted, snapped, storeyOf, stretched, swung, turned, wallAt, wallOf, widened, withFloor, withoutFloor } from './drawing.mjs';

const EDITS = 500;

/** Numbers from 0 to 1, the same in each run. */
function dice(seed) {
  let state = seed;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

function frozen(value) {
  if (value && typeof value === 'object' && !Object.isFrozen(value)) {
    Object.freeze(value);
    Object.values(value).forEach(frozen);
  }
  return value;
}

const flat = () => {
  const history = new History(frozen(empty())), add = (items) => { history.do({ add: items }); frozen(history.now); };
  const storey = () => history.now.plan.storeys[0];
  add(roomWalls(storey(), [0, 0], [8, 6], 0.1).map((wall) => ['walls', wall]));
  add([['walls', wallOf(storey(), [0, 3], [8, 3], 0.1)]]);
  add([['walls', wallOf(storey(), [4, 0], [4, 3], 0.1)]]);
  add([['openings', openingOf('door', storey(), itemOf(storey(), 'walls/4'), 6)]]);
  return { history, storey, add };
};

const close = (a, b) => a.forEach((value, i) => assert.ok(Math.abs(value - b[i]) < 1e-3, `${a} is not ${b}`));

function randomEdit(drawing, floor, random) {
  const storey = storeyOf(drawing, floor), some = (list) => list[Math.floor(random() * list.length)], at = () => [random() * 10 - 5, random() * 10 - 5], keys = keysOf(storey), chosen = keys.filter(() => random() < 0.2).concat(keys.length ? [some(keys)] : []);
  const walls = keys.filter((key) => key.startsWith('walls/')), openings = keys.filter((key) => key.startsWith('openings/')), unique = [...new Set(chosen)];
  const made = [
    () => ({ add: roomWalls(storey, snapped(storey, at(), 0.2), at(), 0.1).map((wall) => ['walls', wall]) }),
    () => { const from = snapped(storey, at(), 0.2); return { add: [['walls', wallOf(storey, from, snapped(storey, at(), 0.2, from, 0.1), 0.2)]] }; },
    () => { const key = walls.length ? some(walls) : null, wall = key && itemOf(storey, key); return wall ? { add: [['openings', openingOf(some(Object.keys(SORTS)), storey, wall, random() * lengthOf(wall), random() < 0.5)]] } : {}; },
    () => ({ add: [['pieces', { name: '', x: at()[0], y: at()[1], z: 0, yaw: random(), width: 1, depth: 1, height: 1 }]] }),
    () => ({ add: [['sensors', { name: '', model: 'pir', x: 0, y: 1, z: 2, yaw: 0, pitch: 0 }], ['rooms', { name: 'hall', use: 'hall', polygon: [at(), at(), at()], floor: 0, ceiling: 2.5 }]] }),
    () => moved(storey, unique, ...at()), () => turned(storey, unique, random() * 7), () => removed(storey, unique), () => ({ add: shifted(copied(storey, unique), 1, 1) }),
    () => (walls.length ? stretched(storey, some(walls), some(['start', 'end']), at()) : {}),
    () => (openings.length ? { change: { [some(openings)]: mirrored(widened(itemOf(storey, some(openings)), 0.5 + random())) } } : {}), () => ({ home: { sensors: some(['seed', 'casas', 'none']) } }), () => ({ add: [['lifts', liftOf(drawing, at(), random() * 7)]] }),
    () => ({ add: [['movers', { name: 'ann', kind: 'person', x: at()[0], y: at()[1], yaw: 0, habits: 'worker', day: [{ do: ['eat'], low: random() * 86400, high: 80000, days: 'all' }] }]] }),
    () => (random() < 0.3 ? withFloor(drawing, random() < 0.5) : {}), () => (random() < 0.2 && drawing.plan.storeys.length > 1 ? withoutFloor(drawing, floor) : {})];
  return { ...some(made)(), storey: floor };
}

const tests = {
  'undo of 500 random edits gives the empty lot'() {
    for (const seed of [1, 2]) {
      const random = dice(seed), history = new History(frozen(empty())), nothing = JSON.stringify(history.now);
      let most = 0, floors = 0, lifts = 0;
      for (let i = 0; i < EDITS; i++) {
        const floor = Math.floor(random() * history.now.plan.storeys.length);
        history.do(randomEdit(history.now, floor, random));
        frozen(history.now);
        assert.ok(!JSON.stringify(history.now).includes('null'), `edit ${i} of seed ${seed} gives what is no number`);
        const { plan } = history.now, numbers = plan.storeys.map((storey) => storey.number);
        assert.equal(new Set(numbers).size, numbers.length);
        assert.ok((plan.lifts ?? []).every((lift) => lift.stops.length && lift.stops.every((stop) => numbers.includes(stop))));
        most = Math.max(most, keysOf(plan.storeys[0]).length);
        floors = Math.max(floors, numbers.length);
        lifts = Math.max(lifts, plan.lifts?.length ?? 0);
      }
      const last = JSON.stringify(history.now);
      let undone = 0;
      while (history.undo() !== null) undone++;
      assert.equal(undone, EDITS);
      assert.equal(JSON.stringify(history.now), nothing);
      while (history.redo() !== null);
      assert.equal(JSON.stringify(history.now), last);
      assert.ok(most > 20 && floors > 2 && lifts > 1, `${most} items, ${floors} floors, ${lifts} lifts`);
    }
  },
  'an edit after an undo ends the others'() {
    const history = new History(empty()), set = (sensors) => history.do({ home: { sensors } });
    set('seed');
    set('casas');
    history.undo();
    set('none');
    assert.equal(history.redo(), null);
    assert.deepEqual(history.all.map((each) => each.sensors), ['none', 'seed', 'none']);
  },
  'a wall takes its doors and the ends of others along'() {
    const { history, storey } = flat();
    history.do(moved(storey(), ['walls/4'], 0, 1));
    close(itemOf(storey(), 'walls/4').start, [0, 4]);
    close(itemOf(storey(), 'walls/5').end, [4, 4]); // it ends on that wall
    const door = itemOf(storey(), 'openings/0');
    close([door.x, door.y], [6, 4]);
    history.do(moved(storey(), ['walls/1'], 1, 0)); // the east wall
    close([itemOf(storey(), 'walls/0').end[0], itemOf(storey(), 'walls/2').start[0], itemOf(storey(), 'walls/4').end[0]], [9, 9, 9]);
    history.do(removed(storey(), ['walls/4']));
    assert.equal(storey().openings, undefined);
  },
  'a door slides along its wall and stays within it'() {
    const { history, storey } = flat();
    history.do(moved(storey(), ['openings/0'], 5, 5));
    const door = itemOf(storey(), 'openings/0');
    close([door.x, door.y], [8 - door.width / 2, 3]);
    assert.equal(hostOf(storey(), door), 'walls/4');
  },
  'a corner moves with both of its walls'() {
    const { history, storey } = flat();
    history.do(stretched(storey(), 'walls/0', 'end', [9, -1]));
    close(itemOf(storey(), 'walls/1').start, [9, -1]);
  },
  'walls snap to ends, to walls and to 15 degrees'() {
    const { storey } = flat();
    close(snapped(storey(), [0.06, -0.05], 0.15), [0, 0]);
    close(snapped(storey(), [2.02, 3.1], 0.15), [2, 3]);
    close(snapped(storey(), [2.03, 8.96], 0.15), [2, 9]);
    close(snapped(storey(), [2.05, 5.92], 0.15, [2, 3.5]), [2, 6]); // on the north wall
    const end = snapped(empty().plan.storeys[0], [2.1, 1.1], 0.15, [0, 0]);
    close([Math.atan2(end[1], end[0]), Math.hypot(...end)], [Math.PI / 6, 2.4]);
  },
  'a room leaves out walls that are there'() {
    const { storey } = flat();
    assert.equal(roomWalls(storey(), [8, 0], [10, 3], 0.1).length, 3);
    assert.equal(wallAt(storey(), [4.02, 1], 0.1).key, 'walls/5');
  },
  'leaves turn over and back'() {
    const { storey } = flat(), wall = itemOf(storey(), 'walls/4');
    for (const sort of Object.keys(SORTS)) {
      const made = openingOf(sort, storey(), wall, 4, true), same = (other) => (made.leaves ?? []).forEach((leaf, i) => ['hinge', 'shut', 'turn', 'slide'].forEach((key) => assert.equal(String([other.leaves[i][key] ?? 0].flat().map((value) => value.toFixed(6) * 1)), String([leaf[key] ?? 0].flat().map((value) => value.toFixed(6) * 1)))));
      same(mirrored(mirrored(made)));
      same(swung(swung(made)));
      same(swung(mirrored(swung(mirrored(made)))));
    }
    const slider = openingOf('sliding door', storey(), wall, 4, true).leaves[0], over = mirrored({ ...openingOf('sliding door', storey(), wall, 4, true) }).leaves[0];
    close([over.hinge[1] - slider.hinge[1]], [0.04]); // the leaf is at its left, in front of the wall
  },
  'rooms beside a wall that moves are found again under their names'() {
    const { history, storey, add } = flat();
    add([['rooms', { name: 'kitchen', use: 'kitchen', polygon: [[0.05, 0.05], [3.95, 0.05], [3.95, 2.95], [0.05, 2.95]], floor: 0, ceiling: 2.5 }], ['rooms', { name: 'far', use: 'other', polygon: [[20, 0], [24, 0], [24, 3]], floor: 0, ceiling: 2.5 }]]);
    history.do(moved(storey(), ['walls/5'], 0.5, 0));
    assert.deepEqual(storey().rooms.map((room) => room.name), ['far']);
    assert.deepEqual(storey().labels.map((label) => [label.name, label.use]), [['kitchen', 'kitchen']]);
    assert.ok(storey().labels[0].x > 0.5 && storey().labels[0].x < 3.5);
  },
  'floors come and go with their walls, and lifts stop at all of them'() {
    const { history, storey, add } = flat(), below = storey();
    history.do(withFloor(history.now, true));
    const [ground, first] = history.now.plan.storeys;
    assert.deepEqual([first.number, first.elevation, ground.height], [1, 3, 3]);
    assert.deepEqual(first.walls.map((wall) => [wall.start, wall.end, wall.bottom, wall.top]), below.walls.map((wall) => [wall.start, wall.end, 3, 5.5]));
    add([['lifts', liftOf(history.now, [9.1, 3], Math.PI)]]);
    history.do(withFloor(history.now, false));
    assert.equal(history.now.plan.storeys[2].walls, undefined);
    assert.deepEqual(history.now.plan.lifts.map((lift) => lift.stops), [[0, 1, 2]]);
    history.do({ ...moved(storeyOf(history.now, 1), ['lifts/0'], 0, 1), storey: 1 });
    close([history.now.plan.lifts[0].x, history.now.plan.lifts[0].y], [9.1, 4]);
    assert.equal(history.undo(), 1); // the floor of that edit
    history.do(withoutFloor(history.now, 0));
    const lower = history.now.plan.storeys[0];
    assert.deepEqual([lower.number, lower.elevation, lower.walls[0].bottom, lower.name], [0, 0, 0, 'Floor 0']);
    assert.deepEqual(history.now.plan.lifts.map((lift) => lift.stops), [[0, 1]]);
    history.do(withoutFloor(history.now, 1));
    assert.equal(history.now.plan.lifts, undefined); // it would join nothing
  },
  'a lift whose shaft is drawn itself stays where it is'() {
    const lift = { name: 'lift', x: 1, y: 1, yaw: 0, width: 1, depth: 1, stops: [0] };
    assert.deepEqual(keysOf({ lifts: [lift], cutouts: [[[0, 0], [2, 0], [2, 2], [0, 2]]] }), []);
    assert.deepEqual(keysOf({ lifts: [lift] }), ['lifts/0']);
  },
  'copies are elsewhere, with what is in them'() {
    const { history, storey } = flat(), keys = ['walls/4', 'openings/0'], made = shifted(copied(storey(), keys), 0, 10);
    const after = apply(history.now, { add: made }).plan.storeys[0];
    close([after.openings[1].x, after.openings[1].y], [6, 13]);
    assert.equal(hostOf(after, after.openings[1]), 'walls/6');
    close([directionOf(after.walls[6])], [directionOf(after.walls[4])]);
  },
};

for (const [name, test] of Object.entries(tests)) {
  test();
  console.log(name);
}
