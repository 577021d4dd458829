/** Bulbs of lamps, and the fields of sensors on the floor: one draw call each. */
import * as THREE from '../vendor/three/three.module.min.js';
import { fieldShape } from './fields.js';
import { poseMatrix } from './shapes.js';

const matrix = new THREE.Matrix4(), color = new THREE.Color();
const MOTION = 0x2f7df6, ALARM = 0xe5484d, QUIET = 0x0f9f8f;
export const MOVES = new Set(['pir', 'switch', 'proximity']); // their reports are not faults
const FLASH = 0.9; // s in which a field that fires gets calm

export class Bulbs {
  /** @param {import('./home.js').Home} home @param {boolean} plain of few faces */
  constructor(home, plain) {
    this.home = home;
    this.plain = plain;
    this.group = new THREE.Group();
    /** @type {number[]} */
    this.lights = [];
  }

  build() {
    const { lights } = this.home.scene;
    this.group.clear();
    this.mesh?.dispose();
    this.lights = lights.flatMap((/** @type {any} */ light, /** @type {number} */ i) => (light.sun || !light.model ? [] : [i]));
    this.mesh = new THREE.InstancedMesh(new THREE.SphereGeometry(0.09, ...(this.plain ? [6, 4] : [12, 8])), new THREE.MeshBasicMaterial(), Math.max(1, this.lights.length));
    this.mesh.frustumCulled = false;
    this.group.add(this.mesh);
  }

  /**
   * @param {(light: any) => number[]} placeOf
   * @param {(storey: number, lit: boolean) => boolean} shows
   * @param {boolean} dark
   */
  show(placeOf, shows, dark) {
    /** @type {number[]} */
    const links = [];
    for (const light of this.lights) {
      const lamp = this.home.scene.lights[light], at = placeOf(lamp), level = this.home.levels.get(light) ?? 0;
      if (!shows(this.home.storeyAt(at[2], 0.05), level > 0.003)) continue;
      const size = level > 0.003 ? 1 + 0.5 * Math.sqrt(level) : 0.8, i = links.push(lamp.link) - 1;
      this.mesh.setMatrixAt(i, matrix.makeScale(size, size, size).setPosition(at[0], at[1], at[2]));
      this.mesh.setColorAt(i, color.set(level > 0.003 ? 0xffd45e : dark ? 0x46525e : 0xb7bfc7));
    }
    this.mesh.count = links.length;
    this.mesh.userData.links = links;
    this.mesh.instanceMatrix.needsUpdate = true;
    if (this.mesh.instanceColor) this.mesh.instanceColor.needsUpdate = true;
    this.mesh.boundingSphere = null;
  }
}

export class Fields {
  /** @param {import('./home.js').Home} home */
  constructor(home) {
    this.home = home;
    this.group = new THREE.Group();
    /** @type {{key: string, kind: string, storey: number, first: number, count: number}[]} */
    this.all = [];
    this.state = '';
    /** @type {any} */
    this.shownOf = null;
    /** @type {Map<string, number>} s since a sensor began to fire, while it flashes */
    this.flashes = new Map();
  }

  build() {
    this.group.clear();
    this.geometry?.dispose();
    this.all = [];
    /** @type {number[]} */
    const positions = [];
    for (const sensor of this.home.scene.sensors.filter((/** @type {any} */ s) => s.rays)) {
      if (this.home.scene.links[sensor.link].moves) continue;
      const points = fieldShape(this.home, sensor), first = positions.length / 3;
      for (let i = 1; i + 1 < points.length; i++) { // a fan, seen from its first corner
        for (const [x, y, z] of [points[0], points[i], points[i + 1]]) positions.push(x, y, z + 0.03);
      }
      this.all.push({ key: `${sensor.kind}/${sensor.name}`, kind: sensor.kind, storey: this.home.storeyAt(points[0][2] + 0.1), first, count: positions.length / 3 - first });
    }
    this.geometry = new THREE.BufferGeometry();
    this.geometry.setAttribute('position', new THREE.Float32BufferAttribute(positions, 3));
    this.geometry.setAttribute('color', new THREE.Float32BufferAttribute(new Float32Array((positions.length / 3) * 4), 4));
    const material = new THREE.MeshBasicMaterial({ vertexColors: true, transparent: true, depthWrite: false, side: THREE.DoubleSide });
    const mesh = new THREE.Mesh(this.geometry, material);
    mesh.frustumCulled = false;
    mesh.renderOrder = 3;
    this.group.add(mesh);
  }

