/** What pointers, keys and tools do on the sheet on which a home is drawn. */
import { ARROWS, svg } from './dom.js';
import { DOORWAY, GRID, STEP, along, directionOf, distance, gridded, itemOf, keysOf, lengthOf, liftOf, moved, normal, onWall, openingOf, placeOn, placesOf, roomWalls, snapped, stretched, turnedDoor, wallAt, wallOf } from './drawing.js';
import { t } from './lang.js';
import { BODY, MOUSE, SIGN, SPOT, Sheet } from './sheet.js';

/** @typedef {import('./drawing.js').Item} Item @typedef {import('./drawing.js').Point} Point */

const CLICK = 5; // px that a pointer moves at most in a click
const HANDLE = 8; // px of a handle's radius
const HANGS = 0.5; // m to a wall on which a door is put
const BEHIND = 1.6; // m to the wall in which the doors of an elevator are
const STICKS = 0.45; // m to a wall to which furniture and sensors stick
const GAP = 0.02, OFF = 0.1, CORNER = 0.15; // m from a wall to furniture, to a sensor; by which furniture is drawn into a corner
const LEAST_WALL = 0.05; // m
const { PI, cos, sin, hypot, min, max, abs, atan2 } = Math;

export class Board extends Sheet {
  /** @param {import('./edit.js').Editor} editor */
  constructor(editor) {
    super(editor);
    /** @type {any} what a press has begun */
    this.press = null;
    /** @type {{at: Point, key: string, does: string}[]} */
    this.handles = [];
    /** @type {any} */
    this.tool = { name: 'select' };
    /** @type {Point} */
    this.at = [0, 0]; // the place of the pointer
    this.inside = false;
    /** @type {Map<number, number[]>} x y px by pointer */
    this.pointers = new Map();
    /** @type {number | undefined} */
    this.pending = undefined;
    const on = (/** @type {string} */ name, /** @type {(e: any) => void} */ does) => this.element.addEventListener(name, does, { passive: false });
    on('pointerdown', (e) => this.down(e));
    on('pointermove', (e) => this.move(e));
    on('pointerup', (e) => this.up(e));
    on('pointercancel', (e) => this.cancel(e));
    on('pointerleave', () => { this.inside = false; if (this.tool.name !== 'select') this.draw(); });
    on('wheel', (e) => { e.preventDefault(); this.zoom(Math.exp(-e.deltaY / 400), [e.clientX, e.clientY]); });
    on('contextmenu', (e) => e.preventDefault());
    on('dblclick', () => { if (this.tool.from) this.use(this.tool); });
    new ResizeObserver(() => this.draw()).observe(this.element);
  }

  // --- tools

  /** @param {any} tool select, wall, room, or put with what is put */
  use(tool) {
    this.tool = { ...tool, from: null, typed: '', turn: tool.turn ?? 0 };
    this.preview = null;
    this.press = null;
    this.editor.showTool();
    this.draw();
  }

