/** The drawing of a home, and edits of it. An edit is a value, and makes a new drawing: the old one stays as it was. */

/**
 * @typedef {number[]} Point x y, m
 * @typedef {Record<string, any>} Item
 * @typedef {{plan: {name: string, start?: string, storeys: Item[], lifts?: Item[]}, sensors: string}} Drawing
 * @typedef {{storey?: number, change?: Record<string, Item | null>, add?: [string, Item][], home?: Record<string, any>, plan?: Record<string, any>}} Edit
 * Items by their keys, such as `walls/3`; null removes one. `home`: values of the drawing itself, `plan`: of its plan.
 */

const LISTS = ['rooms', 'labels', 'walls', 'openings', 'pieces', 'lamps', 'sensors', 'movers', 'lifts'];
export const GRID = 0.1; // m
export const STEP = Math.PI / 12; // between the directions of walls
export const HEIGHT = 2.5; // m of a floor's walls
const SAME = 0.02; // m between ends that are joined
const JOINED = 0.12; // m between a wall's end and the face of another on which it ends
const BESIDE = 0.35; // m from a wall's middle to the edge of a room that it encloses
const RISE = 3, SLAB = 0.49; // m from floor to floor, and of the floor between
const LEAF_THICK = 0.04, LAP = 0.03; // m of a leaf, and of one that slides before the jamb
const { PI, cos, sin, hypot, abs, round, min, max, atan2 } = Math;

/** @returns {Drawing} an empty lot */
export const empty = () => ({ plan: { name: 'home', start: '2026-03-23T07:00:00', storeys: [{ number: 0, name: 'Ground floor', elevation: 0, height: HEIGHT }] }, sensors: 'none' });

/** @param {Drawing} drawing @param {Edit} edit @returns {Drawing} */
export function apply(drawing, { storey = 0, change = {}, add = [], home = {}, plan = {} }) {
  const after = { ...drawing.plan.storeys[storey] }, whole = /** @type {Drawing['plan']} */ ({ ...drawing.plan, storeys: drawing.plan.storeys.map((each, i) => (i === storey ? after : each)) });
  for (const list of LISTS) {
    const owner = /** @type {Item} */ (list === 'lifts' ? whole : after), kept = (owner[list] ?? []).map((/** @type {Item} */ item, /** @type {number} */ i) => {
      const changed = change[`${list}/${i}`];
      return changed === undefined ? item : changed;
    }).filter(Boolean), made = [...kept, ...add.filter(([name]) => name === list).map(([, item]) => item)];
    if (made.length) owner[list] = made;
    else delete owner[list];
  }
  return { ...drawing, ...home, plan: { ...whole, ...plan } };
}

/** @param {Drawing} drawing @param {number} index @returns {Item} a floor with the lifts that stop there */
export function storeyOf({ plan }, index) {
  const storey = plan.storeys[index];
  return plan.lifts ? { ...storey, lifts: plan.lifts } : storey;
}

/** All drawings since the first, each with the floor of its edit; undo and redo go through them. */
export class History {
  /** @param {Drawing} drawing */
  constructor(drawing) {
    this.all = [drawing];
    this.floors = [0];
    this.at = 0;
  }

  get now() { return this.all[this.at]; }

  /** @param {Edit} edit */
  do(edit) {
    this.all.splice(this.at + 1);
    this.floors.splice(this.at + 1);
    this.all.push(apply(this.now, edit));
    this.floors.push(edit.storey ?? 0);
    this.at++;
  }

  /** @returns {number | null} the floor of what is undone */
  undo() { return this.at > 0 ? this.floors[this.at--] : null; }

  /** @returns {number | null} the floor of what is done again */
  redo() { return this.at < this.all.length - 1 ? this.floors[++this.at] : null; }
}

// --- floors

/** @param {Item} storey @param {number} by m @returns {Item} with all that is on it */
function raised(storey, by) {
  const up = (/** @type {Item} */ item, /** @type {string[]} */ keys) => ({ ...item, ...Object.fromEntries(keys.filter((key) => typeof item[key] === 'number').map((key) => [key, exact(item[key] + by)])) });
  /** @type {Record<string, string[]>} */
  const heights = { walls: ['bottom', 'top', 'top_at_end'], openings: ['bottom', 'top'], rooms: ['floor'], pieces: ['z'], lamps: ['z'], sensors: ['z'] };
  return { ...up(storey, ['elevation']), ...Object.fromEntries(Object.entries(heights).filter(([list]) => storey[list]).map(([list, keys]) => [list, storey[list].map((/** @type {Item} */ item) => up(item, keys))])) };
}

