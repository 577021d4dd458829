/** The state that the server sends, and data derived from it; views listen to its parts. */
import { setAccess } from './access.js';
import { Connection } from './connection.js';
import { clockText, notice } from './dom.js';
import { state, t } from './lang.js';

/** @typedef {{kind: string, name: string, model: string, topic: string, type: string, room: string, pose: number[]}} Entity */
/** @typedef {{kind: string, name: string, text: string, alarm: boolean, stamp: number, values: (number | null)[]}} Row */
/** @typedef {{name: string, use: string, storey: number, polygon: number[][], holes: number[][][], floor: number, ceiling: number, area: number, guessed: boolean}} Room */
/** @typedef {{number: number, name: string, elevation: number, height: number}} Storey */

const POSES = 1, LEVELS = 2, PICTURE = 3, SCAN = 4; // as store.py
export const HISTORY = 300; // s
const BLOCK = 500; // values of a series that are forgotten at a time, once they are older; the server has them all
const PATIENCE = 8000; // ms

export class Home {
  constructor() {
    /** @type {Record<string, any>} */
    this.kinds = {};
    /** @type {Map<string, Row>} */
    this.rows = new Map();
    /** @type {Entity[]} */
    this.entities = [];
    /** @type {Room[]} */
    this.rooms = [];
    /** @type {Storey[]} */
    this.storeys = [];
    /** @type {Map<string, number>} of things, by the rooms that the home describes */
    this.floors = new Map();
    /** @type {any} */
    this.described = null;
    /** @type {any} */
    this.scene = null;
    /** @type {Map<number, Float32Array>} by link: x y z and quaternion */
    this.poses = new Map();
    /** @type {Map<number, number>} by light */
    this.levels = new Map();
    this.poseScene = 0;
    /** @type {any[]} */
    this.events = [];
    /** @type {any} */
    this.stats = { time: 0, factor: 0, paused: false };
    this.statsAt = performance.now();
    /** @type {any} */
    this.status = { node: false, replay: false };
    this.connected = false;
    /** @type {any} */
    this.cost = null;
    /** @type {Record<string, {goal: string, text: string, drives: boolean, share: number | null}>} by robot */
    this.trips = {};
    /** @type {Map<string, {t: number[], v: (number | null)[]}>} by kind/name/field */
    this.series = new Map();
    /** @type {Map<string, ((what: any) => void)[]>} */
    this.listeners = new Map();
    this.loading = 0;
    /** @type {WeakMap<Entity, Room[]>} of static entities */
    this.roomsCache = new WeakMap();
    /** @type {Entity[]} */
    this.movers = [];
    /** @type {any} */
    this.line = null;
    /** @type {Record<string, number[][][]>} lines of things on a plan by type, from -1 to 1 */
    this.symbols = {};
    this.connection = new Connection((parts) => this.take(parts), (blob) => this.takeBlob(blob), (open) => {
      this.connected = open;
      this.tell('status');
    });
  }

  /** @param {string} topic @param {(what: any) => void} listener */
  on(topic, listener) {
    this.listeners.set(topic, [...(this.listeners.get(topic) ?? []), listener]);
  }

  /** @param {string} topic @param {any} [what] */
  tell(topic, what) {
    for (const listener of this.listeners.get(topic) ?? []) listener(what);
  }

  async begin() {
    this.kinds = await (await fetch('/kinds.json')).json();
    this.onEntities();
  }

  onEntities() {
    this.roomsCache = new WeakMap();
    this.movers = this.entities.filter((e) => this.isMover(e));
    this.tell('entities');
  }

  /** @param {any} parts */
  take(parts) {
    if (parts.access) { setAccess(parts.access); this.tell('access'); }
    if (parts.status) { this.status = parts.status; this.tell('status'); }
    if (parts.stats) {
      if (parts.stats.time < this.stats.time - 1) this.series.clear(); // a reset
      this.stats = parts.stats;
      this.statsAt = performance.now();
      this.tell('stats');
    }
    if (parts.home) {
      this.described = parts.home;
      this.rooms = parts.home.rooms ?? [];
      this.storeys = [...(parts.home.storeys ?? [])].sort((a, b) => a.number - b.number);
      const numbers = new Map(this.rooms.map((room) => [room.name, room.storey]));
      this.floors = new Map((parts.home.things ?? []).filter((/** @type {any} */ thing) => numbers.has(thing.room))
        .map((/** @type {any} */ thing) => [thing.name, numbers.get(thing.room)]));
      this.roomsCache = new WeakMap();
      this.tell('home');
    }
    this.symbols = parts.symbols ?? this.symbols;
    if (parts.entities) { this.entities = parts.entities; this.onEntities(); }
    if (parts.rows) this.takeRows(parts.rows, parts.complete);
    if (parts.events) {
      this.events = [...this.events, ...parts.events].slice(-500);
      this.tell('events', parts.events);
    }
    if (parts.trips) { this.trips = parts.trips; this.tell('trips'); }
    if (parts.cost) { this.cost = parts.cost; this.tell('cost'); }
    if (parts.timeline) this.tell('timeline', parts.timeline);
    if (parts.line) { this.line = parts.line; this.tell('line'); }
    if (parts.scene) this.load(parts.scene);
  }

