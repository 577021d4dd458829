/** The plan of one floor, as SVG: large targets, and each item reached by the keyboard. */
import { by, svg } from './dom.js';
import { fieldShape, yawOf } from './fields.js';
import { roomText } from './labels.js';
import { MOVES, scanPoints } from './overlays.js';
import { Taken, around, nameOf } from './places.js';

const SHOWN = new Set(['lamp', 'door', 'window', 'elevator', 'stove', 'heater', 'appliance', 'cabinet']);
const LETTER = 0.66; // of a text's height: the width of a letter
const WIDER = 1.5, LETTERS = 8; // limits of a room's name: its width over that of the room, its letters
const LEAST = 11, FACE = 4, TOUCH = 12; // px of a text's height, of the radius of a mark and of its target
const MARGIN = 0.6; // m around all that is shown
const BODY = 0.22; // m: half of a person's mark
const EMPTY = 5; // m: half of the ground that is drawn where there are no models
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
    this.scale = 1; // px of a meter
    this.text = 0; // m of height
    /** @type {number[][]} */
    this.names = []; // boxes of the rooms' names
    this.element = by('plan');
    /** @type {Map<string, any>} */
    this.items = new Map();
    for (const topic of ['scene', 'home', 'entities']) home.on(topic, () => { this.stale = true; this.draw(); });
    home.on('rows', () => this.update());
    home.on('poses', () => this.later());
    home.on('scan', (scan) => this.showScan(scan));
    new ResizeObserver(() => { this.stale = true; this.draw(); }).observe(this.element);
  }

  /** @param {number | null} storey */
  setStorey(storey) {
    this.storey = storey;
    this.stale = true;
    this.draw();
  }

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
    this.scale = Math.min(this.element.clientWidth / width, this.element.clientHeight / height) || 1;
    this.text = Math.max(Math.min(0.42, width / 30), LEAST / this.scale);
    this.root = svg('svg', { viewBox: `${left} ${top} ${width} ${height}`, role: 'group', 'aria-label': `Plan of floor ${number}` });
    this.root.addEventListener('click', (/** @type {MouseEvent} */ e) => this.click(e));
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
      const [dx, dy] = [(door.width / 2) * Math.cos(yaw), (door.width / 2) * Math.sin(yaw)];
      this.root.append(svg('line', { class: 'gap', x1: x - dx, y1: -(y - dy), x2: x + dx, y2: -(y + dy) }));
    }
    this.name(rooms, shown);
    for (const e of [...shown].sort((a, b) => Number(home.isMover(a)) - Number(home.isMover(b)))) this.addItem(e); // people over lamps
    this.root.append(this.scan);
    this.element.replaceChildren(this.root);
    this.showGoal(this.goal);
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
      if (!home.isMover(e)) taken.boxes.push([home.place(e)[0], home.place(e)[1], 0.2, 0.2]);
    }
    const written = new Taken();
    for (const room of rooms) {
      const xs = room.polygon.map((/** @type {number[]} */ [x]) => x), most = (WIDER * (Math.max(...xs) - Math.min(...xs))) / (LETTER * text);
      const name = shortened(roomText(room), Math.max(LETTERS, Math.floor(most))), wide = (LETTER / 2) * text * name.length, [x, y] = nameOf(room.polygon, wide, text / 2, taken);
      if (!written.put([x, y, wide, text / 2], [[0, 0]])) continue; // the room is smaller than its name
      this.root.append(svg('text', { x, y: -y + 0.35 * text, 'font-size': text }, name));
    }
    this.names = written.boxes;
  }

  /** @param {any} shape a box of the scene @returns {number[]} x y yaw of its middle */
  placeOf(shape) {
    const link = this.home.scene.links[shape.link].pose, yaw = 2 * Math.atan2(link[5], link[6]), [c, s] = [Math.cos(yaw), Math.sin(yaw)];
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
      if (home.storeyAt(thing.pose[2] + 0.2) !== number || thing.type === 'window' || thing.type === 'lamp') continue;
      const links = home.linksOf(thing.name);
      for (const shape of home.scene.shapes) {
        if (shape.type === 0 && links.includes(shape.link) && shape.size[0] * shape.size[1] >= 0.03) group.append(this.rect(shape, 'furniture'));
      }
    }
    return group;
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

  /** @param {any} e */
  addItem(e) {
    const { home } = this, moves = home.isMover(e), sensor = home.kinds[e.kind]?.role === 'sensor';
    const size = Math.max(FACE / this.scale, moves ? BODY : e.kind === 'lamp' ? 0.2 : sensor ? 0.1 : 0.14);
    const item = svg('g', { class: `item ${e.kind}${home.isRobot(e) ? ' robot' : ''}${MOVES.has(e.kind) ? ' moves' : ''}`, tabindex: 0, role: 'button' },
      e.kind === 'door' ? svg('line', { class: 'leaf' }) : null,
      svg('circle', { class: 'face', r: size, visibility: e.kind === 'door' ? 'hidden' : null }),
      moves ? svg('path', { class: 'face', d: `M${size * 1.5} 0L${size * 0.7} ${-size * 0.5}V${size * 0.5}Z` }) : null,
      moves ? svg('text', { class: 'who', 'font-size': this.text * 0.8 }, e.name) : null,
      svg('circle', { class: 'touch', r: Math.max(0.4, TOUCH / this.scale) }));
    const pick = (/** @type {Event} */ event, point = /** @type {number[] | undefined} */ (undefined)) => { event.stopPropagation(); this.onPick({ entity: e, point }); };
    item.addEventListener('click', (/** @type {MouseEvent} */ event) => pick(event, this.ground(event.clientX, event.clientY)));
    item.addEventListener('keydown', (/** @type {KeyboardEvent} */ event) => {
      if (event.key !== 'Enter' && event.key !== ' ') return;
      event.preventDefault();
      pick(event);
    });
    this.items.set(`${e.kind}/${e.name}`, item);
    this.root.append(item);
  }

  update() {
    if (this.hidden || !this.root || this.stale) return;
    const { home } = this, number = this.number(), taken = new Taken(), high = 0.4 * this.text;
    taken.boxes.push(...this.names);
    for (const e of home.movers) {
      const [x, y, z] = Array.from(home.place(e));
      if (home.storeyAt(z + 0.2) === number) taken.boxes.push([x, y, BODY, BODY]);
    }
    for (const e of home.entities) {
      const item = this.items.get(`${e.kind}/${e.name}`);
      if (!item) continue;
      const row = home.row(e), pose = home.place(e);
      const moves = home.isMover(e);
      if (moves) item.style.display = home.storeyAt(pose[2] + 0.2) === number ? '' : 'none';
      const yaw = yawOf(pose);
      const door = e.kind === 'door' ? this.door(e) : null;
      item.setAttribute('transform', door ? `translate(${door.x} ${-door.y})` : `translate(${pose[0]} ${-pose[1]})`);
      if (moves) {
        item.querySelector('path').setAttribute('transform', `rotate(${(-yaw * 180) / Math.PI})`);
        const wide = high * LETTER * e.name.length, shifts = around(BODY, wide, high);
        const [dx, dy] = (item.style.display ? null : taken.put([pose[0], pose[1], wide, high], shifts)) ?? shifts[0];
        item.querySelector('text').setAttribute('transform', `translate(${dx} ${0.7 * high - dy})`);
      }
      if (door) {
        const leaf = item.querySelector('.leaf');
        for (const [name, value] of Object.entries({ x1: door.ends[0], y1: -door.ends[1], x2: door.ends[2], y2: -door.ends[3] })) leaf.setAttribute(name, value);
      }
      item.classList.toggle('on', home.isOn(row));
      item.classList.toggle('alarm', Boolean(row?.alarm));
      item.setAttribute('aria-label', `${e.kind} ${e.name}: ${row?.text ?? ''}`);
    }
    const lit = new Set(home.entities.filter((e) => e.kind === 'lamp' && home.isOn(home.row(e))).map((e) => home.roomsOf(e)[0]?.name));
    for (const room of home.rooms) this.items.get(`room/${room.name}`)?.classList.toggle('lit', lit.has(room.name));
    this.showFields(number);
  }

  /**
   * A door's middle, and the ends of its leaf around it.
   * @param {any} e
   */
  door(e) {
    const { home } = this, described = home.described?.doors?.find((/** @type {any} */ d) => d.name === e.name && d.kind === e.kind);
    const links = home.linksOf(e.model).filter((link) => home.scene.links[link].moves);
    if (!described || !links.length) {
      const [x, y] = Array.from(e.pose);
      return { x, y, ends: [-0.4, 0, 0.4, 0] };
    }
    const [x, y, , yaw] = described.pose, half = described.width / 2;
    const box = home.scene.shapes.filter((/** @type {any} */ s) => links.includes(s.link) && s.type === 0)
      .sort((/** @type {any} */ a, /** @type {any} */ b) => b.size[0] * b.size[1] * b.size[2] - a.size[0] * a.size[1] * a.size[2])[0];
    if (!box) return { x, y, ends: [-half * Math.cos(yaw), -half * Math.sin(yaw), half * Math.cos(yaw), half * Math.sin(yaw)] };
    const p = home.pose(box.link), turn = 2 * Math.atan2(p[5], p[6]), [c, s] = [Math.cos(turn), Math.sin(turn)];
    const along = box.size[0] > box.size[1] ? [box.size[0] / 2, 0] : [0, box.size[1] / 2];
    const mx = p[0] + c * box.pose[0] - s * box.pose[1] - x, my = p[1] + s * box.pose[0] + c * box.pose[1] - y;
    const [dx, dy] = [c * along[0] - s * along[1], s * along[0] + c * along[1]];
    return { x, y, ends: [mx - dx, my - dy, mx + dx, my + dy] };
  }

  /** @param {number} number */
  showFields(number) {
    const { home } = this, fires = (/** @type {any} */ s) => Boolean(home.rows.get(`${s.kind}/${s.name}`)?.alarm);
    const shown = home.scene.sensors.filter((/** @type {any} */ s) => (this.withFields || fires(s)) && !home.scene.links[s.link].moves);
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

  /** @param {MouseEvent} e */
  click(e) {
    this.onPick({ point: this.ground(e.clientX, e.clientY), cls: 'floor' });
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

/** @param {string} text @param {number} most letters */
const shortened = (text, most) => (text.length > most ? `${text.slice(0, most - 1)}…` : text);