/** @param {Drawing} drawing @param {boolean} walled whether it has the walls of the floor below @returns {Edit} with a floor on top */
export function withFloor({ plan }, walled) {
  const { storeys, lifts } = plan, top = storeys.reduce((a, b) => (b.elevation > a.elevation ? b : a)), number = max(...storeys.map((each) => each.number)) + 1, height = exact(max(RISE, top.height));
  const above = { number, name: `Floor ${number}`, elevation: exact(top.elevation + height), height: HEIGHT, slab: SLAB };
  const walls = walled && top.walls ? { walls: raised({ walls: top.walls }, height).walls } : {};
  return { plan: { storeys: [...storeys.map((each) => (each === top ? { ...top, height } : each)), { ...above, ...walls }],
    ...(lifts ? { lifts: lifts.map((lift) => (isBuilt(plan, lift) ? lift : { ...lift, stops: [...lift.stops, number] })) } : {}) } };
}

/** @param {Drawing} drawing @param {number} index @returns {Edit} without a floor; those above come down */
export function withoutFloor({ plan }, index) {
  const gone = plan.storeys[index], above = plan.storeys.filter((each) => each.elevation > gone.elevation), down = min(...above.map((each) => each.elevation)) - gone.elevation;
  const lower = (/** @type {number} */ number) => (above.some((each) => each.number === number) ? number - 1 : number);
  const storeys = plan.storeys.filter((each) => each !== gone).map((each) => (above.includes(each) ? { ...raised(each, -down), number: lower(each.number), ...(each.name === `Floor ${each.number}` ? { name: `Floor ${lower(each.number)}` } : {}) } : each));
  const lifts = (plan.lifts ?? []).map((lift) => ({ ...lift, stops: lift.stops.filter((/** @type {number} */ stop) => stop !== gone.number).map(lower) })).filter((lift) => lift.stops.length > 1);
  return { plan: { storeys, lifts: lifts.length ? lifts : undefined } };
}

/** @param {{storeys: Item[]}} plan @param {Item} lift @returns {boolean} whether its shaft is drawn itself, as in imported homes: it stays where it is */
export const isBuilt = (plan, lift) => plan.storeys.some((storey) => (storey.cutouts ?? []).some((/** @type {Point[]} */ cutout) => within(cutout, [lift.x, lift.y])));

const SHAFT = { width: 1.58, depth: 1.5, front: 0.98 }; // m of an elevator that is drawn, and from its middle to the floors of its landings
export const DOORWAY = 1.1; // m from its middle to the middle of the wall in which its doors are

/** @param {Drawing} drawing @param {Point} at its middle @param {number} yaw of its doorway @returns {Item} an elevator that stops on each floor */
export function liftOf({ plan }, [x, y], yaw) {
  const names = (plan.lifts ?? []).map((lift) => lift.name), name = ['elevator', ...names.map((_, i) => `elevator${i + 2}`)].find((each) => !names.includes(each));
  return { name, x: exact(x), y: exact(y), yaw: normal(yaw), ...SHAFT, stops: plan.storeys.map((storey) => storey.number).sort((a, b) => a - b) };
}

/** @param {Item} storey @param {string} key */
export function itemOf(storey, key) {
  const [list, index] = key.split('/');
  return storey[list]?.[Number(index)];
}

/** @param {Item} storey @returns {string[]} the keys of all items but lifts that stay where they are */
export const keysOf = (storey) => LISTS.flatMap((list) => (storey[list] ?? []).map((/** @type {Item} */ item, /** @type {number} */ i) => (list === 'lifts' && isBuilt({ storeys: [storey] }, item) ? '' : `${list}/${i}`))).filter(Boolean);

