/** Which lamps light which room, and how bright its sensor says that it is. */
import * as THREE from '../vendor/three/three.module.min.js';
import { poseMatrix } from './shapes.js';

const matrix = new THREE.Matrix4();

export class RoomLights {
  /** @param {import('./home.js').Home} home @param {import('./glow.js').Glows} glows */
  constructor(home, glows) {
    this.home = home;
    this.glows = glows;
    /** @type {Map<string, import('./home.js').Entity>} the first luminosity sensor of each room */
    this.luxOf = new Map();
    /** @type {Map<string, string>} the room of each of these */
    this.roomOf = new Map();
    /** @type {(string | null | undefined)[]} rooms of lights; undefined: of one that moves */
    this.rooms = [];
    this.luxField = 0;
  }

  build() {
    const { home } = this;
    this.glows.build(home.rooms);
    this.luxOf.clear();
    this.roomOf.clear();
    for (const e of home.entities) {
      const room = e.kind === 'luminosity' ? home.roomsOf(e)[0] : null;
      if (!room || this.luxOf.has(room.name)) continue;
      this.luxOf.set(room.name, e);
      this.roomOf.set(e.name, room.name);
    }
    this.luxField = Math.max(0, home.fields('luminosity').findIndex((field) => field.name === 'illuminance'));
    this.rooms = home.scene.lights.map((/** @type {any} */ light) => (light.link >= 0 && home.scene.links[light.link].moves ? undefined : this.roomAt(light)));
  }

  /** @param {any} light @returns {string | null} */
  roomAt(light) {
    const at = this.place(light);
    return this.home.roomAt(at[0], at[1], at[2])?.name ?? null;
  }

  /** @param {any} light @returns {number[]} */
  place(light) {
    const own = new THREE.Vector3().fromArray(light.pose);
    return (light.link < 0 ? own : own.applyMatrix4(poseMatrix(this.home.pose(light.link), matrix))).toArray();
  }

  /** @param {boolean} dark */
  light(dark) {
    const { home } = this;
    /** @type {Map<string, any[]>} */
    const lamps = new Map();
    home.scene.lights.forEach((/** @type {any} */ light, /** @type {number} */ i) => {
      const level = home.levels.get(i) ?? 0;
      if (light.sun || !level) return;
      const room = this.rooms[i] === undefined ? this.roomAt(light) : this.rooms[i];
      const most = Math.max(...light.color.slice(0, 3), 0.01), color = light.color.slice(0, 3).map((/** @type {number} */ c) => c / most);
      if (room) lamps.set(room, [...(lamps.get(room) ?? []), { at: this.place(light), color, level }]);
    });
    for (const room of home.rooms) this.glows.light(room.name, lamps.get(room.name) ?? [], this.lux(room), dark);
  }

  /**
   * Lit rooms whose brightness changed to the eye, after readings came.
   * @param {any[]} rows @param {boolean} dark
   * @returns {boolean} whether there are any
   */
  follow(rows, dark) {
    let changed = false;
    for (const row of rows) {
      const room = row.kind === 'luminosity' ? this.roomOf.get(row.name) : undefined;
      if (room !== undefined && this.glows.tone(room, this.lux({ name: room }), dark)) changed = true;
    }
    return changed;
  }

  /** @param {{name: string}} room @returns {number | null} */
  lux(room) {
    const sensor = this.luxOf.get(room.name);
    return (sensor && this.home.row(sensor)?.values[this.luxField]) ?? null;
  }
}
