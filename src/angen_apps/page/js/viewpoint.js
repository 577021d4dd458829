/** The viewpoint: the camera, its motion by the mouse, and its glide to a selection. */
import * as THREE from '../vendor/three/three.module.min.js';
import { OrbitControls } from '../vendor/three/OrbitControls.js';

const GLIDE = 7; // 1/s
const MARGIN = 0.9; // of the view: buttons are at its edges
const BUTTONS = 20; // px by which the home is higher: most of them are below

export class Viewpoint {
  /** @param {any} element that has the focus @param {any} canvas @param {() => void} changed */
  constructor(element, canvas, changed) {
    this.element = element;
    this.camera = new THREE.PerspectiveCamera(38, 1, 0.1, 600);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.maxPolarAngle = 1.5;
    this.controls.zoomToCursor = true;
    this.controls.addEventListener('start', () => { this.goal = null; });
    this.controls.addEventListener('change', changed);
    this.controls.listenToKeyEvents(element);
    this.changed = changed;
    /** @type {{at: any, target: any} | null} */
    this.goal = null;
    this.looked = false;
  }

  /**
   * Moves so that a box is seen whole.
   * @param {any} box
   * @param {any} way from its middle to the camera
   */
  look(box, way) {
    const middle = box.getCenter(new THREE.Vector3());
    way.normalize();
    this.goal = { at: middle.clone().addScaledVector(way, this.distance(box, middle, way)), target: middle };
    if (!this.looked || matchMedia('(prefers-reduced-motion: reduce)').matches) { this.glide(100); this.looked = true; }
    this.changed();
  }

  /**
   * The viewpoint from which a box fills the view.
   * @param {any} box
   * @param {any} middle
   * @param {any} way from the middle to the camera, of length 1
   */
  distance(box, middle, way) {
    const tall = MARGIN * Math.tan((this.camera.fov * Math.PI) / 360), wide = tall * this.camera.aspect;
    const right = new THREE.Vector3(-way.y, way.x, 0).normalize(), up = new THREE.Vector3().crossVectors(way, right), corner = new THREE.Vector3();
    let most = 1;
    for (let i = 0; i < 8; i++) {
      corner.set(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z).sub(middle);
      most = Math.max(most, corner.dot(way) + Math.max(Math.abs(corner.dot(right)) / wide, Math.abs(corner.dot(up)) / tall));
    }
    return most;
  }

  /** @param {number} dt s */
  glide(dt) {
    if (!this.goal) return;
    const part = 1 - Math.exp(-GLIDE * dt);
    this.camera.position.lerp(this.goal.at, part);
    this.controls.target.lerp(this.goal.target, part);
    this.changed();
    if (this.camera.position.distanceTo(this.goal.at) < 0.02) this.goal = null;
  }

  /** @param {number} width @param {number} height px */
  resize(width, height) {
    this.camera.aspect = width / height;
    this.camera.setViewOffset(width, height, 0, BUTTONS, width, height);
  }

  /**
   * The place of a point on the screen, in pixels of the page.
   * @param {number[]} at
   * @returns {number[]}
   */
  screen(at) {
    const box = this.element.getBoundingClientRect();
    this.camera.updateMatrixWorld();
    const point = new THREE.Vector3().fromArray(at).project(this.camera);
    return [box.left + ((point.x + 1) / 2) * box.width, box.top + ((1 - point.y) / 2) * box.height];
  }

  /**
   * @param {any} raycaster aimed at a place of the page
   * @param {number} x @param {number} y px
   */
  aim(raycaster, x, y) {
    const box = this.element.getBoundingClientRect();
    this.camera.updateMatrixWorld();
    raycaster.setFromCamera(new THREE.Vector2(((x - box.left) / box.width) * 2 - 1, 1 - ((y - box.top) / box.height) * 2), this.camera);
  }

  /**
   * @param {number} x @param {number} y px @param {number} z m
   * @returns {number[] | null} the visible point of this height at a place of the page
   */
  ground(x, y, z) {
    const raycaster = new THREE.Raycaster();
    this.aim(raycaster, x, y);
    return raycaster.ray.intersectPlane(new THREE.Plane(new THREE.Vector3(0, 0, 1), -z), new THREE.Vector3())?.toArray() ?? null;
  }

  /** @returns {number} the yaw of the way to the right on the screen, as a multiple of 90 degrees */
  quarter() {
    const right = new THREE.Vector3().setFromMatrixColumn(this.camera.matrixWorld, 0);
    return Math.round(Math.atan2(right.y, right.x) / (Math.PI / 2)) * (Math.PI / 2);
  }
}
