/** A person as a jointed figure that walks, sits and lies. */
import * as THREE from '../vendor/three/three.module.min.js';

const SHIRTS = [0x0f766e, 0x7c3aed, 0xb45309, 0x2563eb, 0xbe185d, 0x4d7c0f];
const STRIDE = 1.4; // m of two steps

/** @param {number} radius @param {number} length @param {any} material */
function limb(radius, length, material) {
  const pivot = new THREE.Group();
  const mesh = new THREE.Mesh(new THREE.CapsuleGeometry(radius, length - 2 * radius, 4, 10).rotateX(Math.PI / 2), material);
  mesh.position.z = -length / 2;
  mesh.castShadow = true;
  pivot.add(mesh);
  return pivot;
}

export class Figure {
  /** @param {number} number of the person @param {number} height m */
  constructor(number, height) {
    const shirt = new THREE.MeshLambertMaterial({ color: SHIRTS[number % SHIRTS.length] });
    const trousers = new THREE.MeshLambertMaterial({ color: 0x334155 });
    const skin = new THREE.MeshLambertMaterial({ color: 0xd8a17c });
    this.height = height;
    this.group = new THREE.Group();
    this.body = new THREE.Group();
    this.group.add(this.body);
    this.body.scale.setScalar(height / 1.75);
    this.hips = new THREE.Group();
    this.hips.position.z = 0.9;
    this.body.add(this.hips);
    const torso = new THREE.Mesh(new THREE.CapsuleGeometry(0.17, 0.3, 6, 14).rotateX(Math.PI / 2).scale(0.72, 1.12, 1), shirt);
    torso.position.z = 0.29;
    const head = new THREE.Mesh(new THREE.SphereGeometry(0.115, 18, 14), skin);
    head.position.z = 0.73;
    const hair = new THREE.Mesh(new THREE.SphereGeometry(0.122, 18, 10, 0, 2 * Math.PI, 0, 1.5).rotateX(Math.PI / 2), trousers);
    hair.position.set(-0.015, 0, 0.735);
    for (const part of [torso, head, hair]) part.castShadow = true;
    this.hips.add(torso, head, hair);
    this.thighs = [-1, 1].map((side) => this.add(limb(0.085, 0.46, trousers), 0, side * 0.09, 0));
    this.shanks = this.thighs.map((thigh) => this.add(limb(0.07, 0.46, trousers), 0, 0, -0.44, thigh));
    this.arms = [-1, 1].map((side) => this.add(limb(0.055, 0.33, shirt), 0, side * 0.235, 0.5));
    this.hands = this.arms.map((arm) => this.add(limb(0.048, 0.3, skin), 0, 0, -0.3, arm));
    this.phase = 0;
    this.speed = 0;
    this.posture = 'stand';
  }

  /** @param {any} part @param {number} x @param {number} y @param {number} z @param {any} [to] */
  add(part, x, y, z, to = this.hips) {
    part.position.set(x, y, z);
    to.add(part);
    return part;
  }

  /** @param {number} dt s; returns whether it moves */
  animate(dt) {
    const walks = this.posture === 'stand' && this.speed > 0.05;
    this.phase += walks ? (2 * Math.PI * this.speed * dt) / STRIDE : 0;
    const swing = walks ? Math.min(0.65, 0.25 + 0.35 * this.speed) * Math.sin(this.phase) : 0;
    const sits = this.posture === 'sit';
    this.thighs.forEach((thigh, i) => {
      const side = i ? -1 : 1;
      thigh.rotation.y = sits ? -1.5 : -side * swing;
      this.shanks[i].rotation.y = sits ? 1.5 : walks ? 0.15 + 0.5 * Math.max(0, side * Math.cos(this.phase)) : 0;
      this.arms[i].rotation.y = sits ? -0.5 : side * swing;
      this.hands[i].rotation.y = sits ? -0.7 : -0.25;
    });
    this.hips.position.z = sits ? 0.5 : 0.9 + (walks ? 0.02 * Math.cos(2 * this.phase) : 0);
    this.body.rotation.y = this.posture === 'lie' ? -Math.PI / 2 : 0;
    this.body.position.set(this.posture === 'lie' ? 0.85 : 0, 0, this.posture === 'lie' ? 0.55 : 0);
    return walks;
  }
}
