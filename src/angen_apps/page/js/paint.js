/** The look of the building: its colors, and the level of detail. */
import * as THREE from '../vendor/three/three.module.min.js';
import { rotate } from './fields.js';
import { poseMatrix } from './shapes.js';

const SENSOR = [0.06, 0.55, 0.50], SMALL = 0.3; // m
const BESIDE = 0.25, OVER = 0.4; // m: beside a wall; over a slab, in the room that has it

/** @type {Record<string, number[]>} */
const FLOORS = { kitchen: [0.86, 0.80, 0.70], bathroom: [0.70, 0.80, 0.84], bedroom: [0.80, 0.68, 0.56], living: [0.78, 0.64, 0.50],
  hall: [0.80, 0.76, 0.70], work: [0.76, 0.68, 0.58], landing: [0.74, 0.73, 0.71], outdoor: [0.60, 0.72, 0.52], other: [0.78, 0.74, 0.68] };

/**
 * Colors of the building; those of furniture and devices are the world's.
 * @param {import('./home.js').Home} home
 * @param {string} cls
 * @param {number[]} color
 * @param {any} link
 * @param {any} shape
 */
export function paint(home, cls, color, link, shape) {
  const way = rotate(link.pose.slice(3), shape.pose);
  const room = cls === 'floor' ? home.roomAt(link.pose[0] + way[0], link.pose[1] + way[1], link.pose[2] + way[2] + OVER) : null;
  if (cls === 'wall') return [0.95, 0.94, 0.92];
  if (cls === 'floor' && room) return FLOORS[room.use] ?? FLOORS.other;
  if (cls === 'ground') return [1, 1, 1];
  if (cls === 'sensor' && Math.max(...shape.size) < SMALL) return SENSOR; // this color marks small shapes above low walls
  return color;
}

/**
 * Whether a side of a box is in no room: a face of a wall or leaf, an edge of a floor.
 * @param {import('./home.js').Home} home
 * @param {any} part of the shapes
 */
export function isOuter(home, part) {
  const box = poseMatrix(home.pose(part.link), new THREE.Matrix4()).multiply(part.local), side = new THREE.Vector3();
  const [width, depth, height] = part.size, axes = height < Math.min(width, depth) ? [0, 1] : [width < depth ? 0 : 1];
  return axes.some((axis) => [1, -1].some((way) => {
    side.set(0, 0, 0).setComponent(axis, way * (0.5 + BESIDE / part.size[axis])).applyMatrix4(box);
    return !home.roomAt(side.x, side.y, side.z + (part.cls === 'floor' ? OVER : 0));
  }));
}

/** Whether the processor draws: then without shadows and smooth edges, unless ?quality=high. */
export function isPlain() {
  const quality = new URLSearchParams(location.search).get('quality');
  if (quality) return quality !== 'high';
  const gl = document.createElement('canvas').getContext('webgl2');
  const info = gl?.getExtension('WEBGL_debug_renderer_info');
  const name = gl && info ? String(gl.getParameter(info.UNMASKED_RENDERER_WEBGL)) : '';
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}
