/** Sensors and furniture that one carries to another place in the running home: by a drag, or by keys. */
import { denied } from './access.js';
import { ARROWS, by, el, isForOthers, limit, svg } from './dom.js';
import { yawOf } from './fields.js';
import { t } from './lang.js';

const REACH = 22, CLICK = 6; // px around a press, of a press that is none
const FIXED = new Set(['door', 'window', 'elevator', 'person']); // kinds whose models stay
const STEP = 0.1, TURN = Math.PI / 12; // m, rad, of a key

export class Carry {
  /** @param {import('./home.js').Home} home @param {any} page */
  constructor(home, page) {
    this.home = home;
    this.page = page;
    this.on = false;
    /** @type {{model: string, id: number | null, at: number[], from: number[], pose: number[], dx: number, dy: number, turn: number, moved: boolean} | null} what is carried, and how far */
    this.held = null;
    this.ended = false;
    this.button = el('button', { type: 'button', id: 'carry', class: 'both', 'aria-pressed': 'false', title: t('Drag sensors and furniture to other places (M)'), onclick: () => this.toggle() }, t('Move things'));
    by('layers').append(this.button);
    for (const topic of ['status', 'access']) home.on(topic, () => { this.button.hidden = home.status.replay; limit(this.button, 'move'); });
    addEventListener('keydown', (e) => this.key(e), true);
    const { view, plan } = page;
    if (view) this.listen(view.element, (x, y) => view.hit(x, y)?.model, (x, y, z) => view.viewpoint.ground(x, y, z));
    this.listen(plan.element, (x, y) => this.near(plan.ground(x, y), REACH / plan.scale, plan.number()), (x, y) => plan.ground(x, y));
  }

  toggle() {
    if (denied('move')) return;
    this.on = !this.on;
    this.end();
    this.button.setAttribute('aria-pressed', String(this.on));
    by('hint').textContent = t('Drag a sensor or a piece of furniture');
    by('hint').hidden = !this.on;
  }

  /** @returns {string[]} models that can be carried */
  models() {
    const { home } = this, fixed = new Set(home.entities.filter((e) => FIXED.has(e.kind) || home.isRobot(e)).map((e) => e.model));
    const sensors = home.entities.filter((e) => home.kinds[e.kind]?.role === 'sensor').map((e) => e.model), things = (home.described?.things ?? []).map((/** @type {any} */ thing) => thing.name);
    return [...new Set([...sensors, ...things])].filter((model) => !fixed.has(model) && home.linksOf(model).length);
  }

  /** @param {string} model @returns {number[]} x y z and quaternion */
  pose(model) { return Array.from(this.home.pose(this.home.linksOf(model)[0])); }

  /** @param {string} model @returns {number[][][]} the corners of its parts from above */
  outlines(model) {
    const { home, page: { plan } } = this, links = home.linksOf(model);
    return home.scene.shapes.filter((/** @type {any} */ shape) => links.includes(shape.link)).map((/** @type {any} */ shape) => plan.corners(plan.boxOf(shape)));
  }

  /** @param {number[]} point @param {number} reach m @param {number} number of the floor @returns {string | undefined} the model that is nearest, sensors first */
  near([x, y], reach, number) {
    const { home } = this;
    let best, least = Infinity;
    for (const model of this.models()) {
      const [mx, my, mz] = this.pose(model);
      if (home.storeyAt(mz) !== number) continue;
      const corners = this.outlines(model).flat(), xs = corners.map(([cx]) => cx).concat(mx), ys = corners.map(([, cy]) => cy).concat(my);
      const [left, right, low, high] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
      const far = Math.hypot(Math.max(left - x, 0, x - right), Math.max(low - y, 0, y - high)), cost = far + 0.1 * (right - left) * (high - low);
      if (far <= reach && cost < least) { least = cost; best = model; }
    }
    return best;
  }