  /** @param {any[][]} rows @param {boolean} complete */
  takeRows(rows, complete) {
    const before = this.rows;
    if (complete) this.rows = new Map();
    /** @type {Row[]} */
    const changed = [];
    for (const [kind, name, text, alarm, stamp, values] of rows) {
      const row = { kind, name, text, alarm, stamp, values };
      const old = before.get(`${kind}/${name}`);
      this.rows.set(`${kind}/${name}`, row);
      this.remember(row);
      if (!old || old.text !== text || old.alarm !== alarm) changed.push(row);
    }
    this.tell('values', rows);
    if (changed.length || complete) this.tell('rows', { changed, complete });
  }

  /**
   * The names of a row's values.
   * @param {string} kind
   * @returns {any[]}
   */
  fields(kind) {
    return (this.kinds[kind]?.fields ?? []).filter((/** @type {any} */ f) => ['flag', 'integer', 'number'].includes(f.type));
  }

  /** @param {Row} row */
  remember(row) {
    if (!row.text) return;
    this.fields(row.kind).forEach((field, i) => {
      const value = row.values[i];
      if (value === null || value === undefined) return;
      const key = `${row.kind}/${row.name}/${field.name}`;
      let series = this.series.get(key);
      if (!series) this.series.set(key, series = { t: [], v: [] });
      const { t, v } = series, n = t.length;
      if (n && row.stamp <= t[n - 1]) return;
      if (n > 1 && v[n - 1] === value && v[n - 2] === value) { t[n - 1] = row.stamp; return; } // a level line has two ends
      t.push(row.stamp);
      v.push(value);
      if (t[BLOCK] < row.stamp - HISTORY) { t.splice(0, BLOCK); v.splice(0, BLOCK); }
    });
  }

  /** @param {number} number */
  async load(number) {
    this.loading = number;
    const answer = await fetch('/scene.json');
    if (!answer.ok || this.loading !== number) return;
    const scene = await answer.json();
    if (scene.number < number) return;
    if (this.poseScene !== scene.number) { this.poses.clear(); this.levels.clear(); this.poseScene = scene.number; }
    this.scene = scene;
    this.roomsCache = new WeakMap();
    this.tell('scene');
  }

  /** @param {ArrayBuffer} blob */
  takeBlob(blob) {
    const [kind, second] = new Uint32Array(blob, 0, 2);
    if (kind === PICTURE || kind === SCAN) {
      const name = new TextDecoder().decode(new Uint8Array(blob, 8, second));
      const content = blob.slice(8 + Math.ceil(second / 4) * 4);
      this.tell(kind === PICTURE ? 'picture' : 'scan', { name, content });
      return;
    }
    if (second !== this.poseScene) { this.poses.clear(); this.levels.clear(); this.poseScene = second; }
    const [count] = new Uint32Array(blob, 8, 1);
    const indices = new Uint32Array(blob, 12, count);
    const values = new Float32Array(blob, 12 + 4 * count);
    if (kind === POSES) {
      indices.forEach((link, i) => this.poses.set(link, values.slice(7 * i, 7 * i + 7)));
      if (this.scene?.number === second) this.tell('poses', indices);
    } else if (kind === LEVELS) {
      indices.forEach((light, i) => this.levels.set(light, values[i]));
      if (this.scene?.number === second) this.tell('levels');
    }
  }

  // --- derived

  /**
   * The clock of the home.
   * @param {number} time s since the start of the run
   */
  clock(time) {
    const start = /T(\d+):(\d+):(\d+)/.exec(this.described?.start ?? '');
    return clockText(start ? (Number(start[1]) * 3600 + Number(start[2]) * 60 + Number(start[3]) + time) % 86400 : time);
  }

  /** @param {number} link @returns {ArrayLike<number>} */
  pose(link) {
    return this.poses.get(link) ?? this.scene.links[link].pose;
  }

  /** @param {Entity} e @returns {Row | undefined} */
  row(e) {
    return this.rows.get(`${e.kind}/${e.name}`);
  }

  /** @param {{kind: string, name: string}} e @returns {string} its state in the user's language */
  told({ kind, name }) {
    return state(this.rows.get(`${kind}/${name}`)?.text ?? '', this.kinds[kind]);
  }

  /** @param {string} model @returns {Entity[]} */
  ofModel(model) {
    return this.entities.filter((e) => e.model === model && e.kind !== 'model');
  }

