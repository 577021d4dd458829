/** The shapes of a scene as instanced meshes: one draw call for all boxes of a class. */
import * as THREE from '../vendor/three/three.module.min.js';

/** @param {string} text base64 */
export const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer;
const BOX = 0, CYLINDER = 2; // types of shapes; above the latter: meshes
export const CUT = 1.15; // m over the floor, where walls are cut
const FINE = 1e-5, COARSE = 0.035; // m: corners of a mesh that are nearer are one; coarse where the processor draws
const MOST = 20000, COARSER = 1.5, COARSEST = 0.2; // triangles of all copies of a mesh there, above which it gets coarser
const scratch = new THREE.Matrix4(), moved = new THREE.Matrix4(), place = new THREE.Vector3(), turn = new THREE.Quaternion(), size = new THREE.Vector3();

/** @param {ArrayLike<number>} p x y z and quaternion @param {any} into a Matrix4 */
export function poseMatrix(p, into) {
  return into.compose(place.set(p[0], p[1], p[2]), turn.set(p[3], p[4], p[5], p[6]), size.set(1, 1, 1));
}

/** @param {string} group @returns {string} */
export function classOf(group) {
  for (const name of ['wall', 'floor', 'ceiling', 'ground', 'sensor', 'window']) if (group.startsWith(name)) return name;
  return 'thing';
}

/** @param {string} group @returns {number | null} */
function storeyOf(group) {
  const found = / (-?\d+)$/.exec(group);
  return found ? Number(found[1]) : null;
}

/**
 * As fine as the processor draws that many in time.
 * @param {any} mesh @param {number} copies
 */
function plainGeometry(mesh, copies) {
  let cell = COARSE, geometry = meshGeometry(mesh, cell);
  while (copies * geometry.getIndex().count > 3 * MOST && cell < COARSEST) {
    const before = geometry;
    geometry = meshGeometry(mesh, cell *= COARSER);
    if (!geometry.getIndex().count) return before; // nothing would be left
  }
  return geometry;
}

/**
 * With each corner once, which is then computed once.
 * @param {any} mesh of the scene: arrays in base64 @param {number} cell m: corners in one become one
 */
function meshGeometry(mesh, cell) {
  const all = new Float32Array(bytes(mesh.vertices)), triangles = new Uint32Array(bytes(mesh.triangles));
  /** @type {Map<string, number>} */
  const known = new Map();
  /** @type {number[]} */
  const corners = [];
  const welded = triangles.map((vertex) => {
    const corner = Array.from(all.subarray(3 * vertex, 3 * vertex + 3)), key = corner.map((x) => Math.round(x / cell)).join();
    let at = known.get(key);
    if (at === undefined) {
      known.set(key, at = known.size);
      corners.push(...corner);
    }
    return at;
  });
  /** @type {number[]} */
  const index = [];
  for (let i = 0; i + 2 < welded.length; i += 3) {
    const [a, b, c] = welded.subarray(i, i + 3);
    if (a !== b && b !== c && c !== a) index.push(a, b, c);
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.Float32BufferAttribute(corners, 3));
  geometry.setIndex(index);
  geometry.computeVertexNormals();
  return geometry;
}

/**
 * @param {string} type @param {string} cls
 * @param {boolean} plain few faces, for small shapes and where the processor draws
 */
function geometryOf(type, cls, plain) {
  const few = plain || cls === 'sensor';
  if (type === '0') return cls === 'wall' ? wallGeometry() : new THREE.BoxGeometry(1, 1, 1);
  if (type === '1') return few ? new THREE.SphereGeometry(0.5, 7, 4) : new THREE.SphereGeometry(0.5, 20, 14);
  return new THREE.CylinderGeometry(0.5, 0.5, 1, few ? 8 : 24).rotateX(Math.PI / 2);
}

/** A box whose upper face is darker, as the section of a wall in a drawing. */
function wallGeometry() {
  const geometry = new THREE.BoxGeometry(1, 1, 1);
  const normal = geometry.getAttribute('normal'), colors = new Float32Array(normal.count * 3);
  for (let i = 0; i < normal.count; i++) colors.fill(normal.getZ(i) > 0.5 ? 0.24 : 1, 3 * i, 3 * i + 3);
  geometry.setAttribute('color', new THREE.BufferAttribute(colors, 3));
  return geometry;
}

/**
 * @typedef {{mesh: any, slot: number, color: any, link: number, local: any, type: number, cls: string, storey: number | null,
 *   size: number[], middle: number[], extent: number, moves: boolean, isOuter?: boolean}} Part
 */

export class Shapes {
  /**
   * @param {any} scene as the server sends it
   * @param {Set<string>} replaced models that something else shows
   * @param {(cls: string, color: number[], link: any, shape: any) => number[]} paint
   * @param {boolean} plain
   */
  constructor(scene, replaced, paint, plain) {
    this.plain = plain;
    this.group = new THREE.Group();
    /** @type {any[]} */
    this.meshes = [];
    /** @type {Part[][]} by link */
    this.parts = scene.links.map(() => []);
    this.bounds = new THREE.Box3();
    const geometries = new Map();
    /** @type {Map<string, any[]>} */
    const batches = new Map();
    for (const shape of scene.shapes) {
      const link = scene.links[shape.link];
      if (replaced.has(link.model)) continue;
      const cls = classOf(link.group);
      const glass = cls === 'window' && shape.size[0] * shape.size[1] * shape.size[2] > 0.002;
      const clear = glass || (shape.color[3] < 0.99 && cls !== 'wall');
      const key = `${shape.type}|${shape.type > CYLINDER ? shape.mesh : ''}|${cls}|${clear ? Math.min(glass ? 0.35 : 1, shape.color[3]).toFixed(2) : ''}|${link.moves}`;
      if (!batches.has(key)) batches.set(key, []);
      batches.get(key)?.push(shape);
    }
    for (const [key, shapes] of batches) this.addBatch(scene, key, shapes, geometries, paint);
  }