  /**
   * What a tool would put at a place; null where it cannot be.
   * @param {Point} at @param {number | null} [yaw] of a sensor that is aimed
   * @returns {[string, Item] | null}
   */
  ghost(at, yaw = null) {
    const { storey } = this.editor, { list, of, turn } = this.tool, free = at.map(gridded);
    if (list === 'openings') {
      const on = wallAt(storey, at, HANGS);
      if (!on) return null;
      let made = openingOf(of, storey, on.wall, gridded(on.u), on.v >= 0);
      for (let i = 0; i < (Math.round(turn / (PI / 2)) & 3); i++) made = turnedDoor(made);
      return ['openings', onWall(made, on.wall, gridded(on.u))];
    }
    if (list === 'lifts') {
      if (this.editor.history.now.plan.storeys.length < 2) return null;
      const on = wallAt(storey, at, BEHIND), side = on && on.v < 0 ? -1 : 1;
      return ['lifts', on && !turn ? liftOf(this.editor.history.now, placeOn(on.wall, gridded(on.u), side * DOORWAY), directionOf(on.wall) - (side * PI) / 2) : liftOf(this.editor.history.now, free, turn)];
    }
    if (list === 'lamps') return ['lamps', { name: '', x: free[0], y: free[1], z: storey.elevation + this.editor.ceiling - 0.3, flux: 800 }];
    if (list === 'movers') return ['movers', { name: of, kind: of, x: free[0], y: free[1], yaw: normal(turn), ...(of === 'person' ? { habits: 'worker' } : {}) }];
    if (list === 'sensors') {
      const held = of.height ? this.beside(at, OFF, STICKS) : null, [x, y] = held ? held.at : free, way = yaw ?? (held ? held.yaw : 0) + turn;
      return ['sensors', { name: '', model: of.model, x, y, z: storey.elevation + (of.height || this.editor.ceiling - GAP), yaw: normal(way), pitch: of.pitch }];
    }
    const held = of.shape === 'flat' ? null : this.beside(at, of.depth / 2 + GAP, of.depth / 2 + STICKS, of.width / 2), [x, y] = held ? held.at : free;
    return ['pieces', { ...of, name: '', source: of.name, x, y, z: storey.elevation, yaw: normal((held ? held.yaw : 0) + turn) }];
  }

  /**
   * The place at a wall near another place, or in a corner, and the direction away from it.
   * @param {Point} at @param {number} off m from a wall's face @param {number} near m @param {number} [half] m: of furniture's width, which stands at the second wall of a corner
   * @returns {{at: Point, yaw: number} | null}
   */
  beside(at, off, near, half) {
    const free = at.map(gridded), faces = (this.editor.storey.walls ?? []).map((/** @type {Item} */ wall) => ({ wall, p: along(wall, at) }))
      .filter((/** @type {any} */ { wall, p: [u] }) => u > 0 && u < lengthOf(wall)).map((/** @type {any} */ { wall, p: [, v] }) => ({ wall, side: v < 0 ? -1 : 1, away: abs(v) - wall.thickness / 2 }))
      .sort((/** @type {any} */ a, /** @type {any} */ b) => a.away - b.away);
    const [first] = faces;
    if (!first || first.away > near) return null;
    const way = (/** @type {any} */ { wall, side }) => directionOf(wall) + (side * PI) / 2, yaw = way(first);
    const pushed = (/** @type {Point} */ place, /** @type {any} */ { wall, side }, /** @type {number} */ far) => placeOn(wall, along(wall, place)[0], side * (wall.thickness / 2 + far));
    const second = faces.find((/** @type {any} */ face) => abs(cos(way(face) - yaw)) < 0.5 && face.away < (half ? half + CORNER : near));
    const place = second ? pushed(pushed(free, first, off), second, half ? half + GAP : off) : pushed(free, first, off);
    return { at: place.map((value) => Math.round(value * 1e3) / 1e3), yaw: second && !half ? atan2(sin(yaw) + sin(way(second)), cos(yaw) + cos(way(second))) : yaw };
  }

  // --- pointers

  /** @param {PointerEvent} e */
  down(e) {
    if (this.editor.closed) return;
    this.element.focus({ preventScroll: true });
    this.element.setPointerCapture(e.pointerId);
    this.pointers.set(e.pointerId, [e.clientX, e.clientY]);
    this.fingers = e.pointerType === 'touch';
    this.at = this.ground(e.clientX, e.clientY);
    this.inside = true;
    if (this.pointers.size === 2) {
      this.preview = null;
      this.press = { does: 'pinch' };
      return;
    }
    if (this.pointers.size > 2) return;
    const start = { x: e.clientX, y: e.clientY, at: this.at, middle: this.middle, far: 0 };
    if (e.button === 1 || e.button === 2) this.press = { ...start, does: 'pan' };
    else if (this.tool.name === 'select') this.press = { ...start, ...this.grab(e) };
    else this.press = { ...start, does: 'tool', free: e.altKey };
    if (this.press.does === 'tool' && ['wall', 'room'].includes(this.tool.name) && !this.tool.from) {
      this.tool.from = snapped(this.editor.storey, this.at, this.reach);
      this.press.began = true;
    }
    this.draw();
  }