/** @param {any} storey @param {any} room @returns {{key: string, label: any} | null} the label in a room */
export function labelIn(storey, room) {
  const index = (storey.labels ?? []).findIndex((/** @type {any} */ label) => within(room.polygon, [label.x, label.y]));
  return index < 0 ? null : { key: `labels/${index}`, label: storey.labels[index] };
}

/** @param {number} value m @returns {number} to 0.1 mm */
const exact = (value) => round(value * 1e4) / 1e4 + 0;
/** @param {number} value m @returns {number} on the grid */
export const gridded = (value) => exact(round(value / GRID) * GRID);
/** @param {number} angle @returns {number} from -π to π */
export const normal = (angle) => exact(atan2(sin(angle), cos(angle)));

// --- walls

/** @param {Item} wall */
export const lengthOf = (wall) => hypot(wall.end[0] - wall.start[0], wall.end[1] - wall.start[1]);
/** @param {Item} wall */
export const directionOf = (wall) => atan2(wall.end[1] - wall.start[1], wall.end[0] - wall.start[0]);

/** @param {Item} wall @param {Point} at @returns {Point} in the wall's frame: along it, and to its left */
export function along(wall, [x, y]) {
  const yaw = directionOf(wall), [dx, dy] = [x - wall.start[0], y - wall.start[1]];
  return [dx * cos(yaw) + dy * sin(yaw), dy * cos(yaw) - dx * sin(yaw)];
}

/** @param {Item} wall @param {number} u @param {number} [v] @returns {Point} */
export function placeOn(wall, u, v = 0) {
  const yaw = directionOf(wall);
  return [wall.start[0] + u * cos(yaw) - v * sin(yaw), wall.start[1] + u * sin(yaw) + v * cos(yaw)];
}

/** @param {Item} storey @param {Point} start @param {Point} end @param {number} thickness @returns {Item} */
export const wallOf = (storey, start, end, thickness) => ({ start, end, thickness, bottom: storey.elevation, top: exact(storey.elevation + HEIGHT) });

/**
 * The wall at a place.
 * @param {Item} storey @param {Point} at @param {number} reach m beside it
 * @returns {{key: string, wall: Item, u: number, v: number, away: number} | null}
 */
export function wallAt(storey, at, reach) {
  let best = null, least = Infinity;
  for (const [i, wall] of (storey.walls ?? []).entries()) {
    const [u, v] = along(wall, at), over = max(0, -u, u - lengthOf(wall)), away = max(0, hypot(over, max(0, abs(v) - wall.thickness / 2)));
    if (away <= reach && away < least) { best = { key: `walls/${i}`, wall, u, v, away }; least = away; }
  }
  return best;
}

/**
 * Where a wall that is drawn begins or ends: at an end of another, on its middle, else on the grid; from `from` at a
 * multiple of 15°.
 * @param {Item} storey @param {Point} at @param {number} reach m @param {Point | null} [from] @param {number} [least] m of its length
 * @returns {Point}
 */
export function snapped(storey, at, reach, from = null, least = 0) {
  const walls = storey.walls ?? [], ends = walls.flatMap((/** @type {Item} */ wall) => [wall.start, wall.end]);
  const near = nearest(ends.filter((/** @type {Point} */ end) => !from || distance(end, from) > least), at, reach);
  if (near) return near;
  if (!from) {
    const on = wallAt(storey, at, reach);
    return on ? placeOn(on.wall, min(lengthOf(on.wall), max(0, gridded(on.u)))).map(exact) : at.map(gridded);
  }
  const far = distance(at, from), yaw = round(atan2(at[1] - from[1], at[0] - from[0]) / STEP) * STEP;
  let length = gridded(far);
  for (const wall of walls) { // it ends on the middle of another
    const turn = sin(directionOf(wall) - yaw), [u, v] = along(wall, from);
    if (abs(turn) < 0.2) continue;
    const long = v / turn, met = u + long * cos(directionOf(wall) - yaw);
    if (abs(long - far) < reach && long > least && met > -reach && met < lengthOf(wall) + reach) length = long;
  }
  return [exact(from[0] + length * cos(yaw)), exact(from[1] + length * sin(yaw))];
}

/** @param {Point} a @param {Point} b */
export const distance = (a, b) => hypot(a[0] - b[0], a[1] - b[1]);

