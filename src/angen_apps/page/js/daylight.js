/** Daylight: where the sun is over a home, by its latitude and clock. */
import * as THREE from '../vendor/three/three.module.min.js';

const STEP = 0.01; // rad of the sun's way, for which the light is set again
const USUAL = [-0.19, -0.41, 0.89]; // from where light comes at night
const DAY = 86400; // s
const J2000 = Date.UTC(2000, 0, 1, 12) / 1000; // s
const CENTURY = 36525 * DAY; // s
const { sin, cos, atan2, PI } = Math, RAD = PI / 180;

/**
 * The sun's declination and the equation of time (rad), as in angen_tools/common/sun.py, which names the source.
 * @param {number} t centuries since 2000-01-01 12:00
 */
function equatorial(t) {
  const mean = 280.46646 + 36000.76983 * t, anomaly = (357.52911 + 35999.05029 * t) * RAD, node = (125.04 - 1934.136 * t) * RAD;
  const center = (1.914602 - 0.004817 * t) * sin(anomaly) + 0.019993 * sin(2 * anomaly) + 0.000289 * sin(3 * anomaly);
  const longitude = (mean + center - 0.00569 - 0.00478 * sin(node)) * RAD, tilt = (23.439291 - 0.0130042 * t + 0.00256 * cos(node)) * RAD;
  const apart = (mean - 0.0057183) * RAD - atan2(cos(tilt) * sin(longitude), cos(longitude));
  return { declination: Math.asin(sin(tilt) * sin(longitude)), equation: atan2(sin(apart), cos(apart)) };
}

/** @param {number} up rad, its true elevation @returns {number} as it appears through the air */
function refracted(up) {
  const degrees = up / RAD;
  return degrees < -1 ? up : up + ((1.02 / 60) * RAD) / Math.tan((degrees + 10.3 / (degrees + 5.11)) * RAD);
}

/**
 * @param {any} described the home's description
 * @param {number} time s since its start
 * @returns {number[] | null} the way to the sun: x y z of length 1; null where the home names no start
 */
export function sunAt(described, time) {
  const found = /^(\d+)-(\d+)-(\d+)T(\d+):(\d+):(\d+)/.exec(described?.start ?? '');
  if (!found) return null;
  const [year, month, day, hour, minute, second] = found.slice(1).map(Number);
  const clock = Date.UTC(year, month - 1, day, hour, minute, second) / 1000 + time;
  const { declination, equation } = equatorial((clock - J2000) / CENTURY), turn = 2 * Math.PI * ((((clock % DAY) + DAY) % DAY) / DAY - 0.5) + equation;
  const latitude = ((described.latitude ?? 48) * Math.PI) / 180, north = described.north ?? Math.PI / 2;
  const up = sin(latitude) * sin(declination) + cos(latitude) * cos(declination) * cos(turn), toEast = -cos(declination) * sin(turn);
  const toNorth = cos(latitude) * sin(declination) - sin(latitude) * cos(declination) * cos(turn);
  const height = refracted(Math.asin(Math.max(-1, Math.min(1, up)))), level = cos(height) / Math.max(1e-9, Math.hypot(toNorth, toEast));
  return [(toNorth * cos(north) + toEast * sin(north)) * level, (toNorth * sin(north) - toEast * cos(north)) * level, sin(height)];
}

export class Sky {
  constructor() {
    this.group = new THREE.Group();
    this.sky = new THREE.HemisphereLight(0xffffff, 0xb9b0a4, 1.5);
    this.sun = new THREE.DirectionalLight(0xffffff, 1.6);
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(2048, 2048);
    this.sun.shadow.bias = -0.0006;
    this.sun.shadow.normalBias = 0.03;
    this.group.add(this.sky, this.sun, this.sun.target);
    /** @type {number[] | null} to the sun, as shown */
    this.way = null;
    this.radius = 10;
  }

  /**
   * At night one still sees the home.
   * @param {import('./home.js').Home} home @param {boolean} dark
   * @returns {any} the color behind the home; null where nothing has changed
   */
  shine(home, dark) {
    const way = sunAt(home.described, home.stats.time), before = this.way;
    if (before && Math.hypot(...(way ?? USUAL).map((x, i) => x - before[i])) < STEP) return null;
    this.way = way ?? USUAL;
    const day = Math.min(1, Math.max(0, (this.way[2] + 0.1) / 0.4)), low = Math.min(1, Math.max(0, 1 - this.way[2] / 0.5));
    const mix = (/** @type {number} */ night, /** @type {number} */ noon, part = day) => new THREE.Color(night).lerp(new THREE.Color(noon), part);
    this.sky.intensity = dark ? 0.6 + 0.3 * day : 1.4 + 0.5 * day;
    this.sky.color.copy(dark ? mix(0xaec4dd, 0xd4deea) : mix(0xc3d0ea, 0xffffff));
    this.sky.groundColor.set(dark ? 0x30363f : 0xd6d2cc);
    this.sun.intensity = dark ? 0.4 + 0.3 * day : 0.5 + 1.2 * day;
    this.sun.color.copy(dark ? mix(0xb9cdf0, 0xf2e6d2) : mix(0xfff6e8, 0xffd9ae, low * day));
    this.aim();
    return dark ? mix(0x0d1218, 0x141c26) : mix(0xcdd5e1, 0xe9edf1);
  }

  /**
   * Shadows fall on the visible floors.
   * @param {any} middle @param {number} radius
   */
  cover(middle, radius) {
    this.radius = radius;
    this.sun.target.position.copy(middle);
    this.aim();
    const { camera } = this.sun.shadow;
    Object.assign(camera, { left: -radius, right: radius, top: radius, bottom: -radius, near: 0.1, far: 4 * radius });
    camera.updateProjectionMatrix();
  }

  /** From the direction of the sun, or high enough to light rooms. */
  aim() {
    const [x, y, z] = this.way && this.way[2] > 0.1 ? this.way : USUAL;
    this.sun.position.copy(this.sun.target.position).addScaledVector(new THREE.Vector3(x, y, Math.max(z, 0.6)).normalize(), 1.8 * this.radius);
  }
}
