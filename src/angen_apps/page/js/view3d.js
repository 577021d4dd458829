/** The home in 3D: drawn again only when something changed. */
import * as THREE from '../vendor/three/three.module.min.js';
import { OrbitControls } from '../vendor/three/OrbitControls.js';
import { Sky } from './daylight.js';
import { by } from './dom.js';
import { Glows } from './glow.js';
import { Labels } from './labels.js';
import { Bulbs, Fields, Scans } from './overlays.js';
import { isPlain, paint } from './paint.js';
import { People } from './people.js';
import { CUT, Shapes, poseMatrix } from './shapes.js';

const EASE = 12; // 1/s, with which shown poses follow those that were sent
const PLAIN_PERIOD = 80; // ms between frames where the processor draws
const SHARE = 1.3; // of the time that a frame took, until the next one: buttons need some too
const PLAIN_PIXELS = 4.5e5;
const TOWER = 3; // floors: of more, those below the top one show no small things while all are shown
const SMALL = 0.3; // m

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
    this.frames = 0;
    this.drawnAt = 0;
    this.pause = PLAIN_PERIOD; // ms
    this.hidden = false;
    this.element = by('scene');
    this.plain = isPlain();
    this.renderer = new THREE.WebGLRenderer({ antialias: !this.plain, powerPreference: 'high-performance' });
    this.renderer.shadowMap.enabled = !this.plain;
    this.renderer.shadowMap.type = THREE.PCFSoftShadowMap;
    this.renderer.shadowMap.autoUpdate = false;
    this.element.append(this.renderer.domElement);
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(38, 1, 0.1, 600);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.maxPolarAngle = 1.5;
    this.controls.zoomToCursor = true;
    this.controls.addEventListener('start', () => { this.goal = null; });
    this.controls.addEventListener('change', () => { this.dirty = true; });
    this.controls.listenToKeyEvents(this.element);
    this.sky = new Sky();
    this.scene.add(this.sky.group);
    this.glows = new Glows();
    this.bulbs = new Bulbs(home);
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
    home.on('poses', (links) => this.follow(links));
    home.on('levels', () => this.relight());
    home.on('stats', () => this.shine());
    home.on('scan', (scan) => { if (!this.hidden && this.shapes && this.scans.put(scan)) this.dirty = true; });
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

  /** What comes together is built once. */
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
    this.findLux();
    this.isTower = home.storeys.length > TOWER;
    this.top = home.storeys[home.storeys.length - 1]?.number ?? 0;
    this.shapes = new Shapes(home.scene, this.people.build(), (cls, color, link, shape) => paint(home, cls, color, link, shape), this.plain);
    this.scene.add(this.shapes.group);
    this.glows.build(home.rooms);
    this.bulbs.build();
    this.fields.build();
    this.shapes.clearWalls(this.walls === 'clear');
    this.placeAll();
    if (!this.framed) this.look();
    this.relight();
    this.setTheme(this.dark);
  }

  // --- what is shown where

  /** @param {any} part @param {number} z of its middle @returns {number | null} */
  shown(part, z) {
    if (part.cls === 'ceiling' && this.walls !== 'full') return NaN;
    if (part.cls === 'ground') return null;
    const storey = part.storey ?? this.home.storeyAt(z);
    if (this.storey !== null ? storey !== this.storey : this.isTower && storey !== this.top && (part.extent < SMALL || part.type > 2)) return NaN;
    const cutting = this.walls === 'cut' && (part.cls === 'wall' || part.cls === 'window');
    if (!cutting) return this.walls === 'full' || part.cls !== 'ceiling' ? null : NaN;
    const base = this.home.storeys.find((s) => s.number === storey)?.elevation;
    return (base ?? Math.floor((z + 0.3) / 4) * 4) + CUT;
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
    this.glows.show((storey) => this.showsStorey(storey));
    this.bulbs.show((light) => this.lightPlace(light), (storey) => this.showsStorey(storey), this.dark);
    this.fields.show(this.withFields, (storey) => this.showsStorey(storey));
    this.shadowsAt = 0;
    this.dirty = true;
  }

  /** @param {any} light @returns {number[]} */
  lightPlace(light) {
    const own = new THREE.Vector3().fromArray(light.pose);
    return (light.link < 0 ? own : own.applyMatrix4(poseMatrix(this.home.pose(light.link), matrix))).toArray();
  }

  relight() {
    if (!this.shapes) return;
    const { home } = this;
    /** @type {Map<string, any[]>} */
    const rooms = new Map();
    home.scene.lights.forEach((/** @type {any} */ light, /** @type {number} */ i) => {
      if (light.sun) return;
      const at = this.lightPlace(light), room = home.roomAt(at[0], at[1], at[2]);
      const most = Math.max(...light.color.slice(0, 3), 0.01), color = light.color.slice(0, 3).map((/** @type {number} */ c) => c / most);
      if (room) rooms.set(room.name, [...(rooms.get(room.name) ?? []), { at, color, level: home.levels.get(i) ?? 0 }]);
    });
    for (const room of home.rooms) this.glows.light(room.name, rooms.get(room.name) ?? [], this.lux(room), this.dark);
    this.show();
  }

  /** The first luminosity sensor of each room. */
  findLux() {
    /** @type {Map<string, import('./home.js').Entity>} */
    this.luxOf = new Map();
    for (const e of this.home.entities) {
      const room = e.kind === 'luminosity' ? this.home.roomsOf(e)[0] : null;
      if (room && !this.luxOf.has(room.name)) this.luxOf.set(room.name, e);
    }
    this.luxField = Math.max(0, this.home.fields('luminosity').findIndex((field) => field.name === 'illuminance'));
  }

  /** @param {any} room @returns {number | null} */
  lux(room) {
    const sensor = this.luxOf?.get(room.name);
    return (sensor && this.home.row(sensor)?.values[this.luxField ?? 0]) ?? null;
  }

  /** @param {any[]} rows */
  onRows(rows) {
    if (!this.shapes) return;
    if (rows.some((row) => row.kind === 'luminosity' || row.kind === 'lamp')) this.relight();
    const sensors = rows.some((row) => this.home.kinds[row.kind]?.role === 'sensor');
    if (sensors && this.fields.show(this.withFields, (storey) => this.showsStorey(storey))) this.dirty = true;
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
    if (this.drawnAt === this.last) this.pause = Math.max(PLAIN_PERIOD, SHARE * (now - this.last));
    this.last = now;
    if (this.hidden || !this.shapes) return;
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
    this.glide(dt);
    this.controls.update(dt);
    if (!this.dirty || (this.plain && now - this.drawnAt < this.pause)) return;
    this.drawnAt = now;
    if (now - this.shadowsAt > 400) { this.renderer.shadowMap.needsUpdate = true; this.shadowsAt = now; }
    this.dirty = false;
    this.renderer.render(this.scene, this.camera);
    this.frames++;
    this.labels.place(this);
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.element;
    if (!width || !height) return;
    this.renderer.setPixelRatio(this.plain ? Math.min(1, Math.sqrt(PLAIN_PIXELS / (width * height))) : Math.min(2, devicePixelRatio));
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.dirty = true;
  }

  /** The box around what is shown. */
  box() {
    const box = new THREE.Box3();
    for (const room of this.home.rooms) {
      if (!this.showsStorey(room.storey)) continue;
      for (const [x, y] of room.polygon) {
        box.expandByPoint(new THREE.Vector3(x, y, room.floor));
        box.expandByPoint(new THREE.Vector3(x, y, room.floor + CUT));
      }
    }
    return box.isEmpty() ? this.shapes?.bounds ?? box : box;
  }

  /**
   * Moves the camera so that all that is shown is seen.
   * @param {boolean} [above]
   */
  look(above = false) {
    if (!this.shapes) return;
    this.framed = this.home.rooms.length > 0; // until then what is seen may change
    const box = this.box(), middle = box.getCenter(new THREE.Vector3()), size = box.getSize(new THREE.Vector3());
    const way = above ? new THREE.Vector3(0, -0.02, 1) : new THREE.Vector3(-0.5, -0.92, this.storey === null && this.home.storeys.length > 1 ? 0.72 : 1.05);
    way.normalize();
    const radius = 0.5 * Math.hypot(size.x, size.y, size.z), distance = this.distance(box, middle, way);
    this.goal = { at: middle.clone().addScaledVector(way, distance), target: middle };
    if (!this.looked || matchMedia('(prefers-reduced-motion: reduce)').matches) { this.glide(100); this.looked = true; }
    this.sky.cover(middle, radius);
    this.shadowsAt = 0;
    this.dirty = true;
  }

  /**
   * From where a box fills the view.
   * @param {any} box
   * @param {any} middle
   * @param {any} way from the middle to the camera, of length 1
   */
  distance(box, middle, way) {
    const tall = Math.tan((this.camera.fov * Math.PI) / 360), wide = tall * this.camera.aspect;
    const right = new THREE.Vector3(-way.y, way.x, 0).normalize(), up = new THREE.Vector3().crossVectors(way, right), corner = new THREE.Vector3();
    let most = 1;
    for (let i = 0; i < 8; i++) {
      corner.set(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z).sub(middle);
      most = Math.max(most, corner.dot(way) + Math.max(Math.abs(corner.dot(right)) / wide, Math.abs(corner.dot(up)) / tall));
    }
    return 1.06 * most;
  }

  /** @param {number} dt */
  glide(dt) {
    if (!this.goal) return;
    const part = 1 - Math.exp(-7 * dt);
    this.camera.position.lerp(this.goal.at, part);
    this.controls.target.lerp(this.goal.target, part);
    this.dirty = true;
    if (this.camera.position.distanceTo(this.goal.at) < 0.02) this.goal = null;
  }

  // --- picking

  /**
   * Where something is on the screen, in pixels of the page.
   * @param {number[]} at
   * @returns {number[]}
   */
  screen(at) {
    const box = this.element.getBoundingClientRect();
    this.camera.updateMatrixWorld();
    const point = new THREE.Vector3().fromArray(at).project(this.camera);
    return [box.left + ((point.x + 1) / 2) * box.width, box.top + ((1 - point.y) / 2) * box.height];
  }

  /** @param {number} x @param {number} y in pixels of the page */
  pick(x, y) {
    const hit = this.hit(x, y);
    if (hit) this.onPick(hit);
  }

  /** @param {number} x @param {number} y @returns {{model: string, link: number, cls: string, point: number[]} | null} */
  hit(x, y) {
    if (!this.shapes) return null;
    const box = this.element.getBoundingClientRect();
    this.camera.updateMatrixWorld();
    this.raycaster.setFromCamera(new THREE.Vector2(((x - box.left) / box.width) * 2 - 1, 1 - ((y - box.top) / box.height) * 2), this.camera);
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
    this.storey = storey;
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

const matrix = new THREE.Matrix4();