  /**
   * @param {any} element @param {(x: number, y: number) => string | undefined} hit the model at a place of the page
   * @param {(x: number, y: number, z: number) => number[] | null} ground where it hits the height z
   */
  listen(element, hit, ground) {
    const at = (/** @type {string} */ type, /** @type {(e: PointerEvent) => boolean} */ act) => element.addEventListener(type, (/** @type {PointerEvent} */ e) => {
      if (!this.on || !act(e)) return;
      e.stopImmediatePropagation(); // else the view turns, or a robot gets a goal
      e.preventDefault();
    }, true);
    at('pointerdown', (e) => {
      this.ended = false;
      if (e.button !== 0 || !e.isPrimary || !element.contains(e.target)) return false;
      const model = hit(e.clientX, e.clientY);
      if (!model || !this.models().includes(model)) return false;
      const pose = this.pose(model), from = ground(e.clientX, e.clientY, pose[2]);
      if (!from) return false;
      element.setPointerCapture(e.pointerId);
      this.held = { model, id: e.pointerId, at: [e.clientX, e.clientY], from, pose, dx: 0, dy: 0, turn: 0, moved: false };
      return true;
    });
    at('pointermove', (e) => {
      const { held } = this;
      if (!held || held.id !== e.pointerId) return false;
      held.moved ||= Math.hypot(e.clientX - held.at[0], e.clientY - held.at[1]) >= CLICK;
      const to = ground(e.clientX, e.clientY, held.pose[2]);
      if (to && held.moved) Object.assign(held, { dx: to[0] - held.from[0], dy: to[1] - held.from[1] });
      this.mark();
      return true;
    });
    at('pointerup', (e) => {
      const { held } = this;
      if (!held || held.id !== e.pointerId) return false;
      this.ended = true;
      if (held.moved) this.put();
      else this.end();
      return true;
    });
    at('pointercancel', (e) => {
      if (this.held?.id !== e.pointerId) return false;
      this.end();
      return true;
    });
    element.addEventListener('click', (/** @type {MouseEvent} */ e) => { if (this.ended) e.stopImmediatePropagation(); this.ended = false; }, true);
  }

  /** Shows where it would be. */
  mark() {
    const { held, page: { plan, goal } } = this;
    plan.carried?.remove();
    plan.carried = null;
    if (!held) { goal.put(null); return; }
    const [x, y, z] = [held.pose[0] + held.dx, held.pose[1] + held.dy, held.pose[2]], yaw = yawOf(held.pose) + held.turn;
    if (plan.hidden) goal.put([x, y, goal.floorAt([x, y, z]), yaw]);
    else {
      const degrees = (/** @type {number} */ angle) => (-angle * 180) / Math.PI, at = [held.pose[0], -held.pose[1]];
      const outline = this.outlines(held.model).map(([a, b, c, d]) => `M${[a, b, d, c].map(([u, v]) => `${u} ${-v}`).join('L')}Z`).join('');
      plan.carried = svg('g', { class: 'goal', transform: `translate(${held.dx} ${-held.dy}) rotate(${degrees(held.turn)} ${at.join(' ')})` }, svg('path', { 'fill-opacity': 0.3, d: outline }),
        svg('path', { d: 'M.3 0L0 .2L-.2 .2L-.2 -.2L0 -.2Z', transform: `translate(${at.join(' ')}) rotate(${degrees(yawOf(held.pose))})` }));
      plan.root.append(plan.carried);
    }
  }

  end() {
    const shown = this.held;
    this.held = null;
    if (shown) this.mark();
  }

  async put() {
    const { held } = this;
    this.end();
    if (held) await this.home.order({ do: 'move', model: held.model, x: held.pose[0] + held.dx, y: held.pose[1] + held.dy, turn: Math.atan2(Math.sin(held.turn), Math.cos(held.turn)) });
  }

  /** @param {KeyboardEvent} e */
  key(e) {
    if (isForOthers(e) || by('dialog').open || this.home.status.replay) return;
    const { held, on } = this, way = ARROWS[e.key];
    if (e.key.toLowerCase() === 'm') this.toggle();
    else if (!on) return;
    else if (e.key === '.' || e.key === ',') this.next(e.key === '.' ? 1 : -1);
    else if (e.key === 'Escape') (held ? this.end() : this.toggle());
    else if (!held) return;
    else if (way) Object.assign(held, { dx: held.dx + STEP * way[0], dy: held.dy + STEP * way[1] });
    else if (e.key.toLowerCase() === 'r') held.turn += TURN * (e.shiftKey ? -1 : 1);
    else if (e.key === 'Enter') this.put();
    else return;
    if (this.held) this.mark();
    e.preventDefault();
    e.stopImmediatePropagation();
  }

  /** @param {number} way to the next or the last thing of the floor */
  next(way) {
    const { home, page } = this, number = page.storey ?? home.storeys[0]?.number ?? 0, all = this.models().filter((model) => home.storeyAt(this.pose(model)[2]) === number);
    if (!all.length) return;
    const at = all.indexOf(this.held?.model ?? ''), model = all[(at < 0 ? (way > 0 ? 0 : all.length - 1) : at + way + all.length) % all.length];
    this.held = { model, id: null, at: [0, 0], from: [0, 0, 0], pose: this.pose(model), dx: 0, dy: 0, turn: 0, moved: false };
    by('hint').textContent = t('{name}: arrows, R, Enter', { name: model.replaceAll('_', ' ') });
  }
}
