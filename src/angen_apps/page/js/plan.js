/** The plan of one floor, as SVG: a tap finds the nearest mark, and the keyboard reaches each. */
import { by, el, isLow, isNarrow, svg, words } from './dom.js';
import { fieldShape, yawOf } from './fields.js';
import { roomText } from './labels.js';
import { state, t } from './lang.js';
import { MOVES, scanPoints } from './overlays.js';
import { LETTER, Taken, around, fitted, nameOf } from './places.js';
import { bytes } from './shapes.js';
import { furniture, signOf } from './symbols.js';
import { Zoom } from './zoom.js';

const SHOWN = new Set(['lamp', 'door', 'window', 'elevator', 'stove', 'heater', 'appliance', 'cabinet']);
const WIDER = 1.5; // a room's name over the room, at most
const LEAST = 11, FACE = 6, DOT = 4; // px of a text's height, of the radius of a device's mark, of a sensor's
const REACH = 22, LATER = 14; // px around a tap: half of a target; by which sensors, small and on doors, come after others
const MARGIN = 0.6; // m around all that is shown
const BODY = 0.22, SIGN = 0.17, SPOT = 0.1; // m: half of the mark of a person, a device, a sensor
const TOP = 1.8, HUNG = 1.3, PANE = 0.07, LEAST_PART = 0.03; // m over the floor to which furniture is drawn, over which it hangs; beside a pane; m²
const MESH = 3; // type of a shape
const LEAVES = ['door', 'window'], LEAST_LEAF = 0.2; // m
const EMPTY = 5; // m: half of the ground that is drawn where there are no models
const PUSHED = 0.05; // m from where a thing is drawn
const HEIGHT = 0.9; // m of walls over their floor that are drawn where the home has no rooms

export class Plan {
  /** @param {import('./home.js').Home} home @param {(hit: any) => void} onPick */
  constructor(home, onPick) {
    this.home = home;
    this.onPick = onPick;
    this.storey = /** @type {number | null} */ (null);
    this.hidden = true;
    this.withFields = false;
    this.stale = true;
    this.goal = /** @type {number[] | null} */ (null);
    /** @type {any} the mark of a thing that one carries */
    this.carried = null;
    this.text = 0; // m of height
    /** @type {number[][]} */
    this.names = []; // boxes of the rooms' names
    /** @type {boolean | undefined} as one has set it */
    this.legendOpen = undefined;
    this.element = by('plan');
    this.zoom = new Zoom(this.element, () => this.root?.setAttribute('viewBox', this.zoom.box.join(' ')), () => { this.stale = true; this.draw(); });
    /** @type {Map<string, any>} */
    this.items = new Map();
    /** @type {Map<any, number[][]>} by entity: where its mark is, from one end to the other */
    this.lines = new Map();
    /** @type {Map<number, number[]>} x y of things as they are drawn, by link */
    this.drawnAt = new Map();
    for (const topic of ['scene', 'home', 'entities']) home.on(topic, () => { this.stale = true; this.draw(); });
    home.on('rows', () => this.update());
    home.on('poses', () => this.later());
    home.on('scan', (scan) => this.showScan(scan));
    new ResizeObserver(() => { this.stale = true; this.draw(); }).observe(this.element);
  }

  /** @param {number | null} storey */
  setStorey(storey) {
    if (storey !== this.storey) this.zoom.times = 1;
    this.storey = storey;
    this.stale = true;
    this.draw();
  }

  /** @returns {number} px of a meter */
  get scale() { return this.zoom.scale; }

  number() {
    return this.storey ?? this.home.storeys[0]?.number ?? 0;
  }

  later() {
    if (this.pending || this.hidden) return;
    this.pending = setTimeout(() => { this.pending = 0; this.update(); }, 100);
  }

