/** A robot's goal, as the 2D Nav Goal of rviz: a press gives the place, a drag the heading; keys move it too. */
import * as THREE from '../vendor/three/three.module.min.js';
import { denied } from './access.js';
import { ARROWS, by, isForOthers, isNarrow } from './dom.js';
import { yawOf } from './fields.js';
import { t } from './lang.js';

export const TURNS = 0.3; // m: a longer drag gives the heading too
const STEP = 0.25, TURN = Math.PI / 12; // m, rad, of a key
const CLICK = 6; // px: a shorter drag of a robot is a click
const ABOVE = 0.03; // m over the floor

export class Goal {
  /** @param {import('./home.js').Home} home @param {any} page */
  constructor(home, page) {
    this.home = home;
    this.page = page;
    /** @type {number[] | null} x y z yaw */
    this.pose = null;
    /** @type {any} whose goal is being chosen */
    this.robot = null;
    /** @type {((point: number[]) => void) | null} who gets a place that is being chosen */
    this.then = null;
    /** @type {number[] | null} the goal before that */
    this.last = null;
    /** @type {{robot: any, id: number, at: number[], from: number[], before: number[] | null, carries: boolean, moved: boolean} | null} */
    this.held = null;
    this.ended = false;
    /** @type {(() => void)[]} */
    this.listeners = [];
    addEventListener('keydown', (e) => this.key(e), true);
    const { view, plan } = page;
    if (view) {
      this.listen(view.element, (x, y) => view.hit(x, y), (x, y, z) => view.viewpoint.ground(x, y, z));
      const arrow = arrowMesh();
      view.scene.add(arrow);
      this.listeners.push(() => {
        arrow.visible = this.pose !== null;
        if (this.pose) arrow.position.set(this.pose[0], this.pose[1], this.pose[2] + ABOVE);
        arrow.rotation.z = this.pose?.[3] ?? 0;
        view.dirty = true;
      });
    }
    this.listen(plan.element, (x, y) => plan.hit(x, y), (x, y) => plan.ground(x, y));
    this.listeners.push(() => plan.showGoal(this.pose));
  }

  /**
   * @param {any} element
   * @param {(x: number, y: number) => any} hit the object at a place of the page
   * @param {(x: number, y: number, z: number) => number[] | null} ground where it hits the height z
   */
  listen(element, hit, ground) {
    const at = (/** @type {string} */ type, /** @type {(e: PointerEvent) => boolean} */ act) => element.addEventListener(type, (/** @type {PointerEvent} */ e) => {
      if (!act(e)) return;
      e.stopPropagation(); // else the view turns
      e.preventDefault();
    }, true);
    at('pointerdown', (e) => {
      this.ended = false;
      if (e.button !== 0 || !e.isPrimary || this.home.status.replay || denied('goal') || !element.contains(e.target)) return false;
      const found = hit(e.clientX, e.clientY), pressed = this.home.entities.find((r) => this.home.isRobot(r) && r.model === found?.model);
      const robot = this.robot ?? pressed;
      if (!found?.point || !robot) return false;
      const floor = this.floorAt(found.point), from = ground(e.clientX, e.clientY, floor);
      if (!from) return false;
      element.setPointerCapture(e.pointerId);
      this.held = { robot, id: e.pointerId, at: [e.clientX, e.clientY], from: [from[0], from[1], floor], before: this.pose, carries: !this.robot, moved: false };
      if (this.robot) this.put([from[0], from[1], floor, this.pose?.[3] ?? 0]);
      return true;
    });
    at('pointermove', (e) => {
      const held = this.held;
      if (held?.id !== e.pointerId) return false;
      held.moved ||= Math.hypot(e.clientX - held.at[0], e.clientY - held.at[1]) >= CLICK;
      const to = ground(e.clientX, e.clientY, held.from[2]);
      if (!to || !held.moved) return true;
      const [x, y, z] = held.from, [dx, dy] = [to[0] - x, to[1] - y], far = Math.hypot(dx, dy) > TURNS, yaw = Math.atan2(dy, dx);
      if (held.carries) this.put([to[0], to[1], z, far ? yaw : 0]);
      else if (far) this.put([x, y, z, yaw]);
      return true;
    });
    at('pointerup', (e) => {
      const held = this.held;
      if (held?.id !== e.pointerId) return false;
      this.held = null;
      this.ended = true; // the click that may follow is a part of this press
      if (held.carries && !held.moved) this.page.show(held.robot);
      else this.send(held.robot);
      return true;
    });
    at('pointercancel', (e) => {
      if (this.held?.id !== e.pointerId) return false;
      this.put(this.held.before);
      this.held = null;
      return true;
    });
    element.addEventListener('click', (/** @type {MouseEvent} */ e) => { if (this.ended) e.stopPropagation(); this.ended = false; }, true);
  }