  /** @param {number} z @param {number} [below] m below a floor's elevation, which still count */
  storeyAt(z, below = 0.3) {
    let found = this.storeys[0]?.number ?? 0;
    for (const storey of this.storeys) if (z >= storey.elevation - below) found = storey.number;
    return found;
  }

  /**
   * The floor of something at rest: that of its room if the home describes it, else of its height.
   * @param {string} name of its model @param {number} z of its middle @param {number} [below] as storeyAt has it
   */
  storeyOf(name, z, below) {
    return this.floors.get(name) ?? this.storeyAt(z, below);
  }

  /** @param {number} x @param {number} y @param {number} z @returns {Room | null} */
  roomAt(x, y, z) {
    return this.rooms.find((room) => z > room.floor - 0.5 && z < room.ceiling + 0.3 && inside(room.polygon, x, y)
      && !(room.holes ?? []).some((hole) => inside(hole, x, y))) ?? null;
  }

  /**
   * The present place of an entity.
   * @param {Entity} e
   */
  place(e) {
    const links = this.linksOf(e.model);
    if (this.isMover(e) && links.length) return this.pose(links[0]);
    return e.pose;
  }

  /** @param {Entity} e */
  isMover(e) {
    return e.kind === 'person' || this.isRobot(e);
  }

  /**
   * Whether it takes a speed and a turn.
   * @param {Entity} e
   */
  isRobot(e) {
    const values = this.kinds[e.kind]?.values ?? [];
    return values.length === 2 && values[0] === 'm/s' && values[1] === 'rad/s';
  }

  /**
   * Whether a device is on or open, by the words of its kind.
   * @param {Row | null | undefined} row
   */
  isOn(row) {
    const text = row?.text.toLowerCase() ?? '', word = this.kinds[row?.kind ?? '']?.fields.find((/** @type {any} */ f) => f.words?.length)?.words[0] ?? 'on';
    return [word, 'open'].some((on) => text.startsWith(on));
  }

  /** @param {string} model @returns {number[]} */
  linksOf(model) {
    if (!this.scene) return [];
    if (this.linkScene !== this.scene) {
      this.linkScene = this.scene;
      /** @type {Map<string, number[]>} */
      this.linkMap = new Map();
      this.scene.links.forEach((/** @type {any} */ link, /** @type {number} */ i) => {
        this.linkMap?.set(link.model, [...(this.linkMap.get(link.model) ?? []), i]);
      });
    }
    return this.linkMap?.get(model) ?? [];
  }

  /**
   * The name of an entity; of the home's door where it is one.
   * @param {Entity} e
   * @returns {Room[]}
   */
  roomsOf(e) {
    if (this.isMover(e)) return this.roomsNow(e);
    let rooms = this.rooms.length ? this.roomsCache.get(e) : undefined;
    if (!rooms) this.roomsCache.set(e, rooms = this.roomsNow(e));
    return rooms;
  }

  /** @param {Entity} e @returns {Room[]} */
  roomsNow(e) {
    if (e.kind === 'door' || e.kind === 'window') {
      const door = this.described?.doors?.find((/** @type {any} */ d) => d.name === e.name && d.kind === e.kind);
      if (door) return this.rooms.filter((room) => door.rooms.includes(room.name));
    }
    const [x, y, z] = Array.from(this.place(e));
    const named = !this.isMover(e) && e.room ? this.rooms.find((room) => room.name === e.room) : null;
    const found = named ?? this.roomAt(x, y, z) ?? this.roomAt(x, y, z - 1.2);
    return found ? [found] : [];
  }

  /**
   * A connection that was lost may be back in a moment.
   * @param {any} order
   */
  async order(order) {
    await this.connection.opened(PATIENCE);
    const answer = await this.connection.ask(order);
    if (!answer.ok) notice(answer.text ?? t('The simulator rejected it.'), true);
    return answer;
  }

  /** @param {Entity} e @param {string} text */
  command(e, text) {
    return this.order({ do: 'command', target: `${e.kind}/${e.name}`, text });
  }
}

/** @param {number[][]} polygon @param {number} x @param {number} y */
export function inside(polygon, x, y) {
  let is = false;
  for (let i = 0, j = polygon.length - 1; i < polygon.length; j = i++) {
    const [xi, yi] = polygon[i], [xj, yj] = polygon[j];
    if ((yi > y) !== (yj > y) && x < ((xj - xi) * (y - yi)) / (yj - yi) + xi) is = !is;
  }
  return is;
}

/** @param {number[][]} polygon @returns {number[]} */
export function middleOf(polygon) {
  let area = 0, x = 0, y = 0;
  polygon.forEach(([x0, y0], i) => {
    const [x1, y1] = polygon[(i + 1) % polygon.length], cross = x0 * y1 - x1 * y0;
    area += cross;
    x += (x0 + x1) * cross;
    y += (y0 + y1) * cross;
  });
  return area ? [x / (3 * area), y / (3 * area)] : polygon[0];
}