  /** Drawn again when it is visible and something was added or removed. */
  draw() {
    if (this.hidden || !this.stale || !this.home.scene) return;
    this.stale = false;
    this.items.clear();
    this.lines.clear();
    this.drawnAt.clear();
    const { home } = this, number = this.number();
    const rooms = home.rooms.filter((room) => room.storey === number), shown = home.entities.filter((e) => this.isShown(e, number));
    const walls = rooms.length ? [] : this.walls(number);
    const shafts = this.shafts(number);
    const places = [...rooms.flatMap((room) => room.polygon), ...shafts.flatMap((shape) => this.corners(shape)), ...walls.map((/** @type {any} */ shape) => this.placeOf(shape)),
      ...shown.filter((e) => !rooms.length || !home.isMover(e)).map((e) => Array.from(home.place(e)))];
    if (!places.length) places.push([-EMPTY, -EMPTY], [EMPTY, EMPTY]);
    const xs = places.map(([x]) => x), ys = places.map(([, y]) => y), margin = rooms.length ? MARGIN : 2 * MARGIN; // leaves open
    const left = Math.min(...xs) - margin, top = -Math.max(...ys) - margin;
    const width = Math.max(...xs) + margin - left, height = -Math.min(...ys) + margin - top;
    this.zoom.within([left, top, width, height]);
    this.text = Math.max(Math.min(0.42, this.zoom.box[2] / 30), LEAST / this.scale);
    this.root = svg('svg', { viewBox: this.zoom.box.join(' '), role: 'group', 'aria-label': t('Plan of floor {number}', { number }) });
    this.root.addEventListener('click', (/** @type {MouseEvent} */ e) => this.onPick(this.hit(e.clientX, e.clientY)));
    const path = (/** @type {number[][]} */ p) => `M${p.map(([x, y]) => `${x.toFixed(3)} ${(-y).toFixed(3)}`).join('L')}Z`;
    for (const room of rooms) {
      const shape = svg('path', { class: 'room-shape', d: [room.polygon, ...(room.holes ?? [])].map(path).join(''), 'fill-rule': 'evenodd', 'stroke-width': 0.1 });
      this.items.set(`room/${room.name}`, shape);
      this.root.append(shape);
    }
    this.root.append(svg('g', {}, ...walls.map((/** @type {any} */ shape) => this.rect(shape, 'walls'))), ...shafts.map((shape) => this.rect(shape, 'shaft')), this.furniture(number));
    this.fields = svg('g');
    this.scan = svg('g', { class: 'scan' });
    this.root.append(this.fields);
    for (const door of home.described?.doors ?? []) {
      const [x, y, z, yaw] = door.pose;
      if (home.storeyAt(z + 0.2) !== number) continue;
      const [c, s] = [Math.cos(yaw), Math.sin(yaw)], half = door.width / 2;
      const along = (/** @type {number} */ away) => `M${x - half * c - away * s} ${-(y - half * s + away * c)}L${x + half * c - away * s} ${-(y + half * s + away * c)}`;
      this.root.append(svg('path', { class: 'gap', d: along(0) }));
      if (door.kind === 'window') this.root.append(svg('path', { class: 'pane', d: [-PANE, 0, PANE].map(along).join('') }));
    }
    this.name(rooms, shown);
    for (const e of [...shown].sort((a, b) => Number(home.isMover(a)) - Number(home.isMover(b)))) this.addItem(e); // people over lamps
    this.root.append(this.scan);
    this.element.replaceChildren(this.root, this.legend(shown));
    this.showGoal(this.goal);
    if (this.carried) this.root.append(this.carried);
    this.update();
  }

  /**
   * Names of rooms, where they cover little.
   * @param {any[]} rooms @param {any[]} shown
   */
  name(rooms, shown) {
    const { home, text } = this;
    const taken = new Taken();
    for (const e of shown) {
      const half = this.half(e);
      if (!home.isMover(e)) taken.boxes.push([home.place(e)[0], home.place(e)[1], half, half]);
    }
    const written = new Taken();
    for (const room of rooms) {
      const name = fitted(roomText(room), room.polygon, (LETTER * text) / WIDER), wide = (LETTER / 2) * text * name.length, [x, y] = nameOf(room.polygon, wide, text / 2, taken);
      if (!written.put([x, y, wide, text / 2], [[0, 0]])) continue; // the room is smaller than its name
      this.root.append(svg('text', { x, y: -y + 0.35 * text, 'font-size': text }, name));
    }
    this.names = written.boxes;
  }

  /** @param {any} shape a box of the scene @returns {number[]} x y yaw of its middle */
  placeOf(shape) {
    const link = this.home.pose(shape.link), yaw = 2 * Math.atan2(link[5], link[6]), [c, s] = [Math.cos(yaw), Math.sin(yaw)];
    return [link[0] + c * shape.pose[0] - s * shape.pose[1], link[1] + s * shape.pose[0] + c * shape.pose[1], yaw + 2 * Math.atan2(shape.pose[5], shape.pose[6])];
  }

