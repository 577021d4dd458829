/** The home in 3D: drawn again only when something changed. */
import * as THREE from '../vendor/three/three.module.min.js';
import { Sky } from './daylight.js';
import { by } from './dom.js';
import { Eyes } from './eyes.js';
import { Glows } from './glow.js';
import { Labels } from './labels.js';
import { Bulbs, Fields, Scans } from './overlays.js';
import { isOuter, isPlain, paint } from './paint.js';
import { People } from './people.js';
import { RoomLights } from './roomlights.js';
import { CUT, Shapes, poseMatrix } from './shapes.js';
import { Sharpness } from './sharpness.js';
import { Viewpoint } from './viewpoint.js';

const matrix = new THREE.Matrix4();
const EASE = 12; // 1/s, with which shown poses follow those that were sent
const PLAIN_PERIOD = 80; // ms between frames where the processor draws
const SHARE = 1.3; // of the time that a frame took, until the next one: buttons need some too
const TOWER = 3; // floors: of more, those below the top one are closed while all are shown
const GROUND = new THREE.Box3(new THREE.Vector3(-5, -5, 0), new THREE.Vector3(5, 5, 1)); // where there are no models
const LEAF = 1.2; // m: moving leaves in their walls are higher
const TALL = 3, LID = 2.5, PLATE = 1; // m: models this tall reach through floors; those above a floor and this thin are like a roof
const SLAB = 0.3, THING = 0.05; // m below its floor's elevation, where a part still is on it

export class View3d {
  /** @param {import('./home.js').Home} home @param {(hit: any) => void} onPick */
  constructor(home, onPick) {
    this.home = home;
    this.onPick = onPick;
    this.storey = /** @type {number | null} */ (null);
    this.walls = 'cut';
    this.withFields = false;
    this.dark = false;
    this.dirty = true;
    this.relabel = false;
    this.isTower = false;
    this.top = 0;
    this.frames = 0;
    this.drawnAt = 0;
    this.turnedAt = -Infinity;
    this.pause = PLAIN_PERIOD; // ms
    this.hidden = false;
    this.after = () => {}; // a frame was drawn
    this.held = false; // no frames but those of a film
    this.element = by('scene');
    this.plain = isPlain();
    this.renderer = new THREE.WebGLRenderer({ antialias: !this.plain, powerPreference: 'high-performance' });
    this.renderer.shadowMap.enabled = !this.plain;
    this.renderer.shadowMap.type = THREE.PCFSoftShadowMap;
    this.renderer.shadowMap.autoUpdate = false;
    this.element.append(this.renderer.domElement);
    this.scene = new THREE.Scene();
    this.viewpoint = new Viewpoint(this.element, this.renderer.domElement, () => { this.dirty = true; this.turnedAt = performance.now(); });
    this.sharpness = new Sharpness();
    this.sky = new Sky();
    this.scene.add(this.sky.group);
    this.glows = new Glows();
    this.lights = new RoomLights(home, this.glows);
    this.bulbs = new Bulbs(home, this.plain);
    this.fields = new Fields(home);
    this.scans = new Scans(home);
    this.scene.add(this.glows.group, this.bulbs.group, this.fields.group, this.scans.group);
    /** @type {Shapes | null} */
    this.shapes = null;
    /** @type {Map<number, {now: Float32Array, to: ArrayLike<number>}>} links on their way */
    this.moving = new Map();
    this.people = new People(home);
    this.scene.add(this.people.group);
    this.labels = new Labels();
    this.eyes = new Eyes(this);
    this.raycaster = new THREE.Raycaster();
    /** @type {Map<number, Float32Array>} poses by link, as shown */
    this.drawn = new Map();
    /** @type {any} */
    this.building = undefined;
    this.shadowsAt = 0;
    this.last = performance.now();
    this.listen();
    requestAnimationFrame(() => this.frame());
  }

