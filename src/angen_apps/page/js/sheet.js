/** What the sheet shows of a home that is drawn, and where. */
import { mapOf } from './coverage.js';
import { by, svg, words } from './dom.js';
import { distance, isBuilt, itemOf, keysOf, labelIn, normal, placesOf } from './drawing.js';
import { reach } from './fields.js';
import { numbers } from './lang.js';
import { LETTER, Taken, fitted, nameOf } from './places.js';
import { furniture, signOf } from './symbols.js';

/** @typedef {import('./drawing.js').Item} Item @typedef {import('./drawing.js').Point} Point */

const FINGER = 22; // px around a finger
export const MOUSE = 9; // px around a mouse
export const SIGN = 0.17, SPOT = 0.12, BODY = 0.22; // m of marks: half of a lamp, a sensor, a person
const LEAST_MARK = 7; // px
const THIN = 0.55; // of a text's height: the width of a letter of a room's name
const FARTHEST = 8, LEAST = 4, MOST = 400; // m of the ground that an empty lot shows; px of a meter
const MARGIN = 44, ABOVE = 76, BELOW = 72; // px around all, above, and below
const { PI, cos, sin, min, max, abs, atan2 } = Math;

export class Sheet {
  /** @param {import('./edit.js').Editor} editor */
  constructor(editor) {
    this.editor = editor;
    this.element = by('board');
    this.root = svg('svg', { class: 'drawing', 'aria-hidden': 'true' });
    this.element.append(this.root);
    this.middle = [4, 3];
    this.scale = 60; // px of a meter
    this.fingers = false; // whether one touches it
    /** @type {any} */
    this.behind = null;
    this.bare = false; // without that picture
    /** @type {any} an edit that a drag would make */
    this.preview = null;
    /** @type {WeakMap<Item, {key: string, node: any}>} what was drawn of an item that is still the same */
    this.drawn = new WeakMap();
    /** @type {any[][]} */
    this.named = [[], []]; // shapes and names of rooms
  }

  draw() { }

  /** @param {number} scale m of a pixel of the plan that was imported, which is shown behind the drawing */
  showBehind(scale) {
    const picture = new Image();
    picture.onload = () => {
      const [width, height] = [picture.naturalWidth * scale, picture.naturalHeight * scale];
      this.behind = svg('image', { class: 'behind', href: picture.src, width, height, y: -height });
      this.draw();
    };
    picture.src = '/behind';
  }

  /** @param {Item} storey @returns {any[]} that picture, on the ground floor */
  picture(storey) { return this.behind && !this.bare && storey.number === 0 ? [this.behind] : []; }

  // --- places

  box() { return this.element.getBoundingClientRect(); }

  /** @param {number} x @param {number} y px of the window @returns {Point} */
  ground(x, y) {
    const { left, top, width, height } = this.box();
    return [this.middle[0] + (x - left - width / 2) / this.scale, this.middle[1] - (y - top - height / 2) / this.scale];
  }

  /** @param {Point} at @returns {number[]} px of the window */
  screen([x, y]) {
    const { left, top, width, height } = this.box();
    return [left + width / 2 + (x - this.middle[0]) * this.scale, top + height / 2 - (y - this.middle[1]) * this.scale];
  }

  /** @param {number} factor @param {number[]} [at] px that stay where they are */
  zoom(factor, at) {
    const { left, top, width, height } = this.box(), px = at ?? [left + width / 2, top + height / 2], before = this.ground(px[0], px[1]);
    this.scale = min(MOST, max(LEAST, this.scale * factor));
    const after = this.ground(px[0], px[1]);
    this.middle = [this.middle[0] + before[0] - after[0], this.middle[1] + before[1] - after[1]];
    this.draw();
  }

  /** Shows all that is drawn. */
  whole() {
    const { storey } = this.editor, places = keysOf(storey).flatMap((key) => placesOf(itemOf(storey, key)));
    if (places.length < 2) places.push([0, 0], [FARTHEST, FARTHEST * 0.75]);
    const xs = places.map(([x]) => x), ys = places.map(([, y]) => y), { width, height } = this.box();
    this.scale = min(MOST / 2, max(LEAST, min((width - 2 * MARGIN) / (max(...xs) - min(...xs) || 1), (height - BELOW - ABOVE) / (max(...ys) - min(...ys) || 1))));
    this.middle = [(min(...xs) + max(...xs)) / 2, (min(...ys) + max(...ys) + (ABOVE - BELOW) / this.scale) / 2];
    this.draw();
  }

  get reach() { return (this.fingers ? FINGER : MOUSE) / this.scale; }

  /** @param {Item} item @param {string} key what it looks like beside its own values @param {() => any} make @returns {any} */
  once(item, key, make) {
    const old = this.drawn.get(item);
    if (old?.key === key) return old.node;
    const node = make();
    this.drawn.set(item, { key, node });
    return node;
  }