  /** @param {any} shape a box of the scene @param {string} cls */
  rect(shape, cls) {
    const [x, y, yaw] = this.placeOf(shape), [width, depth] = shape.size;
    return svg('rect', { class: cls, x: -width / 2, y: -depth / 2, width, height: depth, rx: 0.04, transform: `translate(${x} ${-y}) rotate(${(-yaw * 180) / Math.PI})` });
  }

  /**
   * The extent of a floor without rooms.
   * @param {number} number @returns {any[]} shapes
   */
  walls(number) {
    const { scene } = this.home;
    return scene.shapes.filter((/** @type {any} */ shape) => {
      const link = scene.links[shape.link], z = link.pose[2] + shape.pose[2];
      return shape.type === 0 && !link.moves && shape.size[2] > HEIGHT && this.home.storeyAt(z) === number;
    });
  }

  /** @param {any} shape a box of the scene @returns {number[][]} its corners from above */
  corners(shape) {
    const [x, y, yaw] = this.placeOf(shape), [c, s] = [Math.cos(yaw) / 2, Math.sin(yaw) / 2], [width, depth] = shape.size;
    return [[1, 1], [1, -1], [-1, 1], [-1, -1]].map(([i, j]) => [x + i * c * width - j * s * depth, y + i * s * width + j * c * depth]);
  }

  /**
   * The largest plate of each elevator that stops on a floor: that of its cabin.
   * @param {number} number @returns {any[]} shapes
   */
  shafts(number) {
    const { home } = this, area = (/** @type {any} */ shape) => shape.size[0] * shape.size[1];
    return home.entities.filter((e) => e.kind === 'elevator' && this.isShown(e, number)).flatMap((e) => {
      const links = home.linksOf(e.model), boxes = home.scene.shapes.filter((/** @type {any} */ s) => s.type === 0 && links.includes(s.link));
      return boxes.sort((/** @type {any} */ a, /** @type {any} */ b) => area(b) - area(a)).slice(0, 1);
    });
  }

  /** @param {number} number */
  furniture(number) {
    const { home } = this, group = svg('g');
    for (const thing of home.described?.things ?? []) {
      if (home.storeyOf(thing.name, thing.pose[2] + 0.2) === number && thing.type !== 'window' && thing.type !== 'lamp') group.append(...this.thing(thing));
    }
    return group;
  }

  /**
   * The outline and the symbol of a thing, as angen plan draws it.
   * @param {any} thing @returns {any[]}
   */
  thing(thing) {
    const { home } = this, links = home.linksOf(thing.name), [tx, ty, turn] = this.placeOfThing(thing, links), [c, s] = [Math.cos(turn), Math.sin(turn)];
    const floor = home.storeys.find((one) => one.number === home.storeyOf(thing.name, thing.pose[2] + 0.2))?.elevation ?? 0;
    const low = (/** @type {any} */ part) => home.scene.links[part.link].pose[2] + part.pose[2] - part.size[2] / 2 - floor;
    const parts = home.scene.shapes.filter((/** @type {any} */ part) => links.includes(part.link)).map((/** @type {any} */ part) => this.boxOf(part)).filter((/** @type {any} */ part) => low(part) < TOP);
    if (!parts.some((/** @type {any} */ part) => part.size[0] * part.size[1] >= LEAST_PART)) return [];
    const own = parts.flatMap((/** @type {any} */ part) => this.corners(part)).map((/** @type {number[]} */ [x, y]) => [(x - tx) * c + (y - ty) * s, (y - ty) * c - (x - tx) * s]);
    const [xs, ys] = [own.map((/** @type {number[]} */ [x]) => x), own.map((/** @type {number[]} */ [, y]) => y)];
    const [left, right, back, front] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
    const at = (/** @type {number} */ u, /** @type {number} */ v) => {
      const [x, y] = [(left + right) / 2 + (u * (right - left)) / 2, (back + front) / 2 + (v * (front - back)) / 2];
      return [tx + x * c - y * s, ty + x * s + y * c];
    };
    return furniture(home.symbols[thing.type], at, parts.length === 1 && Boolean(parts[0].type), parts.every((/** @type {any} */ part) => low(part) > HUNG));
  }