/** @param {Point[]} points @param {Point} at @param {number} reach @returns {Point | null} */
function nearest(points, at, reach) {
  const best = points.reduce((/** @type {Point | null} */ found, point) => (!found || distance(point, at) < distance(found, at) ? point : found), null);
  return best && distance(best, at) <= reach ? best : null;
}

/** @param {Item} storey @param {Point} a @param {Point} b corners @param {number} thickness @returns {Item[]} the walls that a room still needs */
export function roomWalls(storey, a, b, thickness) {
  const corners = [a, [b[0], a[1]], b, [a[0], b[1]]];
  return corners.map((corner, i) => wallOf(storey, corner, corners[(i + 1) % 4], thickness)).filter((made) => !(storey.walls ?? []).some((/** @type {Item} */ wall) =>
    [made.start, made.end].every((end) => { const [u, v] = along(wall, end); return abs(v) < 0.05 && u > -0.05 && u < lengthOf(wall) + 0.05; })));
}

// --- doors and windows

/** Openings that one can put into a wall: width, foot and top over the floor, and how the leaf moves. */
export const SORTS = {
  door: { kind: 'door', width: 0.87, foot: 0, top: 2.05, leaves: 1 },
  'double door': { kind: 'door', width: 1.41, foot: 0, top: 2.05, leaves: 2 },
  'sliding door': { kind: 'door', width: 0.9, foot: 0, top: 2.05, slides: true },
  'glass door': { kind: 'door', width: 0.87, foot: 0, top: 2.05, leaves: 1, glazed: true },
  window: { kind: 'window', width: 1.2, foot: 0.95, top: 2.15, leaves: 1 },
  'fixed window': { kind: 'window', width: 1.2, foot: 0.95, top: 2.15, glass: true },
  passage: { kind: 'opening', width: 0.9, foot: 0, top: 2.05 },
};

/**
 * @param {string} sort @param {Item} storey @param {Item} wall @param {number} u m from the wall's start to its middle @param {boolean} [left] the side to which it opens
 * @returns {Item}
 */
export function openingOf(sort, storey, wall, u, left = true) {
  const { kind, width, foot, top, ...how } = /** @type {any} */ (SORTS)[sort], half = exact(wall.thickness / 2), [x, y] = placeOn(wall, u).map(exact);
  const made = { kind, x, y, yaw: normal(directionOf(wall)), width, bottom: exact(storey.elevation + foot), top: exact(storey.elevation + top), band: [-half, half], source: sort };
  const wide = exact((width - 0.01) / (how.leaves ?? 1));
  const turning = [{ hinge: [-exact((width - 0.01) / 2), half], width: wide, shut: 0, turn: PI / 2 }, { hinge: [exact((width - 0.01) / 2), half], width: wide, shut: PI, turn: -PI / 2 }];
  const leaves = how.slides ? [{ hinge: [-exact(width / 2 + LAP), exact(half + 0.01)], width: exact(width + LAP), shut: 0, slide: -width }] : turning.slice(0, how.leaves ?? 0);
  const whole = { ...made, ...(leaves.length ? { leaves } : {}), ...(how.glass ? { glass: true } : {}), ...(how.glazed ? { glazed: true } : {}) };
  return left ? whole : swung(whole);
}

/** @param {Item} opening @returns {Item} with its hinges at the other side */
export const mirrored = (opening) => leafed(opening, (leaf) => {
  const shut = abs(leaf.shut) > 1 ? 0 : PI;
  const beside = leaf.turn ? 0 : shut ? LEAF_THICK : -LEAF_THICK; // a leaf that slides is at the left of its own direction
  return { ...leaf, hinge: [-leaf.hinge[0], exact(leaf.hinge[1] + beside)], shut, turn: -(leaf.turn ?? 0) };
});

/** @param {Item} opening @returns {Item} that opens to the other side */
export const swung = (opening) => leafed(opening, (leaf) => {
  const beside = leaf.turn ? 0 : abs(leaf.shut) > 1 ? -LEAF_THICK : LEAF_THICK;
  return { ...leaf, hinge: [leaf.hinge[0], exact(opening.band[0] + opening.band[1] - leaf.hinge[1] - beside)], turn: -(leaf.turn ?? 0) };
});