  /** @param {any} mesh @param {number} copies */
  meshOf(mesh, copies) {
    return this.plain ? plainGeometry(mesh, copies) : meshGeometry(mesh, FINE);
  }

  /** @param {any} scene @param {string} key @param {any[]} shapes @param {Map<string, any>} geometries @param {any} paint */
  addBatch(scene, key, shapes, geometries, paint) {
    const [type, mesh, cls, clear] = key.split('|');
    const isMesh = Number(type) > CYLINDER, isWall = cls === 'wall' && type === '0';
    const shapeKey = isMesh ? `mesh ${mesh}` : `${type} ${cls}`;
    if (!geometries.has(shapeKey)) geometries.set(shapeKey, isMesh ? this.meshOf(scene.meshes[shapes[0].mesh], shapes.length) : geometryOf(type, cls, this.plain));
    const material = cls === 'ground' ? new THREE.MeshBasicMaterial() : new THREE.MeshLambertMaterial({ vertexColors: isWall, flatShading: isMesh });
    if (clear) Object.assign(material, { transparent: true, opacity: Math.max(0.15, Number(clear)), depthWrite: false });
    const geometry = geometries.get(shapeKey);
    geometry.computeBoundingBox();
    const middle = geometry.boundingBox.getCenter(new THREE.Vector3()).toArray(); // a mesh may be anywhere beside its origin
    const batch = new THREE.InstancedMesh(geometry, material, shapes.length);
    batch.castShadow = !clear && cls !== 'ground' && cls !== 'ceiling';
    batch.receiveShadow = true;
    batch.frustumCulled = false;
    batch.userData = { cls, parts: [] };
    batch.count = 0;
    for (const shape of shapes) {
      const link = scene.links[shape.link];
      const scale = type > '2' ? [1, 1, 1] : shape.size;
      const local = poseMatrix(shape.pose, new THREE.Matrix4()).clone().scale(size.fromArray(scale));
      const [r, g, b] = paint(cls, shape.color, link, shape);
      const part = { mesh: batch, slot: -1, color: new THREE.Color().setRGB(r, g, b, THREE.SRGBColorSpace), link: shape.link, local,
        type: shape.type, cls, storey: storeyOf(link.group), size: scale, middle, extent: type > '2' ? 1 : Math.max(...scale), moves: link.moves };
      this.parts[shape.link].push(part);
      if (cls !== 'ground' && part.extent < 60) this.bounds.expandByPoint(place.fromArray(link.pose));
    }
    this.meshes.push(batch);
    this.group.add(batch);
  }

  /**
   * @param {number} link @param {any} matrix of the link
   * @param {(part: Part, z: number) => number | null} shown the height in the world at which a part with its middle at z is cut;
   *   NaN: hidden, null: whole
   */
  place(link, matrix, shown) {
    for (const part of this.parts[link]) {
      scratch.multiplyMatrices(matrix, part.local);
      const cut = shown(part, place.fromArray(part.middle).applyMatrix4(scratch).z);
      if (cut !== null && (Number.isNaN(cut) || !cutBox(scratch, part, cut))) hide(part);
      else show(part, scratch);
    }
  }

  /** Boxes around instances, for picking. */
  settle() {
    for (const mesh of this.meshes) mesh.boundingSphere = null;
  }

  /**
   * The parts of walls that let light through.
   * @param {boolean} clear
   */
  clearWalls(clear) {
    for (const mesh of this.meshes) {
      if (mesh.userData.cls !== 'wall') continue;
      Object.assign(mesh.material, { transparent: clear, opacity: clear ? 0.16 : 1, depthWrite: !clear });
      mesh.castShadow = !clear;
      mesh.material.needsUpdate = true;
    }
  }

  dispose() {
    for (const mesh of this.meshes) {
      mesh.geometry.dispose();
      mesh.material.dispose();
      mesh.dispose();
    }
  }
}

/**
 * Instances that are seen come first: those that are not cost nothing.
 * @param {Part} part @param {any} matrix
 */
function show(part, matrix) {
  if (part.slot < 0) {
    put(part, part.mesh.count++, matrix);
    return;
  }
  part.mesh.setMatrixAt(part.slot, matrix);
  part.mesh.instanceMatrix.needsUpdate = true;
}

/** @param {Part} part */
function hide(part) {
  const { mesh, slot } = part;
  if (slot < 0) return;
  part.slot = -1;
  const last = mesh.userData.parts[--mesh.count];
  if (last === part) return;
  mesh.getMatrixAt(mesh.count, moved);
  put(last, slot, moved);
}

/** @param {Part} part @param {number} slot @param {any} matrix */
function put(part, slot, matrix) {
  const { mesh, color } = part;
  part.slot = slot;
  mesh.userData.parts[slot] = part;
  mesh.setColorAt(slot, color);
  mesh.setMatrixAt(slot, matrix);
  mesh.instanceColor.needsUpdate = true;
  mesh.instanceMatrix.needsUpdate = true;
}

/**
 * Cuts the part of an upright box above `top`.
 * @param {any} matrix
 * @param {Part} part
 * @param {number} top
 */
function cutBox(matrix, part, top) {
  const e = matrix.elements, z = e[14], height = Math.abs(e[10]);
  const upright = part.type === BOX && Math.abs(e[2]) + Math.abs(e[6]) < 1e-3;
  const low = z - height / 2, high = z + height / 2;
  if (low >= top) return false;
  if (!upright || high <= top) return true;
  e[10] = top - low;
  e[14] = (low + top) / 2;
  return true;
}