  /**
   * Where a thing is now, which may be pushed or put elsewhere.
   * @param {any} thing @param {number[]} links @returns {number[]} x y yaw
   */
  placeOfThing(thing, links) {
    const [x, y, , , , qz, qw] = thing.pose, yaw = 2 * Math.atan2(qz, qw);
    if (!links.length) return [x, y, yaw];
    const was = this.home.scene.links[links[0]].pose, now = this.home.pose(links[0]), turn = yawOf(now) - yawOf(was), [c, s] = [Math.cos(turn), Math.sin(turn)];
    this.drawnAt.set(links[0], [now[0], now[1]]);
    return [now[0] + c * (x - was[0]) - s * (y - was[1]), now[1] + s * (x - was[0]) + c * (y - was[1]), yaw + turn];
  }

  /** @param {any} shape @returns {any} the box around a mesh; another shape as it is */
  boxOf(shape) {
    if (shape.type < MESH) return shape;
    const mesh = this.home.scene.meshes[shape.mesh];
    mesh.box ??= extents(new Float32Array(bytes(mesh.vertices)));
    const [x, y, z] = mesh.box.map((/** @type {number[]} */ [least, most]) => (least + most) / 2), [px, py, pz, ...turn] = shape.pose;
    const yaw = 2 * Math.atan2(turn[2], turn[3]), [c, s] = [Math.cos(yaw), Math.sin(yaw)];
    return { type: 0, link: shape.link, size: mesh.box.map((/** @type {number[]} */ [least, most]) => most - least), pose: [px + c * x - s * y, py + s * x + c * y, pz + z, ...turn] };
  }

  /** @param {any} e @param {number} number */
  isShown(e, number) {
    const { home } = this, moves = home.isMover(e), kind = home.kinds[e.kind], sensor = kind?.role === 'sensor';
    const alarms = kind?.fields.some((/** @type {any} */ f) => f.alarm);
    if (!moves && !SHOWN.has(e.kind) && !(sensor && alarms)) return false;
    if (sensor && home.scene.links[home.linksOf(e.model)[0]]?.moves) return false;
    const lift = e.kind === 'elevator' ? home.described?.elevators?.find((/** @type {any} */ one) => one.name === e.name) : null;
    if (lift) return lift.landings.some((/** @type {any} */ at) => at.storey === number);
    return moves || home.storeyAt(home.place(e)[2]) === number;
  }

  /**
   * What the marks of a floor mean.
   * @param {any[]} shown @returns {any}
   */
  legend(shown) {
    const { home } = this, sensor = (/** @type {any} */ e) => home.kinds[e.kind]?.role === 'sensor';
    const kinds = new Map(shown.map((e) => [home.isRobot(e) ? 'robot' : sensor(e) ? 'sensor' : e.kind, e]));
    const rows = [...kinds].sort((a, b) => Number(sensor(a[1])) - Number(sensor(b[1]))).map(([name, e]) => {
      const sign = svg('g', { class: classOf(home, e) }, ...mark(home, e, 7));
      sign.querySelector('.leaf')?.setAttribute('d', 'M-8 0H8');
      return el('span', {}, svg('svg', { viewBox: '-11 -9 22 18', width: 22, height: 18, 'aria-hidden': true }, sign), words(name));
    });
    /** @type {any} */
    const legend = el('details', { class: 'legend', open: this.legendOpen ?? !(isNarrow() || isLow()) }, el('summary', { onclick: () => { this.legendOpen = !legend.open; } }, t('Legend')), el('div', {}, ...rows));
    return legend;
  }

  /** @param {any} e @returns {number} m: half of the width of its mark */
  half(e) {
    const sensor = this.home.kinds[e.kind]?.role === 'sensor';
    return Math.max((sensor ? DOT : FACE) / this.scale, this.home.isMover(e) ? BODY : sensor ? SPOT : SIGN);
  }

  /** @param {any} e */
  addItem(e) {
    const { home } = this, size = this.half(e);
    const item = svg('g', { class: classOf(home, e), tabindex: 0, role: 'button' }, ...mark(home, e, size),
      home.isMover(e) ? svg('text', { class: 'who', 'font-size': this.text * 0.8 }, e.name) : null);
    item.addEventListener('keydown', (/** @type {KeyboardEvent} */ event) => {
      if (event.key !== 'Enter' && event.key !== ' ') return;
      event.preventDefault();
      event.stopPropagation();
      this.onPick({ entity: e });
    });
    this.items.set(`${e.kind}/${e.name}`, item);
    this.root.append(item);
  }