  /** @param {number} w @param {number} h m */
  grid(w, h) {
    const step = this.scale > 25 ? 1 : 5, [left, top] = [Math.floor((this.middle[0] - w / 2) / step) * step, Math.floor((-this.middle[1] - h / 2) / step) * step];
    let d = '';
    for (let x = left; x <= left + w + step; x += step) d += `M${x} ${top}v${h + 2 * step}`;
    for (let y = top; y <= top + h + step; y += step) d += `M${left} ${y}h${w + 2 * step}`;
    return svg('path', { class: 'grid', d });
  }

  /** @param {Item} storey @returns {any[][]} the shapes of rooms, and their names */
  rooms(storey) {
    if (this.preview) return this.named; // they need not be placed again
    const text = max(0.2, 12 / this.scale), taken = new Taken(), path = (/** @type {Point[]} */ p) => `M${p.map(([x, y]) => `${x} ${-y}`).join('L')}Z`;
    for (const { x, y, yaw = 0, depth, width } of storey.pieces ?? []) {
      const [c, s] = [abs(cos(yaw)), abs(sin(yaw))];
      taken.boxes.push([x, y, (c * depth + s * width) / 2, (s * depth + c * width) / 2]);
    }
    for (const list of ['lamps', 'sensors', 'movers']) {
      for (const { x, y, name } of storey[list] ?? []) {
        const half = this.half(list), own = this.small;
        taken.boxes.push([x, y, half, half]);
        if (list === 'movers') taken.boxes.push([x, y - half - 0.7 * own, (LETTER / 2) * own * name.length, 0.6 * own]);
      }
    }
    for (const { x, y, width } of storey.openings ?? []) taken.boxes.push([x, y, width / 2, width / 2]);
    const rooms = [...this.editor.rooms.entries()];
    this.named = [rooms.map(([i, room]) => svg('path', { class: `room-shape${this.editor.room === i ? ' chosen' : ''}`, d: [room.polygon, ...room.holes].map(path).join(''), 'fill-rule': 'evenodd', 'stroke-width': 0 })),
      rooms.map(([, room]) => {
        const own = words(labelIn(storey, room)?.label.name || room.name), area = `\u200e · ${numbers(areaOf(room.polygon).toFixed(1))} m²`, name = fitted(own, room.polygon, 1.2 * THIN * text, area), wide = (THIN / 2) * text * name.length, [x, y] = nameOf(room.polygon, wide, text / 2, taken);
        return svg('text', { class: 'room-name', x, y: -y + 0.35 * text, 'font-size': text }, name);
      })];
    return this.named;
  }

  /** @returns {number} m: the height of the names of people and robots */
  get small() { return max(0.16, 11 / this.scale); }

  /** @param {string} list @returns {number} m: half of the width of its marks */
  half(list) { return max(LEAST_MARK / this.scale, list === 'sensors' ? SPOT : list === 'movers' ? BODY : SIGN); }

  /** @param {Item} storey @param {Set<string>} chosen */
  walls(storey, chosen) {
    const line = (/** @type {Item} */ wall, /** @type {string} */ cls, more = 0) => svg('line', { class: cls, x1: wall.start[0], y1: -wall.start[1], x2: wall.end[0], y2: -wall.end[1], 'stroke-width': wall.thickness + more });
    const shown = [...(storey.walls ?? []).entries()];
    const measured = chosen.size === 1 ? shown.filter(([i]) => chosen.has(`walls/${i}`)).map(([, wall]) => this.measure(wall.start, wall.end)) : [];
    const moving = this.preview ? shown.filter(([i, wall]) => wall !== (this.editor.storey.walls ?? [])[i]).map(([, wall]) => this.measure(wall.start, wall.end)) : [];
    return [...shown.filter(([i]) => chosen.has(`walls/${i}`)).map(([, wall]) => line(wall, 'wall chosen', 6 / this.scale)), ...shown.map(([, wall]) => line(wall, 'wall')),
      ...(storey.openings ?? []).map((/** @type {Item} */ opening, /** @type {number} */ i) => {
        const mine = chosen.has(`openings/${i}`);
        return this.once(opening, `${mine ? this.scale : ''}`, () => this.opening(opening, mine));
      }), ...measured, ...moving];
  }

