/** The robot's map: the floor that it is on, its lidar's scan, and a goal that one drags. */
import { denied } from './access.js';
import { el } from './dom.js';
import { yawOf } from './fields.js';
import { TURNS } from './goal.js';
import { t } from './lang.js';
import { scanPoints } from './overlays.js';

const SPAN = 9; // m that the map shows across

export class RobotMap {
  /** @param {import('./home.js').Home} home @param {import('./goal.js').Goal} goal */
  constructor(home, goal) {
    this.home = home;
    this.goal = goal;
    this.span = SPAN;
    /** @type {any} */
    this.robot = null;
    /** @type {number[][]} */
    this.scan = [];
    /** @type {any} */
    this.waiting = undefined;
    this.canvas = el('canvas', { class: 'map', role: 'img', 'aria-label': t('Map around the robot, with its scan. Drag to set a goal: place and direction.') });
    home.on('poses', () => this.later());
    goal.listeners.push(() => this.later());
    home.on('scan', ({ name, content }) => {
      if (name !== this.topic) return;
      this.scan = scanPoints(home, name, content) ?? [];
      this.later();
    });
    const canvas = this.canvas;
    canvas.addEventListener('pointerdown', (/** @type {PointerEvent} */ e) => {
      if (home.status.replay || denied('goal')) return;
      canvas.setPointerCapture(e.pointerId);
      goal.put([...this.at(e), home.place(this.robot)[2], 0]);
    });
    canvas.addEventListener('pointermove', (/** @type {PointerEvent} */ e) => {
      if (!goal.pose || !canvas.hasPointerCapture(e.pointerId)) return;
      const [x, y, z] = goal.pose, to = this.at(e), [dx, dy] = [to[0] - x, to[1] - y];
      if (Math.hypot(dx, dy) > TURNS) goal.put([x, y, z, Math.atan2(dy, dx)]);
    });
    canvas.addEventListener('pointerup', (/** @type {PointerEvent} */ e) => { if (canvas.hasPointerCapture(e.pointerId)) goal.send(this.robot); });
    canvas.addEventListener('wheel', (/** @type {WheelEvent} */ e) => {
      e.preventDefault();
      this.span = Math.min(40, Math.max(3, this.span * Math.exp(0.001 * e.deltaY)));
      this.later();
    }, { passive: false });
  }

  /** @param {any} robot @param {string} topic of its scan */
  show(robot, topic) {
    if (robot !== this.robot) { this.scan = []; }
    this.robot = robot;
    this.topic = topic;
    this.later();
    return this.canvas;
  }

  /** @param {PointerEvent} e @returns {number[]} */
  at(e) {
    const box = this.canvas.getBoundingClientRect(), [x, y] = Array.from(this.home.place(this.robot)), scale = this.span / box.width;
    return [x + (e.clientX - box.left - box.width / 2) * scale, y - (e.clientY - box.top - box.height / 2) * scale];
  }

  later() {
    if (this.waiting !== undefined || !this.robot) return;
    this.waiting = setTimeout(() => { this.waiting = undefined; this.draw(); }, 100);
  }

  draw() {
    const { canvas, home } = this, width = canvas.clientWidth, height = canvas.clientHeight;
    if (!width || !home.scene) return;
    const sharp = Math.min(2, devicePixelRatio), context = canvas.getContext('2d'), style = getComputedStyle(document.documentElement);
    const ink = (/** @type {string} */ name) => style.getPropertyValue(name);
    if (canvas.width !== width * sharp) { canvas.width = width * sharp; canvas.height = height * sharp; }
    const pose = home.place(this.robot), scale = (width / this.span) * sharp, storey = home.storeyAt(pose[2] + 0.2);
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.fillStyle = ink('--bg');
    context.fillRect(0, 0, canvas.width, canvas.height);
    context.setTransform(scale, 0, 0, -scale, canvas.width / 2 - scale * pose[0], canvas.height / 2 + scale * pose[1]);
    context.lineWidth = 0.12;
    context.strokeStyle = ink('--wall');
    context.fillStyle = ink('--room');
    for (const room of home.rooms) {
      if (room.storey !== storey) continue;
      context.beginPath();
      for (const ring of [room.polygon, ...(room.holes ?? [])]) {
        ring.forEach(([x, y], i) => (i ? context.lineTo(x, y) : context.moveTo(x, y)));
        context.closePath();
      }
      context.fill('evenodd');
      context.stroke();
    }
    context.strokeStyle = ink('--room');
    context.lineWidth = 0.16;
    for (const door of home.described?.doors ?? []) {
      const [x, y, z, yaw] = door.pose, half = door.width / 2;
      if (door.kind !== 'window' && home.storeyAt(z + 0.2) === storey) line(context, x - half * Math.cos(yaw), y - half * Math.sin(yaw), x + half * Math.cos(yaw), y + half * Math.sin(yaw));
    }
    context.fillStyle = '#e8590c';
    for (const [x, y] of this.scan) context.fillRect(x - 0.025, y - 0.025, 0.05, 0.05);
    const yaw = yawOf(pose);
    arrow(context, pose[0], pose[1], yaw, 0.2, ink('--robot'));
    const at = this.goal.pose;
    if (at) arrow(context, at[0], at[1], at[3], 0.26, ink('--accent'));
  }
}

/** @param {any} context @param {number} x0 @param {number} y0 @param {number} x1 @param {number} y1 */
function line(context, x0, y0, x1, y1) {
  context.beginPath();
  context.moveTo(x0, y0);
  context.lineTo(x1, y1);
  context.stroke();
}

/** @param {any} context @param {number} x @param {number} y @param {number} yaw @param {number} size @param {string} color */
function arrow(context, x, y, yaw, size, color) {
  context.save();
  context.translate(x, y);
  context.rotate(yaw);
  context.fillStyle = color;
  context.beginPath();
  context.arc(0, 0, size * 0.75, 0, 2 * Math.PI);
  context.fill();
  context.beginPath();
  context.moveTo(size * 1.6, 0);
  context.lineTo(size * 0.6, size * 0.6);
  context.lineTo(size * 0.6, -size * 0.6);
  context.fill();
  context.restore();
}