/** @param {Item} opening @param {number} width m @returns {Item} */
export function widened(opening, width) {
  const ratio = width / opening.width;
  return { ...leafed(opening, (leaf) => ({ ...leaf, hinge: [exact(leaf.hinge[0] * ratio), leaf.hinge[1]], width: exact(leaf.width * ratio), slide: exact((leaf.slide ?? 0) * ratio) })), width };
}

/** @param {Item} opening @param {(leaf: Item) => Item} change @returns {Item} */
const leafed = (opening, change) => (opening.leaves ? { ...opening, leaves: opening.leaves.map(change) } : opening);

/** @param {Item} storey @param {Item} opening @returns {string | null} the key of the wall that it is in */
export function hostOf(storey, opening) {
  const hosts = [...(storey.walls ?? []).entries()].filter(([, wall]) => {
    const [u, v] = along(wall, [opening.x, opening.y]);
    return abs(sin(directionOf(wall) - opening.yaw)) < 0.2 && abs(v) < wall.thickness / 2 + 0.1 && u > -0.05 && u < lengthOf(wall) + 0.05;
  });
  return hosts.length ? `walls/${hosts[0][0]}` : null;
}

/** @param {Item} opening @param {Item} wall @param {number} u @returns {Item} at another place of a wall, within its ends */
export function onWall(opening, wall, u) {
  const half = opening.width / 2, long = lengthOf(wall), at = long < 2 * half ? long / 2 : min(long - half, max(half, u)), [x, y] = placeOn(wall, at).map(exact);
  const turned = abs(normal(directionOf(wall) - opening.yaw)) > PI / 2; // it keeps its side
  return { ...opening, x, y, yaw: normal(directionOf(wall) + (turned ? PI : 0)), band: rebanded(opening, wall) };
}

/** @param {Item} opening @param {Item} wall @returns {number[]} */
function rebanded(opening, wall) {
  const [low, high] = opening.band;
  return abs(high - low - wall.thickness) < 0.02 ? opening.band : [-wall.thickness / 2, wall.thickness / 2].map(exact);
}

// --- changes of a selection, as the `change` of an edit

/** @typedef {Record<string, Item | null>} Change */

/**
 * Walls at other places; what is in them follows, and rooms beside them are found again.
 * @param {Item} storey @param {Map<string, Item | null>} walls by key; null: it is removed @param {string[]} [others] that are changed or removed themselves
 * @returns {{change: Change, add: [string, Item][]}}
 */
export function withWalls(storey, walls, others = []) {
  /** @type {Change} */
  const change = Object.fromEntries(walls);
  for (const [i, opening] of (storey.openings ?? []).entries()) {
    const host = hostOf(storey, opening), made = host ? walls.get(host) : undefined;
    if (made === undefined) continue;
    const old = itemOf(storey, String(host)), [u] = along(old, [opening.x, opening.y]);
    const fixedEnd = made && distance(made.start, old.start) > SAME && distance(made.end, old.end) < SAME;
    change[`openings/${i}`] = made && onWall(opening, made, fixedEnd ? lengthOf(made) - (lengthOf(old) - u) : u);
  }
  /** @type {[string, Item][]} */
  const add = [];
  const moved = [...walls].flatMap(([key, wall]) => [itemOf(storey, key), ...(wall ? [wall] : [])]);
  for (const [i, room] of (storey.rooms ?? []).entries()) {
    if (others.includes(`rooms/${i}`) || !moved.some((wall) => bounds(wall, room.polygon))) continue;
    const [x, y] = innerPoint(room.polygon).map(exact);
    change[`rooms/${i}`] = null;
    add.push(['labels', { name: room.name, x, y, ...(room.use ? { use: room.use } : {}) }]);
  }
  return { change, add };
}

/** @param {Item} wall @param {Point[]} polygon @returns {boolean} whether the wall is at or in a room */
function bounds(wall, polygon) {
  const count = max(2, Math.ceil(lengthOf(wall) / 0.25));
  return Array.from({ length: count - 1 }, (_, i) => placeOn(wall, ((i + 1) / count) * lengthOf(wall))).some((at) => within(polygon, at) || polygon.some((corner, i) => {
    const edge = { start: corner, end: polygon[(i + 1) % polygon.length] }, [u, v] = along(edge, at);
    return u > 0 && u < lengthOf(edge) && abs(v) < BESIDE;
  }));
}