  /** @param {Item} opening @param {boolean} chosen @param {string} [cls] */
  opening(opening, chosen, cls = '') {
    const { x, y, yaw, width, band, kind } = opening, [c, s] = [cos(yaw), sin(yaw)];
    const at = (/** @type {number} */ u, /** @type {number} */ v) => `${(x + u * c - v * s).toFixed(4)} ${(-(y + u * s + v * c)).toFixed(4)}`, half = width / 2;
    const across = (/** @type {number} */ v) => `M${at(-half, v)}L${at(half, v)}`, [low, high] = band, middle = (low + high) / 2;
    let leaves = '', swings = '';
    for (const leaf of opening.leaves ?? []) {
      const [u, v] = leaf.hinge, way = leaf.shut + (kind === 'window' ? 0.35 : 1) * (leaf.turn ?? 0), end = (/** @type {number} */ a) => at(u + leaf.width * cos(a), v + leaf.width * sin(a));
      leaves += `M${at(u, v)}L${end(way)}`;
      if (leaf.turn) swings += `M${end(leaf.shut)}A${leaf.width} ${leaf.width} 0 0 ${leaf.turn > 0 ? 0 : 1} ${end(way)}`;
      if (leaf.slide) swings += `M${at(u + leaf.slide * cos(leaf.shut), v)}L${at(u, v)}`;
    }
    return svg('g', { class: `item ${kind === 'window' ? 'window' : 'door'} ${chosen ? 'chosen' : ''} ${cls}` },
      chosen ? svg('path', { class: 'halo', d: across(middle), 'stroke-width': high - low + 10 / this.scale }) : null, svg('path', { class: 'gap', d: across(middle), style: `stroke-width: ${high - low + 0.02}` }),
      kind === 'window' || opening.glazed || opening.glass ? svg('path', { class: 'pane', d: [low, middle, high].map(across).join('') }) : null,
      swings ? svg('path', { class: 'swing', d: swings }) : null, leaves ? svg('path', { class: 'leaf', d: leaves }) : null);
  }

  /** @returns {any[]} what motion sensors see, and the place whose sensors the card lists */
  cover() {
    const { told: { coverage }, spot, room } = this.editor, dot = spot && room !== null ? [svg('circle', { class: 'dot', r: 5 / this.scale, cx: spot[0], cy: -spot[1] })] : [];
    if (!coverage || !this.covered) return dot;
    const shown = this.once(coverage, '', () => svg('g', {}, ...mapOf(coverage)));
    return [shown, ...dot];
  }

  get covered() { return false; }

  /** @param {Item} storey @returns {any[]} the walls of the floor below */
  below(storey) {
    const lower = this.editor.history.now.plan.storeys.filter((each) => each.elevation < storey.elevation).sort((a, b) => b.elevation - a.elevation)[0];
    return (lower?.walls ?? []).map((/** @type {Item} */ wall) => svg('line', { class: 'wall below', x1: wall.start[0], y1: -wall.start[1], x2: wall.end[0], y2: -wall.end[1], 'stroke-width': wall.thickness }));
  }

  /** @param {Item} storey @param {Set<string>} chosen */
  lifts(storey, chosen) {
    const built = (/** @type {Item} */ lift) => isBuilt({ storeys: [storey] }, lift);
    return (storey.lifts ?? []).map((/** @type {Item} */ lift, /** @type {number} */ i) => (lift.stops.includes(storey.number) ? this.lift(lift, chosen.has(`lifts/${i}`), '', !built(lift)) : null)).filter(Boolean);
  }

  /** @param {Item} lift @param {boolean} chosen @param {string} [cls] @param {boolean} [walled] whether its shaft is shown with it */
  lift({ x, y, yaw, width, depth, front }, chosen, cls = '', walled = true) {
    const half = width / 2, deep = depth / 2, side = half + 0.16, back = -deep - 0.15, door = front + 0.12, gap = 0.58;
    return svg('g', { class: `item lift ${chosen ? 'chosen' : ''} ${cls}`, transform: `translate(${x} ${-y}) rotate(${(-yaw * 180) / PI})` },
      walled ? svg('path', { class: `wall${chosen ? ' chosen' : ''}`, 'stroke-width': 0.2, d: `M${door} ${-gap}V${-side}H${back}V${side}H${door}V${gap}` }) : null,
      svg('path', { class: 'face', d: `M${-deep} ${-half}H${deep}V${half}H${-deep}Z` }), svg('path', { class: 'sign', d: `M${-deep} ${-half}L${deep} ${half}M${-deep} ${half}L${deep} ${-half}M${deep + 0.08} ${-gap}V-.02M${deep + 0.08} ${gap}V.02` }));
  }

  /** @param {Item} storey @param {Set<string>} chosen */
  things(storey, chosen) {
    return (storey.pieces ?? []).map((/** @type {Item} */ piece, /** @type {number} */ i) => {
      const mine = chosen.has(`pieces/${i}`);
      return this.once(piece, String(mine), () => this.piece(piece, mine));
    });
  }