  listen() {
    const { home } = this;
    for (const topic of ['scene', 'home', 'entities']) home.on(topic, () => this.buildSoon());
    let rooms = '[]';
    home.on('home', () => {
      const before = rooms;
      rooms = JSON.stringify(home.rooms.map((room) => room.polygon));
      if (before !== rooms) this.framed = false; // another home
    });
    home.on('poses', (links) => this.follow(links));
    home.on('levels', () => this.relight());
    home.on('stats', () => this.shine());
    home.on('scan', (scan) => {
      if (this.withFields && !this.hidden && this.shapes && this.scans.put(scan, (storey) => this.showsStorey(storey))) this.dirty = true;
    });
    this.renderer.domElement.addEventListener('webglcontextrestored', () => this.build());
    home.on('rows', ({ changed }) => this.onRows(changed));
    new ResizeObserver(() => this.resize()).observe(this.element);
    let down = [0, 0, 0];
    this.element.addEventListener('pointerdown', (/** @type {PointerEvent} */ e) => { down = [e.clientX, e.clientY, performance.now()]; });
    this.element.addEventListener('pointerup', (/** @type {PointerEvent} */ e) => {
      if (e.target === this.renderer.domElement && Math.hypot(e.clientX - down[0], e.clientY - down[1]) < 6) this.pick(e.clientX, e.clientY);
    });
  }

  // --- building

  /** Changes that arrive together are built once. */
  buildSoon() {
    this.building ??= setTimeout(() => { this.building = undefined; this.build(); }, 20);
  }

  build() {
    const { home } = this;
    if (!home.scene || !home.entities.length) return;
    if (this.shapes) {
      this.scene.remove(this.shapes.group);
      this.shapes.dispose();
    }
    this.moving.clear();
    this.drawn.clear();
    this.isTower = home.storeys.length > TOWER;
    this.top = home.storeys[home.storeys.length - 1]?.number ?? 0;
    this.shapes = new Shapes(home.scene, this.people.build(), (cls, color, link, shape) => paint(home, cls, color, link, shape), this.plain);
    this.scene.add(this.shapes.group);
    this.lights.build();
    this.bulbs.build();
    this.fields.build();
    this.shapes.clearWalls(this.walls === 'clear');
    this.placeAll();
    if (!this.framed) this.look();
    this.relight();
    this.setTheme(this.dark);
  }

  // --- visibility of parts

  /**
   * @param {any} part @param {number} z of its middle
   * @returns {number | null} the height at which it is cut; null: whole, NaN: hidden
   */
  shown(part, z) {
    if (part.cls === 'ground') return null;
    if (part.cls === 'ceiling' && this.walls !== 'full') return NaN;
    const storey = this.storeyOf(part, z), closed = this.isClosed(storey);
    if (this.storey !== null && storey !== this.storey) return NaN;
    if (closed) return this.isFacade(part) ? null : NaN;
    if (this.walls !== 'cut') return null;
    const [width, depth, height] = part.size;
    if (part.cls === 'wall' || part.cls === 'window') return this.floorOf(storey, z) + CUT;
    if (height > TALL) return this.floorOf(this.storey ?? this.top, z) + CUT; // such as the rails of an elevator
    return Math.min(width, depth) > PLATE && z > this.floorOf(storey, z) + LID ? NaN : null;
  }

  /** @param {number} storey @param {number} z in it @returns {number} the height of its floor */
  floorOf(storey, z) {
    return this.home.storeys.find((s) => s.number === storey)?.elevation ?? Math.floor((z + 0.3) / 4) * 4;
  }

  /** @param {any} part @param {number} z of its middle @returns {number} as the home counts floors, if it does */
  storeyOf(part, z) {
    if (!this.home.storeys.length) return part.storey ?? 0;
    if (part.cls === 'ceiling') return this.home.storeyAt(z - 0.6, SLAB);
    if (part.cls === 'floor') return this.home.storeyAt(z, SLAB);
    return part.moves ? this.home.storeyAt(z, THING) : this.home.storeyOf(this.home.scene.links[part.link].model, z, THING);
  }

  /** @param {any} part @returns {boolean} whether it is seen where a floor is closed */
  isFacade(part) {
    if (part.cls === 'window') return part.mesh.material.transparent;
    if (part.cls !== 'wall' && part.cls !== 'floor' && !(part.moves && part.extent > LEAF)) return false;
    return (part.isOuter ??= isOuter(this.home, part));
  }

  /** @param {number} storey @returns {boolean} whether its inside is covered by the floors above */
  isClosed(storey) {
    return this.storey === null && this.isTower && storey !== this.top;
  }

  placeAll() {
    if (!this.shapes) return;
    this.home.scene.links.forEach((/** @type {any} */ _, /** @type {number} */ link) => this.placeLink(link, this.home.pose(link)));
    this.shapes.settle();
    this.show();
  }

