/** The floor that a sensor's rays reach: its fan, or the floor below it, within its room. */

/**
 * @param {import('./home.js').Home} home @param {any} sensor of the scene
 * @returns {number[][]} a polygon x y z on the floor
 */
export function fieldShape(home, sensor) {
  const link = home.pose(sensor.link);
  const at = add(link, rotate(quaternion(link), sensor.pose));
  const q = multiply(quaternion(link), quaternion(sensor.pose));
  const room = home.roomAt(at[0], at[1], at[2]);
  const floor = room ? room.floor : Math.max(0, at[2] - 2);
  const [min, max] = sensor.yaw, [low, high] = sensor.pitch;
  const steps = Math.min(24, Math.max(1, Math.ceil((max - min) / 0.12)));
  const ahead = rotate(q, [1, 0, 0]);
  const down = Math.asin(Math.max(-1, Math.min(1, -ahead[2])));
  /** @type {number[][]} */
  const points = [];
  if (down > 1) { // from the ceiling
    const radius = Math.max(0.3, (at[2] - floor) * Math.tan(Math.min(1.3, Math.max(max - min, high - low) / 2)));
    for (let i = 0; i < 24; i++) {
      const a = (i / 24) * 2 * Math.PI;
      points.push([at[0] + radius * Math.cos(a), at[1] + radius * Math.sin(a), floor]);
    }
    return points;
  }
  const width = max - min < 0.02 ? 0.02 : 0; // a beam
  points.push([at[0], at[1], floor]);
  for (let i = 0; i <= steps; i++) {
    const yaw = min - width + ((max - min + 2 * width) * i) / steps;
    const way = rotate(q, [Math.cos(yaw), Math.sin(yaw), 0]);
    const flat = Math.hypot(way[0], way[1]) || 1;
    const range = Math.min(sensor.range, room ? reach(room.polygon, at, [way[0] / flat, way[1] / flat]) : sensor.range);
    points.push([at[0] + (range * way[0]) / flat, at[1] + (range * way[1]) / flat, floor]);
  }
  return points;
}

/**
 * The length of a ray within a polygon.
 * @param {number[][]} polygon
 * @param {number[]} at
 * @param {number[]} way
 */
export function reach(polygon, at, way) {
  let nearest = Infinity;
  polygon.forEach(([x0, y0], i) => {
    const [x1, y1] = polygon[(i + 1) % polygon.length], [ex, ey] = [x1 - x0, y1 - y0];
    const det = way[0] * -ey + ex * way[1];
    if (Math.abs(det) < 1e-9) return;
    const [dx, dy] = [x0 - at[0], y0 - at[1]];
    const t = (dx * -ey + ex * dy) / det, s = (way[0] * dy - way[1] * dx) / det;
    if (t > 0.12 && s >= -1e-6 && s <= 1 + 1e-6) nearest = Math.min(nearest, t);
  });
  return nearest;
}

/** @param {ArrayLike<number>} pose */
const quaternion = (pose) => [pose[3], pose[4], pose[5], pose[6]];
/** @param {ArrayLike<number>} a @param {number[]} b */
const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];

/** @param {ArrayLike<number>} pose x y z and quaternion @returns {number} its heading in rad */
export function yawOf(pose) {
  const [x, y, z, w] = quaternion(pose);
  return Math.atan2(2 * (w * z + x * y), 1 - 2 * (y ** 2 + z ** 2));
}

/** @param {number[]} q @param {ArrayLike<number>} v @returns {number[]} */
export function rotate([x, y, z, w], v) {
  const t = [2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])];
  return [v[0] + w * t[0] + y * t[2] - z * t[1], v[1] + w * t[1] + z * t[0] - x * t[2], v[2] + w * t[2] + x * t[1] - y * t[0]];
}

/** @param {number[]} a @param {number[]} b @returns {number[]} */
function multiply([x, y, z, w], [u, v, s, t]) {
  return [w * u + x * t + y * s - z * v, w * v - x * s + y * t + z * u, w * s + x * v - y * u + z * t, w * t - x * u - y * v - z * s];
}