/** @param {Point[]} polygon @param {Point} at */
export function within(polygon, [x, y]) {
  let odd = false;
  polygon.forEach(([x0, y0], i) => {
    const [x1, y1] = polygon[(i + 1) % polygon.length];
    if (y0 > y !== y1 > y && x < x0 + ((y - y0) / (y1 - y0)) * (x1 - x0)) odd = !odd;
  });
  return odd;
}

/** @param {Point[]} polygon @returns {Point} well inside */
export function innerPoint(polygon) {
  const xs = polygon.map(([x]) => x), ys = polygon.map(([, y]) => y), [left, below] = [min(...xs), min(...ys)], [wide, high] = [max(...xs) - left, max(...ys) - below];
  let best = polygon[0], most = -1;
  for (let i = 1; i < 12; i++) {
    for (let j = 1; j < 12; j++) {
      const at = [left + (wide * i) / 12, below + (high * j) / 12];
      if (!within(polygon, at)) continue;
      const away = min(...polygon.map((corner, k) => toSegment(at, corner, polygon[(k + 1) % polygon.length])));
      if (away > most + 1e-9) { best = at; most = away; }
    }
  }
  return best;
}

/** @param {Point} at @param {Point} start @param {Point} end @returns {number} m */
function toSegment(at, start, end) {
  const wall = { start, end }, [u, v] = along(wall, at);
  return hypot(v, max(0, -u, u - lengthOf(wall)));
}

/**
 * A selection moved; walls take the ends of those along that are joined to them.
 * @param {Item} storey @param {string[]} keys @param {number} dx @param {number} dy
 * @returns {{change: Change, add: [string, Item][]}}
 */
export function moved(storey, keys, dx, dy) {
  const chosen = new Set(keys), by = (/** @type {Point} */ [x, y]) => [exact(x + dx), exact(y + dy)];
  /** @type {Map<string, Item | null>} */
  const walls = new Map();
  const old = keys.filter((key) => key.startsWith('walls/')).map((key) => itemOf(storey, key));
  for (const [i, wall] of old.length ? (storey.walls ?? []).entries() : []) {
    const key = `walls/${i}`;
    const end = (/** @type {Point} */ at) => (chosen.has(key) || old.some((one) => distance(one.start, at) < SAME || distance(one.end, at) < SAME) ? by(at) : pushed(old, at, dx, dy));
    const made = { ...wall, start: end(wall.start), end: end(wall.end) };
    if (distance(made.start, wall.start) + distance(made.end, wall.end) > 0) walls.set(key, made);
  }
  const { change, add } = withWalls(storey, walls, keys);
  for (const key of keys) {
    const item = itemOf(storey, key), [list] = key.split('/');
    if (list === 'walls' || key in change || !item) continue;
    if (list === 'openings') {
      const host = hostOf(storey, item), wall = host && itemOf(storey, host);
      const [u] = wall ? along(wall, by([item.x, item.y])) : [0];
      change[key] = wall ? onWall(item, wall, u) : { ...item, x: exact(item.x + dx), y: exact(item.y + dy) };
    } else if (list === 'rooms') change[key] = { ...item, polygon: item.polygon.map(by), ...(item.holes ? { holes: item.holes.map((/** @type {Point[]} */ hole) => hole.map(by)) } : {}) };
    else change[key] = { ...item, x: exact(item.x + dx), y: exact(item.y + dy) };
  }
  return { change, add };
}

/** @param {Item[]} walls that move @param {Point} at the end of another @param {number} dx @param {number} dy @returns {Point} it stays on the wall on which it is */
function pushed(walls, at, dx, dy) {
  const on = walls.find((wall) => { const [u, v] = along(wall, at); return u > -SAME && u < lengthOf(wall) + SAME && abs(v) < wall.thickness / 2 + JOINED; });
  if (!on) return at;
  const yaw = directionOf(on), across = dy * cos(yaw) - dx * sin(yaw);
  return [exact(at[0] - across * sin(yaw)), exact(at[1] + across * cos(yaw))];
}