  /** @param {Item} piece @param {boolean} chosen @param {string} [cls] */
  piece(piece, chosen, cls = '') {
    const { x, y, yaw, width, depth } = piece, [c, s] = [cos(yaw), sin(yaw)];
    const at = (/** @type {number} */ u, /** @type {number} */ v) => [x + (u * c * depth) / 2 - (v * s * width) / 2, y + (u * s * depth) / 2 + (v * c * width) / 2];
    return svg('g', { class: `thing-shape ${chosen ? 'chosen' : ''} ${cls}` }, ...furniture(this.editor.symbols[piece.thing], at, piece.shape === 'cylinder', piece.shape === 'flat'));
  }

  /** @param {Item} storey @param {Set<string>} chosen */
  marks(storey, chosen) {
    const of = (/** @type {string} */ list) => [...(storey[list] ?? []).entries()];
    const ruled = this.editor.ruled.flatMap((sensor) => [this.field(storey, sensor, false), this.once(sensor, String(this.scale), () => this.mark('sensors', sensor, false, 'ruled'))]);
    const fields = of('sensors').map(([i, sensor]) => this.field(storey, sensor, chosen.has(`sensors/${i}`)));
    const marks = ['lamps', 'sensors', 'movers'].flatMap((list) => of(list).map(([i, item]) => this.once(item, `${this.scale} ${chosen.has(`${list}/${i}`)}`, () => this.mark(list, item, chosen.has(`${list}/${i}`)))));
    return [...ruled.filter(Boolean), ...fields.filter(Boolean), ...marks];
  }

  /** @param {string} list @param {Item} item @param {boolean} chosen @param {string} [cls] */
  mark(list, item, chosen, cls = '') {
    const sensor = list === 'sensors', mover = list === 'movers', size = this.half(list), kind = mover ? item.kind : sensor ? 'sensor' : 'lamp';
    const text = this.small, turn = (-(item.yaw ?? 0) * 180) / PI;
    return svg('g', { class: `item ${kind} ${chosen ? 'chosen' : ''} ${cls}`, transform: `translate(${item.x} ${-item.y})` },
      chosen ? svg('circle', { class: 'halo', r: size + 5 / this.scale }) : null, svg('g', { transform: `rotate(${turn})` }, ...signOf(kind, size, sensor, mover), sensor ? svg('path', { class: 'nose', d: `M${size} 0h${size}` }) : null),
      mover ? svg('text', { class: 'who', 'font-size': text, y: size + text }, item.name) : null);
  }

  /** @param {Item} storey @param {Item} sensor @param {boolean} chosen */
  field(storey, sensor, chosen) {
    const of = this.editor.catalog.sensors.find((/** @type {any} */ one) => one.model === sensor.model);
    if (!of?.far) return null;
    const high = sensor.z - storey.elevation, steps = 32;
    let points;
    if (sensor.pitch > 1) {
      const far = high * Math.tan(min(1.3, of.left));
      points = Array.from({ length: steps }, (_, i) => [sensor.x + far * cos((2 * PI * i) / steps), sensor.y + far * sin((2 * PI * i) / steps)]);
    } else {
      const walls = (storey.walls ?? []).map((/** @type {Item} */ wall) => [wall.start, wall.end]);
      points = [[sensor.x, sensor.y], ...Array.from({ length: steps + 1 }, (_, i) => {
        const way = sensor.yaw + of.right + ((of.left - of.right) * i) / steps, to = [cos(way), sin(way)], far = min(of.far, ...walls.map((/** @type {Point[]} */ wall) => reach(wall, [sensor.x, sensor.y], to)));
        return [sensor.x + far * to[0], sensor.y + far * to[1]];
      })];
    }
    return svg('polygon', { class: `field${chosen ? ' chosen' : ''}`, points: points.map(([x, y]) => `${x.toFixed(3)},${(-y).toFixed(3)}`).join(' ') });
  }

  /** @param {Point} a @param {Point} b @param {string} [typed] */
  measure(a, b, typed = '') {
    const text = 13 / this.scale, yaw = atan2(b[1] - a[1], b[0] - a[0]), upright = abs(normal(yaw)) > PI / 2 + 0.01 ? yaw + PI : yaw, away = 14 / this.scale;
    const [x, y] = [(a[0] + b[0]) / 2 - away * sin(upright), (a[1] + b[1]) / 2 + away * cos(upright)];
    return svg('text', { class: 'measure', 'font-size': text, transform: `translate(${x} ${-y}) rotate(${(-upright * 180) / PI})`, y: text / 3 }, numbers(typed ? `${typed} m` : `${distance(a, b).toFixed(2)} m`));
  }
}

/** @param {Point[]} polygon @returns {number} m² */
export const areaOf = (polygon) => abs(polygon.reduce((sum, [x, y], i) => {
  const [u, v] = polygon[(i + 1) % polygon.length];
  return sum + x * v - u * y;
}, 0)) / 2;