  /**
   * What a press on the sheet begins.
   * @param {{shiftKey: boolean, ctrlKey: boolean, metaKey: boolean}} e
   */
  grab(e) {
    const { editor } = this, handle = this.handles.find((one) => distance(one.at, this.at) <= max(this.reach, (HANDLE + 3) / this.scale));
    if (handle) return { does: handle.does, key: handle.key };
    const key = this.hit(this.at), more = e.shiftKey || e.ctrlKey || e.metaKey || editor.several;
    if (!key) return { does: this.fingers && !editor.several ? 'pan' : 'frame', more };
    if (more) {
      editor.select(editor.selection.includes(key) ? editor.selection.filter((one) => one !== key) : [...editor.selection, key]);
      return { does: 'none' };
    }
    if (!editor.selection.includes(key)) editor.select([key]);
    return { does: 'drag', key };
  }

  /** @param {PointerEvent} e */
  move(e) {
    if (this.editor.closed) return;
    const before = this.pointers.get(e.pointerId);
    if (before && this.press?.does === 'pinch') this.pinch(e);
    if (before) this.pointers.set(e.pointerId, [e.clientX, e.clientY]);
    if (this.press?.does === 'pinch') return;
    this.inside = true;
    this.at = this.ground(e.clientX, e.clientY);
    if (!this.press || !before) {
      if (this.tool.name !== 'select') this.later();
      return;
    }
    this.press.far = max(this.press.far, hypot(e.clientX - this.press.x, e.clientY - this.press.y));
    this.dragged(e);
    this.later();
  }

  /** @param {PointerEvent} e */
  dragged(e) {
    const { press, editor } = this;
    if (press.far <= CLICK && press.does !== 'pan') return;
    if (press.does === 'pan') this.middle = [press.middle[0] - (e.clientX - press.x) / this.scale, press.middle[1] + (e.clientY - press.y) / this.scale];
    if (press.does === 'drag') this.preview = this.carried(press);
    if (press.does === 'start' || press.does === 'end') {
      const wall = itemOf(editor.storey, press.key), fixed = wall[press.does === 'start' ? 'end' : 'start'];
      this.preview = stretched(editor.storey, press.key, press.does, snapped({ ...editor.storey, walls: editor.storey.walls.filter((/** @type {Item} */ one) => one !== wall) }, this.at, this.reach, fixed, LEAST_WALL));
    }
    if (press.does === 'turn') {
      const item = itemOf(editor.storey, press.key), way = atan2(this.at[1] - item.y, this.at[0] - item.x);
      this.preview = { change: { [press.key]: { ...item, yaw: normal(e.altKey ? way : Math.round(way / STEP) * STEP) } }, add: [] };
    }
  }

  /** @param {any} press of a drag @returns {any} the change of what is dragged */
  carried(press) {
    const { storey, selection } = this.editor, item = itemOf(storey, press.key);
    if (selection.length === 1 && press.key.startsWith('openings/')) { // from wall to wall
      const on = wallAt(storey, this.at, HANGS);
      return on ? { change: { [press.key]: onWall(item, on.wall, gridded(on.u)) }, add: [] } : this.preview;
    }
    let [dx, dy] = [this.at[0] - press.at[0], this.at[1] - press.at[1]].map(gridded);
    if (selection.length === 1 && press.key.startsWith('walls/')) { // across itself
      const yaw = directionOf(item), away = gridded(-dx * sin(yaw) + dy * cos(yaw));
      [dx, dy] = [-away * sin(yaw), away * cos(yaw)];
    }
    return moved(storey, selection, dx, dy);
  }

