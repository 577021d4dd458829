/** Bulbs of lamps, and the fields of sensors on the floor: one draw call each. */
import * as THREE from '../vendor/three/three.module.min.js';
import { fieldShape } from './fields.js';

const matrix = new THREE.Matrix4(), color = new THREE.Color();

export class Bulbs {
  /** @param {import('./home.js').Home} home */
  constructor(home) {
    this.home = home;
    this.group = new THREE.Group();
    /** @type {number[]} */
    this.lights = [];
  }

  build() {
    const { lights } = this.home.scene;
    this.group.clear();
    this.mesh?.dispose();
    this.lights = lights.flatMap((/** @type {any} */ light, /** @type {number} */ i) => (light.sun || !light.model ? [] : [i]));
    this.mesh = new THREE.InstancedMesh(new THREE.SphereGeometry(0.09, 14, 10), new THREE.MeshBasicMaterial(), Math.max(1, this.lights.length));
    this.mesh.count = this.lights.length;
    this.mesh.frustumCulled = false;
    this.mesh.userData.links = this.lights.map((i) => lights[i].link);
    this.group.add(this.mesh);
  }

  /**
   * @param {(light: any) => number[]} placeOf
   * @param {(storey: number) => boolean} shows
   * @param {boolean} dark
   */
  show(placeOf, shows, dark) {
    this.lights.forEach((light, i) => {
      const at = placeOf(this.home.scene.lights[light]), level = this.home.levels.get(light) ?? 0;
      const size = shows(this.home.storeyAt(at[2])) ? (level > 0.003 ? 1 + 0.5 * Math.sqrt(level) : 0.8) : 0;
      this.mesh.setMatrixAt(i, matrix.makeScale(size, size, size).setPosition(at[0], at[1], at[2]));
      this.mesh.setColorAt(i, color.set(level > 0.003 ? 0xffd45e : dark ? 0x46525e : 0xb7bfc7));
    });
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
    /** @type {{key: string, storey: number, first: number, count: number}[]} */
    this.all = [];
    this.state = '';
    /** @type {any} */
    this.shownOf = null;
  }

  build() {
    this.group.clear();
    this.geometry?.dispose();
    this.all = [];
    /** @type {number[]} */
    const positions = [];
    for (const sensor of this.home.scene.sensors) {
      if (this.home.scene.links[sensor.link].moves) continue;
      const points = fieldShape(this.home, sensor), first = positions.length / 3;
      for (let i = 1; i + 1 < points.length; i++) { // a fan, seen from its first corner
        for (const [x, y, z] of [points[0], points[i], points[i + 1]]) positions.push(x, y, z + 0.03);
      }
      this.all.push({ key: `${sensor.kind}/${sensor.name}`, storey: this.home.storeyAt(points[0][2] + 0.1), first, count: positions.length / 3 - first });
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
    this.state = state;
    this.shownOf = this.geometry;
    /** @type {number[]} */
    const index = [];
    const colors = this.geometry.getAttribute('color');
    this.all.forEach(({ first, count }, i) => {
      if (!shown[i]) return;
      color.set(shown[i] === 2 ? 0xe5484d : 0x0f9f8f);
      for (let v = first; v < first + count; v++) {
        index.push(v);
        colors.setXYZW(v, color.r, color.g, color.b, shown[i] === 2 ? 0.34 : 0.13);
      }
    });
    this.geometry.setIndex(index);
    colors.needsUpdate = true;
    return true;
  }
}