  /** @param {number[]} point @returns {number} the height of the floor below it */
  floorAt([x, y, z]) {
    const { home } = this, room = home.roomAt(x, y, z) ?? home.roomAt(x, y, z + 0.2);
    return room?.floor ?? home.storeys.find((s) => s.number === home.storeyAt(z))?.elevation ?? 0;
  }

  /** @param {any} robot whose next goal is chosen */
  begin(robot) {
    this.page.stopChoosing();
    this.robot = robot;
    const pose = this.home.place(robot), [x, y, z] = Array.from(pose);
    this.put([x, y, this.floorAt([x, y, z + 0.1]), yawOf(pose)]);
    const keys = isNarrow() ? '' : `. ${t('Keys: arrows move it, with Shift they turn it, Enter sends it, Esc ends')}`;
    by('hint').textContent = `${t('Goal of {name}: press on the floor and drag', { name: robot.name })}${keys}`;
    by('hint').hidden = false;
  }

  end() {
    if (this.robot) by('hint').hidden = true;
    this.robot = null;
  }

  /**
   * The arrow as the mark of a place, which keys move.
   * @param {number[]} from x y z @param {(point: number[]) => void} then
   */
  mark(from, then) {
    this.unmark();
    this.end();
    this.last = this.pose;
    this.then = then;
    this.put([from[0], from[1], this.floorAt([from[0], from[1], from[2] + 0.1]), 0]);
  }

  unmark() {
    if (!this.then) return;
    this.then = null;
    this.put(this.last);
  }

  /** @param {number[] | null} pose */
  put(pose) {
    this.pose = pose;
    for (const listener of this.listeners) listener();
  }

  /** @param {any} robot */
  async send(robot) {
    this.end();
    if (!this.pose) return;
    const [x, y, z, yaw] = this.pose, floor = this.home.storeyAt(z);
    const answer = await this.home.order({ do: 'goal', name: robot.name, x, y, floor, yaw: Math.atan2(Math.sin(yaw), Math.cos(yaw)) });
    if (answer.ok) this.page.show(robot);
    else this.put(null);
  }

  /** @param {KeyboardEvent} e */
  key(e) {
    if (!(this.robot || this.then) || !this.pose || isForOthers(e)) return;
    const [x, y, z, yaw] = this.pose, way = ARROWS[e.key];
    if (way && e.shiftKey) this.put([x, y, z, yaw - (way[0] - way[1]) * TURN]);
    else if (way) {
      const ahead = this.page.plan.hidden ? this.page.view.viewpoint.quarter() : 0, [c, s] = [Math.cos(ahead), Math.sin(ahead)];
      this.put([x + STEP * (c * way[0] - s * way[1]), y + STEP * (s * way[0] + c * way[1]), z, yaw]);
    } else if (e.key === 'Enter') (this.then ?? (() => this.send(this.robot)))(this.pose);
    else if (e.key === 'Escape' && this.robot) { this.end(); this.put(null); }
    else return;
    e.preventDefault();
    e.stopPropagation();
  }
}

/** @returns {any} an arrow along x, on a disk */
function arrowMesh() {
  const shape = new THREE.Shape();
  shape.moveTo(0.75, 0).lineTo(0.35, 0.32).lineTo(0.35, 0.1).lineTo(0, 0.1).lineTo(0, -0.1).lineTo(0.35, -0.1).lineTo(0.35, -0.32);
  const material = new THREE.MeshBasicMaterial({ color: '#7c3aed', depthTest: false, side: THREE.DoubleSide, transparent: true, opacity: 0.9 });
  const group = new THREE.Group();
  group.add(new THREE.Mesh(new THREE.ShapeGeometry(shape), material), new THREE.Mesh(new THREE.RingGeometry(0.2, 0.27, 32), material));
  for (const mesh of group.children) mesh.renderOrder = 10;
  group.visible = false;
  return group;
}
