/** The light of lamps on the floor and walls of their room, brighter by the illuminance of the room's sensor. */
import * as THREE from '../vendor/three/three.module.min.js';
import { CUT } from './shapes.js';

const MOST = 6; // lamps of a room
const SEEN = 0.01; // of the strength of light
const VERTEX = `
varying vec3 at; varying vec3 facing;
void main() { at = position; facing = normal; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }`;
const FRAGMENT = `
uniform vec4 lamps[${MOST}]; uniform vec3 colors[${MOST}]; uniform float strength;
varying vec3 at; varying vec3 facing;
void main() {
  vec3 sum = vec3(0.0);
  for (int i = 0; i < ${MOST}; i++) {
    vec3 way = lamps[i].xyz - at;
    float square = dot(way, way);
    sum += colors[i] * lamps[i].w * (0.25 + 0.75 * max(0.0, dot(normalize(way), facing))) * 4.2 / (2.4 + square);
  }
  float most = max(max(sum.r, sum.g), max(sum.b, 0.001));
  gl_FragColor = vec4(sum / most, clamp(most * strength, 0.0, 0.85));
}`;

/** @param {number[][]} polygon @returns {number} twice its area, positive counterclockwise */
const signed = (polygon) => polygon.reduce((sum, [x, y], i) => {
  const [u, v] = polygon[(i + 1) % polygon.length];
  return sum + x * v - u * y;
}, 0);

/**
 * Floor and low walls of a room, just before the real ones.
 * @param {any} room
 */
function skin(room) {
  /** @type {number[][]} */
  const polygon = signed(room.polygon) < 0 ? [...room.polygon].reverse() : room.polygon;
  const shape = new THREE.Shape(polygon.map(([x, y]) => new THREE.Vector2(x, y)));
  for (const hole of room.holes ?? []) {
    shape.holes.push(new THREE.Path(hole.map((/** @type {number[]} */ p) => new THREE.Vector2(p[0], p[1]))));
  }
  const flat = new THREE.ShapeGeometry(shape);
  const positions = [], normals = [], z = room.floor + 0.012;
  const corners = flat.getAttribute('position'), index = flat.getIndex();
  for (let i = 0; i < index.count; i++) {
    positions.push(corners.getX(index.getX(i)), corners.getY(index.getX(i)), z);
    normals.push(0, 0, 1);
  }
  polygon.forEach(([x0, y0], i) => {
    const [x1, y1] = polygon[(i + 1) % polygon.length], length = Math.hypot(x1 - x0, y1 - y0) || 1;
    const n = [-(y1 - y0) / length, (x1 - x0) / length, 0], d = 0.08; // to the inside, before the wall's face
    const [a, b, c, e] = [x0 + d * n[0], y0 + d * n[1], x1 + d * n[0], y1 + d * n[1]], top = room.floor + CUT - 0.01;
    positions.push(a, b, z, c, e, z, c, e, top, a, b, z, c, e, top, a, b, top);
    for (let k = 0; k < 6; k++) normals.push(...n);
  });
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.Float32BufferAttribute(positions, 3));
  geometry.setAttribute('normal', new THREE.Float32BufferAttribute(normals, 3));
  return geometry;
}

export class Glows {
  constructor() {
    this.group = new THREE.Group();
    /** @type {Map<string, any>} by room */
    this.meshes = new Map();
  }

  /** @param {any[]} rooms */
  build(rooms) {
    for (const mesh of this.meshes.values()) { mesh.geometry.dispose(); mesh.material.dispose(); }
    this.meshes.clear();
    this.group.clear();
    for (const room of rooms) {
      const material = new THREE.ShaderMaterial({
        vertexShader: VERTEX, fragmentShader: FRAGMENT, transparent: true, depthWrite: false, side: THREE.DoubleSide,
        polygonOffset: true, polygonOffsetFactor: -2, polygonOffsetUnits: -4,
        uniforms: { lamps: { value: Array.from({ length: MOST }, () => new THREE.Vector4()) }, strength: { value: 0 },
          colors: { value: Array.from({ length: MOST }, () => new THREE.Vector3()) } },
      });
      const mesh = new THREE.Mesh(skin(room), material);
      mesh.visible = false;
      mesh.renderOrder = 2;
      mesh.userData.storey = room.storey;
      this.meshes.set(room.name, mesh);
      this.group.add(mesh);
    }
  }

  /**
   * @param {string} room @param {{at: number[], color: number[], level: number}[]} lamps
   * @param {number | null} lux as the room's sensor measures it @param {boolean} dark
   */
  light(room, lamps, lux, dark) {
    const mesh = this.meshes.get(room);
    if (!mesh) return;
    const lit = lamps.filter((lamp) => lamp.level > 0.003).slice(0, MOST);
    mesh.userData.lit = lit.length > 0;
    const { uniforms } = mesh.material;
    uniforms.lamps.value.forEach((/** @type {any} */ at, /** @type {number} */ i) => {
      const lamp = lit[i];
      if (!lamp) { at.set(0, 0, 0, 0); return; }
      at.set(lamp.at[0], lamp.at[1], lamp.at[2], Math.sqrt(lamp.level));
      uniforms.colors.value[i].set(lamp.color[0], 0.84 * lamp.color[1], 0.5 * lamp.color[2]);
    });
    this.tone(room, lux, dark);
    mesh.material.blending = dark ? THREE.AdditiveBlending : THREE.NormalBlending;
  }

  /**
   * @param {string} room @param {number | null} lux @param {boolean} dark
   * @returns {boolean} whether one sees it
   */
  tone(room, lux, dark) {
    const mesh = this.meshes.get(room);
    if (!mesh) return false;
    const { strength } = mesh.material.uniforms, tone = lux === null ? 0.8 : Math.min(1.1, 0.35 + 0.3 * Math.log10(1 + lux));
    const value = tone * (dark ? 0.75 : 0.8), seen = Boolean(mesh.userData.lit) && Math.abs(value - strength.value) > SEEN;
    if (seen || !mesh.userData.lit) strength.value = value;
    return seen;
  }

  /** @param {(storey: number) => boolean} shows */
  show(shows) {
    for (const mesh of this.meshes.values()) mesh.visible = Boolean(mesh.userData.lit) && shows(mesh.userData.storey);
  }
}