  /** @param {number} link @param {ArrayLike<number>} pose */
  placeLink(link, pose) {
    this.shapes?.place(link, poseMatrix(pose, matrix), (part, z) => this.shown(part, z));
    this.people.place(link, pose, (storey) => this.showsStorey(storey));
    this.dirty = true;
  }

  /** @param {number} storey */
  showsStorey(storey) {
    return this.storey === null || storey === this.storey;
  }

  show() {
    this.showBulbs();
    this.fields.show(this.withFields, (storey) => this.showsStorey(storey));
    this.shadowsAt = 0;
    this.dirty = true;
  }

  showBulbs() {
    this.glows.show((storey) => this.showsStorey(storey));
    this.bulbs.show((light) => this.lights.place(light), (storey, lit) => this.showsStorey(storey) && (lit || !this.isClosed(storey)), this.dark);
    this.dirty = true;
  }

  relight() {
    if (!this.shapes) return;
    this.lights.light(this.dark);
    this.showBulbs();
  }

  /** @param {any[]} rows */
  onRows(rows) {
    if (!this.shapes) return;
    if (this.lights.follow(rows, this.dark)) this.dirty = true;
    const sensors = rows.some((row) => this.home.kinds[row.kind]?.role === 'sensor');
    if (sensors && this.fields.show(this.withFields, (storey) => this.showsStorey(storey))) this.dirty = true;
    this.relabel = true;
    for (const row of rows) {
      if (row.kind !== 'person') continue;
      const person = this.home.entities.find((e) => e.kind === 'person' && e.name === row.name);
      if (person) { this.people.setPosture(person.model); this.placePerson(person.model); }
    }
  }

  /** @param {string} model */
  placePerson(model) {
    const link = this.home.linksOf(model)[0];
    if (link !== undefined) this.placeLink(link, this.drawn.get(link) ?? this.home.pose(link));
  }

  /** @param {Uint32Array} links */
  follow(links) {
    for (const link of links) {
      const to = this.home.pose(link), before = this.moving.get(link);
      if (before) before.to = to;
      else this.moving.set(link, { now: Float32Array.from(this.drawn.get(link) ?? to), to });
    }
    this.dirty = true;
  }

  // --- frames

  frame() {
    requestAnimationFrame(() => this.frame());
    const now = performance.now(), dt = Math.min(0.1, (now - this.last) / 1000);
    if (this.drawnAt === this.last) this.pace(now - this.last);
    this.last = now;
    if (this.hidden || !this.shapes || this.held) return;
    this.move(dt);
    if (this.plain && this.sharpness.rest(now - this.turnedAt)) this.resize();
    if (!this.dirty && this.relabel) this.labels.place(this);
    this.relabel = false;
    if (!this.dirty || (this.plain && now - this.drawnAt < this.pause)) return;
    this.drawnAt = now;
    if (now - this.shadowsAt > 400) { this.renderer.shadowMap.needsUpdate = true; this.shadowsAt = now; }
    this.draw();
  }

  draw() {
    this.dirty = false;
    this.renderer.render(this.scene, this.viewpoint.camera);
    this.frames++;
    this.labels.place(this);
    this.after();
  }

  /**
   * A frame in which all is where it is now.
   * @param {number} dt s since the one before
   */
  film(dt) {
    if (this.hidden || !this.shapes) return;
    for (const way of this.moving.values()) way.now.set(way.to);
    this.viewpoint.glide(100);
    this.move(dt);
    if (!this.dirty) return; // it takes a while where the processor draws
    this.renderer.shadowMap.needsUpdate = true;
    this.draw();
  }

  /**
   * The processor draws less often, and fewer pixels, where a frame takes long.
   * @param {number} took ms
   */
  pace(took) {
    this.pause = Math.max(PLAIN_PERIOD, SHARE * took);
    if (this.plain && this.sharpness.took(took)) this.resize();
  }

