/** Robots: drive by keys or a stick, the camera's picture, a goal. */
import { denied } from './access.js';
import { el, isForOthers } from './dom.js';
import { thingRow, trip } from './card.js';
import { t } from './lang.js';
import { RobotMap } from './robotmap.js';

const SPEED = 0.35, TURN = 1.4; // m/s, rad/s, at the end of the stick
const PERIOD = 100; // ms between orders while it is driven
/** @type {Record<string, number[]>} */
const KEYS = { w: [1, 0], s: [-1, 0], a: [0, 1], d: [0, -1] };

export class RobotPanel {
  /** @param {import('./home.js').Home} home @param {any} page */
  constructor(home, page) {
    this.home = home;
    this.page = page;
    this.name = '';
    this.speed = 0;
    this.turn = 0;
    /** @type {Set<string>} */
    this.keys = new Set();
    this.camera = false;
    this.map = new RobotMap(home, page.goal);
    home.on('trips', () => page.refreshThings());
    home.on('picture', ({ name, content }) => this.onPicture(name, content));
    addEventListener('keydown', (e) => this.key(e, true));
    addEventListener('keyup', (e) => this.key(e, false));
    addEventListener('blur', () => { this.keys.clear(); this.steer(0, 0); });
  }

  robots() {
    return this.home.entities.filter((e) => this.home.isRobot(e));
  }

  robot() {
    const all = this.robots();
    return all.find((e) => e.name === this.name) ?? all[0];
  }

  build() {
    const { home } = this, robot = this.robot();
    this.active = true;
    if (!robot) return [el('p', { class: 'soft' }, t('This world has no robot.'))];
    this.name = robot.name;
    const choose = el('select', { 'aria-label': t('Robot'), onchange: () => { this.name = choose.value; this.page.rebuild(); } },
      ...this.robots().map((e) => el('option', { value: e.name, selected: e === robot }, e.name)));
    const sensors = home.entities.filter((e) => e.model === robot.model && e.topic);
    this.cameras = sensors.filter((e) => e.type === 'sensor_msgs/Image');
    this.lidar = sensors.find((e) => e.type === 'sensor_msgs/LaserScan');
    this.picture = el('img', { class: 'picture', alt: t('Picture of the camera of {name}', { name: robot.name }), hidden: !this.camera });
    const shown = el('button', { type: 'button', 'aria-pressed': String(this.camera), onclick: () => { this.camera = !this.camera; this.page.rebuild(); } }, t('Camera'));
    this.stick = el('div', { class: 'stick', role: 'group', 'aria-label': t('Stick: drag to drive; or the keys W A S D') }, el('i'));
    this.stick.addEventListener('pointerdown', (/** @type {PointerEvent} */ e) => { this.stick.setPointerCapture(e.pointerId); this.drag(e); });
    this.stick.addEventListener('pointermove', (/** @type {PointerEvent} */ e) => { if (this.stick.hasPointerCapture(e.pointerId)) this.drag(e); });
    for (const end of ['pointerup', 'pointercancel']) this.stick.addEventListener(end, () => this.steer(0, 0));
    this.subscribe();
    return [el('div', { class: 'tools' }, choose, this.cameras.length && !home.status.replay ? shown : null), ...trip(home, this.page, robot),
    thingRow(home, robot, () => this.page.show(robot)), this.picture, this.map.show(robot, this.lidar ? `scan:${this.lidar.name}` : ''),
    ...(home.status.replay ? [] : denied('drive') ? [el('p', { class: 'soft' }, denied('drive'))] : [el('p', { class: 'soft', style: 'text-align: center' }, t('Drag on the map: a goal and its heading. Or drag the robot itself in the home.')),
      this.stick, el('p', { class: 'soft', style: 'text-align: center' }, t('Drag the stick, or hold W A S D.'))])];
  }

  subscribe() {
    const topics = [];
    if (this.active && this.camera && this.cameras?.length) topics.push(`picture:${this.cameras[0].name}`);
    if (this.active && this.lidar) topics.push(`scan:${this.lidar.name}`);
    this.home.connection.subscribe('robot', topics);
  }

  leave() {
    this.active = false;
    this.steer(0, 0);
    this.home.connection?.subscribe('robot', []);
  }

  update() {
    this.page.refreshThings();
  }

  /** @param {string} name @param {ArrayBuffer} content */
  onPicture(name, content) {
    if (!this.picture?.isConnected || name !== `picture:${this.cameras?.[0]?.name}`) return;
    const before = this.picture.src;
    this.picture.src = URL.createObjectURL(new Blob([content], { type: 'image/jpeg' }));
    if (before) URL.revokeObjectURL(before);
  }

  /** @param {KeyboardEvent} e @param {boolean} down */
  key(e, down) {
    const key = e.key.toLowerCase();
    if (!KEYS[key] || !this.active || isForOthers(e) || denied('drive')) return;
    if (down) this.keys.add(key);
    else this.keys.delete(key);
    const sum = [...this.keys].reduce(([x, y], one) => [x + KEYS[one][0], y + KEYS[one][1]], [0, 0]);
    this.steer(SPEED * sum[0], TURN * sum[1]);
  }

  /** @param {PointerEvent} e */
  drag(e) {
    const box = this.stick.getBoundingClientRect(), half = box.width / 2;
    let x = (e.clientX - box.left - half) / half, y = (half - (e.clientY - box.top)) / half;
    const length = Math.max(1, Math.hypot(x, y));
    x /= length;
    y /= length;
    this.stick.firstChild.style.transform = `translate(${x * 50}px, ${-y * 50}px)`;
    this.steer(SPEED * y, -TURN * x);
  }

  /** @param {number} speed @param {number} turn */
  steer(speed, turn) {
    if (!speed && !turn && this.stick) this.stick.firstChild.style.transform = '';
    const moved = this.speed || this.turn;
    this.speed = speed;
    this.turn = turn;
    const send = () => this.home.connection.ask({ do: 'drive', name: this.name, speed: this.speed, turn: this.turn });
    if (speed || turn) {
      if (!this.timer) { send(); this.timer = setInterval(send, PERIOD); }
    } else if (moved) {
      clearInterval(this.timer);
      this.timer = undefined;
      send();
    }
  }
}