  update() {
    if (this.hidden || !this.root || this.stale) return;
    const { home } = this, number = this.number(), taken = new Taken(), letter = 0.4 * this.text, high = 1.2 * letter; // half of a line of names
    if ([...this.drawnAt].some(([link, [x, y]]) => Math.hypot(home.pose(link)[0] - x, home.pose(link)[1] - y) > PUSHED)) {
      this.stale = true;
      this.draw();
      return;
    }
    taken.boxes.push(...this.names);
    for (const [e] of this.lines) {
      const [x, y, z] = Array.from(home.place(e)), half = this.half(e);
      if (home.storeyAt(z + 0.2) === number) taken.boxes.push([x, y, half, half]);
    }
    for (const e of home.entities) {
      const item = this.items.get(`${e.kind}/${e.name}`);
      if (!item) continue;
      const row = home.row(e), pose = home.place(e);
      const moves = home.isMover(e);
      if (moves) item.style.display = home.storeyAt(pose[2] + 0.2) === number ? '' : 'none';
      const leaves = LEAVES.includes(e.kind) ? this.leaves(e) : null;
      this.lines.set(e, leaves ? [...leaves.now, ...leaves.shut] : item.style.display ? [] : [[pose[0], pose[1], pose[0], pose[1]]]);
      if (leaves) item.querySelector('.leaf').setAttribute('d', leaves.now.map(([x, y, u, v]) => `M${x} ${-y}L${u} ${-v}`).join(''));
      else item.setAttribute('transform', `translate(${pose[0]} ${-pose[1]})`);
      if (moves) {
        item.querySelector('path').setAttribute('transform', `rotate(${(-yawOf(pose) * 180) / Math.PI})`);
        const wide = letter * LETTER * e.name.length, shifts = around(this.half(e), wide, high);
        const [dx, dy] = (item.style.display ? null : taken.put([pose[0], pose[1], wide, high], shifts)) ?? shifts[0];
        item.querySelector('text').setAttribute('transform', `translate(${dx} ${0.7 * letter - dy})`);
      }
      item.classList.toggle('on', home.isOn(row));
      item.classList.toggle('alarm', Boolean(row?.alarm));
      item.setAttribute('aria-label', `${words(e.kind)} ${e.name}: ${state(row?.text ?? '', home.kinds[e.kind])}`);
    }
    const lit = new Set(home.entities.filter((e) => e.kind === 'lamp' && home.isOn(home.row(e))).map((e) => home.roomsOf(e)[0]?.name));
    for (const room of home.rooms) this.items.get(`room/${room.name}`)?.classList.toggle('lit', lit.has(room.name));
    this.showFields(number);
  }

  /**
   * The lines of a door's or window's leaves, and of the opening.
   * @param {any} e
   * @returns {{now: number[][], shut: number[][]}} x y x y
   */
  leaves(e) {
    const { home } = this, described = home.described?.doors?.find((/** @type {any} */ d) => d.name === e.name && d.kind === e.kind);
    const across = (/** @type {number} */ x, /** @type {number} */ y, /** @type {number} */ yaw, /** @type {number} */ half) => [
      x - half * Math.cos(yaw), y - half * Math.sin(yaw), x + half * Math.cos(yaw), y + half * Math.sin(yaw)];
    const shut = described ? [across(described.pose[0], described.pose[1], described.pose[3], described.width / 2)] : [];
    const volume = (/** @type {any} */ s) => s.size[0] * s.size[1] * s.size[2];
    const now = home.linksOf(e.model).filter((link) => home.scene.links[link].moves).flatMap((link) => {
      const box = home.scene.shapes.filter((/** @type {any} */ s) => s.link === link && s.type === 0).sort((/** @type {any} */ a, /** @type {any} */ b) => volume(b) - volume(a))[0];
      if (!box || Math.max(box.size[0], box.size[1]) < LEAST_LEAF) return [];
      const p = home.pose(link), turn = 2 * Math.atan2(p[5], p[6]), [c, s] = [Math.cos(turn), Math.sin(turn)], upright = box.size[0] < box.size[1];
      return [across(p[0] + c * box.pose[0] - s * box.pose[1], p[1] + s * box.pose[0] + c * box.pose[1], turn + (upright ? Math.PI / 2 : 0), (upright ? box.size[1] : box.size[0]) / 2)];
    });
    return { now: now.length ? now : shut.length ? shut : [across(e.pose[0], e.pose[1], 0, 0.4)], shut };
  }