  /** @param {PointerEvent} e */
  up(e) {
    this.pointers.delete(e.pointerId);
    const { press, editor } = this, click = press && press.far <= CLICK;
    if (!press) return;
    if (press.does === 'pinch') {
      if (!this.pointers.size) this.press = null;
      return;
    }
    this.at = this.ground(e.clientX, e.clientY);
    const preview = this.preview;
    this.press = null;
    this.preview = null;
    if (press.does === 'tool') this.fix(press, e.shiftKey);
    else if (press.does === 'frame' && !click) this.framed(press.at, press.more);
    else if (click && ['frame', 'pan'].includes(press.does)) editor.selectRoom(e.button === 0 ? this.at : null);
    else if (preview) editor.do(preview, editor.selection);
    this.draw();
  }

  /** @param {PointerEvent} e */
  cancel(e) {
    this.pointers.delete(e.pointerId);
    this.press = null;
    this.preview = null;
    this.draw();
  }

  /** @param {PointerEvent} e */
  pinch(e) {
    const [before, other] = [this.pointers.get(e.pointerId), [...this.pointers].find(([id]) => id !== e.pointerId)?.[1]];
    if (!before || !other) return;
    const now = [e.clientX, e.clientY], middle = [(now[0] + other[0]) / 2, (now[1] + other[1]) / 2];
    this.middle = [this.middle[0] - (now[0] - before[0]) / 2 / this.scale, this.middle[1] + (now[1] - before[1]) / 2 / this.scale];
    this.zoom(hypot(now[0] - other[0], now[1] - other[1]) / (hypot(before[0] - other[0], before[1] - other[1]) || 1), middle);
  }

  /** @param {Point} from @param {boolean} more */
  framed(from, more) {
    const { editor } = this, [left, right] = [min(from[0], this.at[0]), max(from[0], this.at[0])], [low, high] = [min(from[1], this.at[1]), max(from[1], this.at[1])];
    const keys = keysOf(editor.storey).filter((key) => !key.startsWith('labels/') && placesOf(itemOf(editor.storey, key)).every(([x, y]) => x >= left && x <= right && y >= low && y <= high));
    editor.select(more ? [...new Set([...editor.selection, ...keys])] : keys);
  }

  /**
   * Ends a press with a tool: it draws or puts.
   * @param {any} press @param {boolean} again whether the tool is kept
   */
  fix(press, again) {
    const { editor, tool } = this, { storey } = editor;
    if (tool.name === 'put') {
      const made = this.putAt({ does: 'tool', ...press });
      if (!made) {
        editor.hint(tool.list === 'lifts' ? t('An elevator joins floors: add one first, by + Floor below') : t('A door or a window goes on a wall'));
        return;
      }
      editor.do({ add: [made] }, [`${made[0]}/${(storey[made[0]] ?? []).length}`]);
      this.use(again ? tool : { name: 'select' });
      return;
    }
    if (press.began && press.far <= CLICK) return; // a click: the next one ends it
    this.wallTo(this.end());
  }

  /** @returns {Point} where the wall or room that is drawn ends now */
  end() {
    const { tool, editor } = this;
    if (tool.name === 'room') return snapped(editor.storey, this.at, this.reach);
    const to = snapped(editor.storey, this.at, this.reach, tool.from, LEAST_WALL), long = Number(tool.typed.replace(',', '.'));
    if (!tool.typed || !(long > 0)) return to;
    const yaw = atan2(to[1] - tool.from[1], to[0] - tool.from[0]);
    return [Math.round((tool.from[0] + long * cos(yaw)) * 1e4) / 1e4, Math.round((tool.from[1] + long * sin(yaw)) * 1e4) / 1e4];
  }

  /** @param {Point} to */
  wallTo(to) {
    const { editor, tool } = this, { storey } = editor, room = tool.name === 'room';
    if (distance(tool.from, to) < LEAST_WALL || (room && min(abs(tool.from[0] - to[0]), abs(tool.from[1] - to[1])) < LEAST_WALL)) {
      if (!room) this.use(tool);
      return;
    }
    const met = wallAt(storey, to, 0.01), walls = room ? roomWalls(storey, tool.from, to, editor.thickness) : [wallOf(storey, tool.from, to, editor.thickness)];
    if (walls.length) editor.do({ add: walls.map((wall) => ['walls', wall]) }, []);
    tool.typed = '';
    tool.from = met || room ? null : to;
    this.draw();
  }