/**
 * A wall with an end elsewhere, and those that are joined to that end.
 * @param {Item} storey @param {string} key @param {'start' | 'end'} which @param {Point} to
 */
export function stretched(storey, key, which, to) {
  const from = itemOf(storey, key)[which];
  /** @type {Map<string, Item | null>} */
  const walls = new Map();
  for (const [i, wall] of (storey.walls ?? []).entries()) {
    const made = { ...wall };
    for (const end of /** @type {const} */ (['start', 'end'])) if (distance(wall[end], from) < SAME) made[end] = to;
    if (made.start !== wall.start || made.end !== wall.end) walls.set(`walls/${i}`, made);
  }
  return withWalls(storey, walls);
}

/** @param {Item} storey @param {string[]} keys */
export function removed(storey, keys) {
  const { change, add } = withWalls(storey, new Map(keys.filter((key) => key.startsWith('walls/')).map((key) => [key, null])), keys);
  return { change: { ...change, ...Object.fromEntries(keys.map((key) => [key, null])) }, add };
}

/** @param {Item} item @returns {Point[]} its places */
export const placesOf = (item) => (item.start ? [item.start, item.end] : item.polygon ?? (item.stops ? [[item.x - DOORWAY, item.y - DOORWAY], [item.x + DOORWAY, item.y + DOORWAY]] : [[item.x, item.y]]));

/** @param {Item} storey @param {string[]} keys @returns {Point} the middle of a selection */
export function middleOf(storey, keys) {
  const places = keys.flatMap((key) => placesOf(itemOf(storey, key))), xs = places.map(([x]) => x), ys = places.map(([, y]) => y);
  return [(min(...xs) + max(...xs)) / 2, (min(...ys) + max(...ys)) / 2];
}

/** @param {Item} storey @param {string[]} keys @param {number} angle @returns {{change: Change, add: [string, Item][]}} a selection turned about its middle */
export function turned(storey, keys, angle) {
  const [mx, my] = middleOf(storey, keys), [c, s] = [cos(angle), sin(angle)];
  const at = (/** @type {Point} */ [x, y]) => [exact(mx + c * (x - mx) - s * (y - my)), exact(my + s * (x - mx) + c * (y - my))];
  const walls = new Map(keys.filter((key) => key.startsWith('walls/')).map((key) => {
    const wall = itemOf(storey, key);
    return [key, /** @type {Item | null} */ ({ ...wall, start: at(wall.start), end: at(wall.end) })];
  }));
  const { change, add } = withWalls(storey, walls, keys);
  for (const key of keys) {
    const item = itemOf(storey, key), [list] = key.split('/');
    if (list === 'walls' || key in change) continue;
    if (list === 'openings') change[key] = keys.length === 1 ? turnedDoor(item) : item;
    else if (list === 'rooms') change[key] = { ...item, polygon: item.polygon.map(at), holes: (item.holes ?? []).map((/** @type {Point[]} */ hole) => hole.map(at)) };
    else {
      const [x, y] = at([item.x, item.y]);
      change[key] = { ...item, x, y, ...('yaw' in item ? { yaw: normal(item.yaw + angle) } : {}) };
    }
  }
  return { change, add };
}

/** @param {Item} opening @returns {Item} the next of its four ways to open */
export function turnedDoor(opening) {
  const leaf = opening.leaves?.[0];
  return leaf && leaf.hinge[0] > 0 ? swung(mirrored(opening)) : mirrored(opening);
}

/** @param {Item} storey @param {string[]} keys @returns {[string, Item][]} copies */
export const copied = (storey, keys) => keys.map((key) => [key.split('/')[0], itemOf(storey, key)]);

/** @param {[string, Item][]} items @param {number} dx @param {number} dy @returns {[string, Item][]} elsewhere */
export function shifted(items, dx, dy) {
  const storey = Object.fromEntries(LISTS.map((list) => [list, items.filter(([name]) => name === list).map(([, item]) => item)]));
  const { change } = moved(storey, keysOf(storey), dx, dy);
  return keysOf(storey).map((key) => [key.split('/')[0], /** @type {Item} */ (change[key] ?? itemOf(storey, key))]);
}