  /** @param {number} number */
  showFields(number) {
    const { home } = this, fires = (/** @type {any} */ s) => Boolean(home.rows.get(`${s.kind}/${s.name}`)?.alarm);
    const shown = home.scene.sensors.filter((/** @type {any} */ s) => s.rays && (this.withFields || fires(s)) && !home.scene.links[s.link].moves);
    const state = shown.map((/** @type {any} */ s) => `${s.name} ${fires(s)}`).join();
    if (state === this.fieldState && this.fieldsOf === this.fields) return; // a flash is not started again
    this.fieldState = state;
    this.fieldsOf = this.fields;
    this.fields.replaceChildren();
    for (const sensor of shown) {
      const points = fieldShape(home, sensor), cls = !fires(sensor) ? '' : MOVES.has(sensor.kind) ? ' motion' : ' alarm';
      if (home.storeyAt(points[0][2] + 0.2) !== number) continue;
      this.fields.append(svg('polygon', { class: `field${cls}`, points: points.map(([x, y]) => `${x.toFixed(2)},${(-y).toFixed(2)}`).join(' ') }));
    }
  }

  /** @param {{name: string, content: ArrayBuffer}} scan */
  showScan({ name, content }) {
    if (this.hidden || !this.scan) return;
    const points = scanPoints(this.home, name, content) ?? [];
    this.scan.replaceChildren(...points.filter((_, i) => i % 2 === 0).map(([x, y]) => svg('circle', { r: 0.05, cx: x.toFixed(2), cy: (-y).toFixed(2) })));
  }

  /**
   * What a tap means: the nearest mark in its reach, else the floor.
   * @param {number} x @param {number} y px
   * @returns {{entity?: any, model?: string, cls?: string, point: number[]}}
   */
  hit(x, y) {
    const point = this.ground(x, y), { kinds } = this.home;
    let entity = null, least = Infinity;
    for (const [e, lines] of this.lines) {
      const far = Math.min(...lines.map((line) => this.scale * away(point, line))), cost = far + (kinds[e.kind]?.role === 'sensor' ? LATER : 0);
      if (far <= REACH && cost < least) { least = cost; entity = e; }
    }
    return entity ? { entity, model: entity.model, point } : { point, cls: 'floor' };
  }

  /** @param {number} x @param {number} y px @returns {number[]} the place of the floor there */
  ground(x, y) {
    const at = new DOMPoint(x, y).matrixTransform(this.root.getScreenCTM().inverse());
    const storey = this.home.storeys.find((s) => s.number === this.number());
    return [at.x, -at.y, storey?.elevation ?? 0];
  }

  /** @param {number[] | null} pose x y z yaw */
  showGoal(pose) {
    this.goal = pose;
    this.arrow?.remove();
    if (!pose || !this.root || this.home.storeyAt(pose[2]) !== this.number()) return;
    this.arrow = svg('path', { class: 'goal', d: 'M0.75 0L0.35 -0.32V-0.1H-0.1V0.1H0.35V0.32Z', transform: `translate(${pose[0]} ${-pose[1]}) rotate(${(-pose[3] * 180) / Math.PI})` });
    this.root.append(this.arrow);
  }
}

/** @param {Float32Array} corners x y z of each @returns {number[][]} the least and the most x, y and z */
function extents(corners) {
  const found = [[Infinity, -Infinity], [Infinity, -Infinity], [Infinity, -Infinity]];
  corners.forEach((value, i) => { found[i % 3] = [Math.min(found[i % 3][0], value), Math.max(found[i % 3][1], value)]; });
  return found;
}

/** @param {number[]} point @param {number[]} line x y x y @returns {number} m between them */
function away([x, y], [u, v, s, t]) {
  const [dx, dy] = [s - u, t - v], part = Math.min(1, Math.max(0, ((x - u) * dx + (y - v) * dy) / (dx * dx + dy * dy || 1)));
  return Math.hypot(u + part * dx - x, v + part * dy - y);
}

/** @param {import('./home.js').Home} home @param {any} e @returns {string} */
const classOf = (home, e) => `item ${e.kind}${home.isRobot(e) ? ' robot' : ''}${home.kinds[e.kind]?.role === 'sensor' ? ' sensor' : ''}${MOVES.has(e.kind) ? ' moves' : ''}`;

/** @param {import('./home.js').Home} home @param {any} e @param {number} size half of its width @returns {any[]} */
const mark = (home, e, size) => (LEAVES.includes(e.kind) ? [svg('path', { class: 'leaf' })] : signOf(e.kind, size, home.kinds[e.kind]?.role === 'sensor', home.isMover(e)));