  /** @param {Point} from @returns {number} the direction in which a sensor is aimed */
  aim(from) { return Math.round(atan2(this.at[1] - from[1], this.at[0] - from[0]) / STEP) * STEP; }

  /**
   * The item at a place: what is small comes first.
   * @param {Point} at @returns {string | null}
   */
  hit(at) {
    const { storey } = this.editor, found = (/** @type {string} */ list, /** @type {(item: Item) => number} */ away) => {
      let best = null, least = this.reach;
      for (const [i, item] of (storey[list] ?? []).entries()) {
        const far = away(item);
        if (far < least || (far === 0 && far <= least)) { best = `${list}/${i}`; least = far; }
      }
      return best;
    };
    const spot = (/** @type {number} */ half) => (/** @type {Item} */ item) => max(0, distance([item.x, item.y], at) - half);
    const rect = (/** @type {Item} */ item, /** @type {number} */ deep, /** @type {number} */ wide) => {
      const [dx, dy] = [at[0] - item.x, at[1] - item.y], [c, s] = [cos(item.yaw), sin(item.yaw)];
      return hypot(max(0, abs(dx * c + dy * s) - deep / 2), max(0, abs(dy * c - dx * s) - wide / 2));
    };
    const keys = new Set(keysOf(storey)), lift = found('lifts', (item) => rect(item, item.depth + 0.3, item.width + 0.3));
    return found('movers', spot(BODY)) ?? found('sensors', spot(SPOT)) ?? found('lamps', spot(SIGN)) ?? found('openings', (item) => rect(item, item.width, item.band[1] - item.band[0]))
      ?? found('pieces', (item) => (item.shape === 'flat' ? MOUSE / this.scale : 1) * 1e-6 + rect(item, item.depth, item.width))
      ?? (lift && keys.has(lift) ? lift : null) ?? wallAt(storey, at, this.reach)?.key ?? null;
  }

  // --- keys

  /** @param {string} key of the keyboard @returns {boolean} whether a tool takes it */
  key(key) {
    const { tool } = this;
    if (tool.name === 'select') return false;
    const way = ARROWS[key];
    if (way) {
      this.at = [gridded(this.at[0] + way[0] * GRID), gridded(this.at[1] + way[1] * GRID)];
      this.inside = true;
    } else if (key === 'Enter') {
      if (tool.name !== 'put' && !tool.from) tool.from = snapped(this.editor.storey, this.at, this.reach);
      else this.fix({ far: 0, at: this.at }, false);
    } else if (tool.from && tool.name === 'wall' && /^[\d.,]$/.test(key)) tool.typed += key;
    else if (tool.from && tool.name === 'wall' && key === 'Backspace') tool.typed = tool.typed.slice(0, -1);
    else return false;
    this.draw();
    return true;
  }

  /** @returns {any} the edit that a sensor which is put or aimed would be */
  aimed() {
    const { tool, press, editor } = this;
    if (this.preview && editor.selection.length === 1 && editor.selection[0].startsWith('sensors/')) return this.preview;
    if (tool.name !== 'put' || tool.list !== 'sensors' || !this.inside) return null;
    const made = this.putAt(press);
    return made && { add: [made] };
  }

  /** @param {any} press @returns {[string, Item] | null} what the tool would put where the pointer is, or aim there */
  putAt(press) {
    const aims = press?.does === 'tool' && this.tool.list === 'sensors' && press.far > CLICK;
    return aims ? this.ghost(press.at, this.aim(press.at)) : this.ghost(this.at);
  }

  /** @returns {boolean} whether one sees what motion sensors see */
  get covered() {
    const { tool, editor: { covers, selection } } = this;
    return covers || (tool.name === 'put' && tool.list === 'sensors') || (selection.length === 1 && selection[0].startsWith('sensors/'));
  }

  // --- what it shows

  later() {
    this.pending ??= requestAnimationFrame(() => { this.pending = undefined; this.draw(); });
  }