  /** @param {number} dt s */
  move(dt) {
    const part = 1 - Math.exp(-EASE * dt);
    for (const [link, way] of this.moving) {
      let rest = 0;
      for (let i = 0; i < 7; i++) {
        const far = way.to[i] - way.now[i];
        rest = Math.max(rest, Math.abs(far));
        way.now[i] += Math.abs(far) > 1.5 ? far : far * part;
      }
      if (rest < 5e-4) { way.now.set(way.to); this.moving.delete(link); }
      this.drawn.set(link, way.now);
      this.placeLink(link, way.now);
    }
    if (this.people.animate(dt)) this.dirty = true;
    if (this.fields.animate(dt)) this.dirty = true;
    if (this.eyes.entity) { this.eyes.place(); return; }
    this.viewpoint.glide(dt);
    this.viewpoint.controls.update(dt);
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.element;
    if (!width || !height) return;
    this.renderer.setPixelRatio(this.plain ? this.sharpness.share(width * height) : Math.min(2, devicePixelRatio));
    this.renderer.setSize(width, height);
    this.viewpoint.resize(width, height);
    if (!this.framed) this.look();
    this.drawnAt = -Infinity; // at once: the canvas is empty now
    this.dirty = true;
  }

  /** The box around the visible parts. */
  box() {
    const box = new THREE.Box3();
    for (const room of this.home.rooms) {
      if (!this.showsStorey(room.storey)) continue;
      for (const [x, y] of room.polygon) {
        box.expandByPoint(new THREE.Vector3(x, y, room.floor));
        box.expandByPoint(new THREE.Vector3(x, y, room.floor + CUT));
      }
    }
    const found = box.isEmpty() ? this.shapes?.bounds ?? box : box;
    return found.isEmpty() ? GROUND : found;
  }

  /**
   * Moves the camera so that all that is shown is seen.
   * @param {boolean} [above]
   */
  look(above = false) {
    this.eyes.end();
    if (!this.shapes) return;
    const box = this.box(), many = this.storey === null && this.home.storeys.length > 1;
    this.framed = this.home.described !== null && this.element.clientWidth > 0; // until then the visible parts may change, or their size
    this.viewpoint.look(box, above ? new THREE.Vector3(0, -0.02, 1) : new THREE.Vector3(-0.5, -0.92, many ? 0.72 : 1.05));
    this.sky.cover(box.getCenter(new THREE.Vector3()), 0.5 * box.getSize(new THREE.Vector3()).length());
    this.shadowsAt = 0;
  }

  // --- picking

  /** @param {number} x @param {number} y in pixels of the page */
  pick(x, y) {
    const hit = this.hit(x, y);
    if (hit) this.onPick(hit);
  }

  /** @param {number} x @param {number} y @returns {{model: string, link: number, cls: string, point: number[]} | null} */
  hit(x, y) {
    if (!this.shapes) return null;
    this.viewpoint.aim(this.raycaster, x, y);
    const hits = this.raycaster.intersectObjects([...this.shapes.meshes, this.bulbs.mesh, ...this.people.seen()], true);
    for (const { object, instanceId, point } of hits) {
      const { cls = 'thing', links, parts, link = links?.[instanceId] ?? parts?.[instanceId]?.link } = object.userData;
      if (link === undefined || (cls === 'wall' && this.walls === 'clear')) continue;
      return { model: this.home.scene.links[link].model, link, cls, point: point.toArray() };
    }
    return null;
  }

  // --- settings

  /** @param {number | null} storey */
  setStorey(storey) {
    this.eyes.end();
    this.storey = storey;
    this.scans.clear();
    this.placeAll();
    this.look();
  }

  /** @param {string} walls cut, clear or full */
  setWalls(walls) {
    this.walls = walls;
    this.shapes?.clearWalls(walls === 'clear');
    this.placeAll();
  }

  /** @param {boolean} shown */
  setFields(shown) {
    this.withFields = shown;
    if (!shown) this.scans.clear();
    if (this.shapes) this.show();
  }

  /** @param {boolean} dark */
  setTheme(dark) {
    const changed = dark !== this.dark;
    this.dark = dark;
    this.sky.way = null;
    this.shine();
    if (changed) this.build();
    this.dirty = true;
  }

  /** By the home's clock. */
  shine() {
    const background = this.sky.shine(this.home, this.dark);
    if (!background) return;
    this.scene.background = background;
    for (const mesh of this.shapes?.meshes ?? []) { // the ground has no edge
      if (mesh.userData.cls === 'ground') mesh.material.color.copy(background);
    }
    this.shadowsAt = 0;
    this.dirty = true;
  }
}