  /**
   * Those that fire, and with `all` the others.
   * @param {boolean} all
   * @param {(storey: number) => boolean} shows
   * @returns {boolean} whether anything changed
   */
  show(all, shows) {
    const shown = this.all.map(({ key, storey }) => (shows(storey) ? (this.home.rows.get(key)?.alarm ? 2 : all ? 1 : 0) : 0));
    const state = shown.join('');
    if (state === this.state && this.shownOf === this.geometry) return false;
    const fresh = this.shownOf !== this.geometry;
    this.all.forEach(({ key }, i) => {
      if (shown[i] !== 2) this.flashes.delete(key);
      else if (!fresh && this.state[i] !== '2') this.flashes.set(key, 0);
    });
    this.state = state;
    this.shownOf = this.geometry;
    /** @type {number[]} */
    const index = [];
    this.all.forEach(({ first, count }, i) => {
      if (shown[i]) for (let v = first; v < first + count; v++) index.push(v);
    });
    this.geometry.setIndex(index);
    this.color();
    return true;
  }

  color() {
    const colors = this.geometry.getAttribute('color');
    this.all.forEach(({ key, kind, first, count }, i) => {
      if (this.state[i] === '0') return;
      const fires = this.state[i] === '2', bright = 1 - (this.flashes.get(key) ?? FLASH) / FLASH;
      color.set(!fires ? QUIET : MOVES.has(kind) ? MOTION : ALARM);
      for (let v = first; v < first + count; v++) colors.setXYZW(v, color.r, color.g, color.b, fires ? 0.26 + 0.4 * bright : 0.13);
    });
    colors.needsUpdate = true;
  }

  /**
   * @param {number} dt s
   * @returns {boolean} whether any flashes
   */
  animate(dt) {
    if (!this.flashes.size) return false;
    for (const [key, time] of this.flashes) {
      if (time + dt < FLASH) this.flashes.set(key, time + dt);
      else this.flashes.delete(key);
    }
    this.color();
    return true;
  }
}

/** The last scans of lidars, as points. */
export class Scans {
  /** @param {import('./home.js').Home} home */
  constructor(home) {
    this.home = home;
    this.group = new THREE.Group();
    /** @type {Map<string, any>} */
    this.clouds = new Map();
    this.material = new THREE.PointsMaterial({ color: 0xe8590c, size: 4, sizeAttenuation: false });
  }

  /**
   * @param {{name: string, content: ArrayBuffer}} scan @param {(storey: number) => boolean} shows
   * @returns {boolean} whether it is one of a sensor that is shown
   */
  put({ name, content }, shows) {
    const points = scanPoints(this.home, name, content);
    if (!points || (points.length && !shows(this.home.storeyAt(points[0][2])))) return false;
    let cloud = this.clouds.get(name);
    if (!cloud) {
      this.clouds.set(name, cloud = new THREE.Points(new THREE.BufferGeometry(), this.material));
      cloud.frustumCulled = false;
      this.group.add(cloud);
    }
    cloud.geometry.dispose();
    cloud.geometry = new THREE.BufferGeometry();
    cloud.geometry.setAttribute('position', new THREE.Float32BufferAttribute(points.flat(), 3));
    return true;
  }

  clear() {
    for (const cloud of this.clouds.values()) cloud.geometry.dispose();
    this.clouds.clear();
    this.group.clear();
  }
}

/**
 * The places that a lidar hit.
 * @param {import('./home.js').Home} home @param {string} name as the page subscribed it @param {ArrayBuffer} content
 * @returns {number[][] | null} x y z each; null where there is no such sensor
 */
export function scanPoints(home, name, content) {
  const sensor = home.scene?.sensors.find((/** @type {any} */ s) => `scan:${s.name}` === name);
  if (!sensor) return null;
  const [first, step] = new Float32Array(content, 0, 2), ranges = new Float32Array(content, 8);
  const at = poseMatrix(home.pose(sensor.link), new THREE.Matrix4()).multiply(poseMatrix(sensor.pose, matrix)), hit = new THREE.Vector3();
  /** @type {number[][]} */
  const points = [];
  ranges.forEach((range, i) => {
    if (!Number.isFinite(range) || range > sensor.range) return;
    const angle = first + i * step;
    points.push(hit.set(range * Math.cos(angle), range * Math.sin(angle), 0).applyMatrix4(at).toArray());
  });
  return points;
}