  draw() {
    const { editor } = this, { clientWidth: width, clientHeight: height } = this.element;
    if (!width || !editor.history) return;
    const [w, h] = [width / this.scale, height / this.scale];
    this.root.setAttribute('viewBox', `${this.middle[0] - w / 2} ${-this.middle[1] - h / 2} ${w} ${h}`);
    const storey = this.preview ? editor.previewed(this.preview) : editor.storey, chosen = new Set(this.preview ? [] : editor.selection);
    const [rooms, names] = this.rooms(storey);
    this.handles = [];
    this.root.replaceChildren(this.grid(w, h), ...this.below(storey), ...rooms, ...this.picture(storey), ...this.cover(), ...this.lifts(storey, chosen), ...this.walls(storey, chosen), ...this.things(storey, chosen), ...names, ...this.marks(storey, chosen), ...this.tooled(), ...this.frame(), ...this.grips());
    editor.tryOut(this.aimed());
  }

  /** What the tool would make where the pointer is. */
  tooled() {
    const { tool, editor, press } = this, { storey } = editor;
    if (tool.name === 'select' || (!this.inside && !tool.from)) return [];
    if (tool.name === 'put') {
      const made = this.putAt(press);
      if (!made) return [svg('circle', { class: 'dot', r: 5 / this.scale, cx: this.at[0], cy: -this.at[1] })];
      const [list, item] = made;
      if (list === 'openings') return [this.opening(item, false, 'ghost')];
      if (list === 'pieces') return [this.piece(item, false, 'ghost')];
      if (list === 'lifts') return [this.lift(item, false, 'ghost')];
      return [list === 'sensors' ? this.field(storey, item, true) : null, this.mark(list, item, false, 'ghost')].filter(Boolean);
    }
    const dot = (/** @type {Point} */ at) => svg('circle', { class: 'dot', r: 5 / this.scale, cx: at[0], cy: -at[1] });
    if (!tool.from) return [dot(snapped(storey, this.at, this.reach))];
    const to = this.end(), wall = (/** @type {Point} */ a, /** @type {Point} */ b) => svg('line', { class: 'wall ghost', x1: a[0], y1: -a[1], x2: b[0], y2: -b[1], 'stroke-width': editor.thickness });
    if (tool.name === 'wall') return [wall(tool.from, to), dot(tool.from), dot(to), this.measure(tool.from, to, tool.typed)];
    const [a, b, c, d] = [tool.from, [to[0], tool.from[1]], to, [tool.from[0], to[1]]];
    return [wall(a, b), wall(b, c), wall(c, d), wall(d, a), this.measure(a, b), this.measure(b, c), dot(to)];
  }

  /** The rectangle that selects. */
  frame() {
    const { press } = this;
    if (press?.does !== 'frame' || press.far <= CLICK) return [];
    return [svg('rect', { class: 'frame', x: min(press.at[0], this.at[0]), y: -max(press.at[1], this.at[1]), width: abs(press.at[0] - this.at[0]), height: abs(press.at[1] - this.at[1]) })];
  }

  /** The handles of the one thing that is selected. */
  grips() {
    const { storey, selection } = this.editor, [key] = selection, item = selection.length === 1 ? itemOf(storey, key) : null;
    if (!item || this.preview || this.tool.name !== 'select') return [];
    if (item.start) this.handles = /** @type {const} */ (['start', 'end']).map((does) => ({ at: item[does], key, does }));
    else if ('yaw' in item && !key.startsWith('openings/')) {
      const far = (item.depth ?? 0) / 2 + 26 / this.scale;
      this.handles = [{ at: [item.x + far * cos(item.yaw), item.y + far * sin(item.yaw)], key, does: 'turn' }];
    }
    const stem = this.handles[0]?.does === 'turn' ? [svg('line', { class: 'stem', x1: item.x, y1: -item.y, x2: this.handles[0].at[0], y2: -this.handles[0].at[1] })] : [];
    return [...stem, ...this.handles.map(({ at }) => svg('circle', { class: 'grip', r: HANDLE / this.scale, cx: at[0], cy: -at[1] }))];
  }
}
