/** The card of what is selected: its numbers and names, and what one can do with it. */
import { sensorsAt } from './coverage.js';
import { by, el, words } from './dom.js';
import { itemOf, lengthOf, mirrored, normal, placeOn, stretched, swung, widened, withWalls } from './drawing.js';
import { numbers, t } from './lang.js';
import { areaOf } from './sheet.js';

const USES = ['', 'bedroom', 'bathroom', 'kitchen', 'living', 'work', 'hall', 'landing', 'outdoor', 'other'];
const DEGREE = Math.PI / 180;
const exact = (/** @type {number} */ value) => Math.round(value * 1e4) / 1e4;

export class Form {
  /** @param {import('./edit.js').Editor} editor */
  constructor(editor) {
    this.editor = editor;
    this.element = by('card');
  }

  show() {
    const { editor, element } = this, { selection, storey } = editor, room = editor.rooms[editor.room ?? -1];
    const item = selection.length === 1 ? itemOf(storey, selection[0]) : null;
    element.hidden = !selection.length && !room;
    if (element.hidden || element.contains(document.activeElement) && /^(INPUT|SELECT)$/.test(document.activeElement?.tagName ?? '') && this.shown === selection.join() && room === this.room) return;
    this.shown = selection.join();
    this.room = room;
    const fields = room ? this.ofRoom(room) : item ? this.of(selection[0].split('/')[0], selection[0], item) : [];
    const title = room ? room.name || t('Room') : item ? this.title(selection[0].split('/')[0], item) : t('{count} things', { count: selection.length });
    element.replaceChildren(el('header', {}, el('div', {}, el('h2', {}, words(title))), el('button', { class: 'icon', type: 'button', 'aria-label': t('Close'), onclick: () => editor.select([]) }, '×')),
      el('div', { class: 'form' }, ...fields), ...(room ? [] : [el('div', { class: 'verbs' }, ...this.verbs(selection, item))]));
  }

  /** @param {string} list @param {any} item @returns {string} */
  title(list, item) {
    const sensor = this.editor.catalog.sensors.find((/** @type {any} */ one) => one.model === item.model);
    return list === 'walls' ? t('Wall') : list === 'lamps' ? t('Lamp') : list === 'sensors' ? sensor?.name ?? item.model : list === 'movers' ? item.kind : list === 'lifts' ? t('Elevator') : item.source || item.name || item.thing || item.kind || list;
  }

  /** @param {string[]} keys @param {any} item */
  verbs(keys, item) {
    const { editor } = this, button = (/** @type {string} */ text, /** @type {() => void} */ does, title = '') => el('button', { type: 'button', title, onclick: does }, text);
    const leafy = item?.leaves && keys[0].startsWith('openings/');
    return [leafy ? button(t('Other hinge'), () => this.set(keys[0], mirrored(item))) : null, leafy ? button(t('Other side'), () => this.set(keys[0], swung(item))) : null,
      leafy || keys.every((key) => key.startsWith('openings/')) ? null : button(t('Turn'), () => editor.turn(90 * DEGREE), 'R'), button(t('Copy'), () => editor.duplicate(), 'Ctrl+C, Ctrl+V'), button(t('Delete'), () => editor.remove(), t('Delete'))];
  }

  /** @param {string} key @param {any} item */
  set(key, item) { this.editor.do({ change: { [key]: item } }, [key]); }

  /** @param {string} label @param {number} value @param {number} step @param {(value: number) => void} change @param {number} [least] @param {number} [most] */
  number(label, value, step, change, least = 0, most = 100) {
    const field = el('input', { type: 'number', value: String(Math.round(value * 1000) / 1000), step, min: least, max: most, onchange: () => {
      if (field.value !== '' && field.validity && !field.validity.badInput) change(Math.min(most, Math.max(least, Number(field.value))));
    } });
    return el('label', {}, label, field);
  }

  /** @param {string} label @param {string} value @param {(value: string) => void} change @param {string} [hint] */
  text(label, value, change, hint = '') {
    const field = el('input', { type: 'text', value, maxlength: 40, placeholder: hint, onchange: () => change(field.value.replace(/\s/g, ' ').replace(/\p{C}/gu, '').trim()) }); // signs that nobody sees are no name
    return el('label', { class: 'wide' }, label, field);
  }

  /** @param {any} room */
  ofRoom(room) {
    const { editor } = this, use = el('select', { onchange: () => editor.nameRoom(room, room.name, use.value) }, ...USES.map((value) => el('option', { value, selected: value === room.use }, value ? words(value) : t('by its name'))));
    return [this.text(t('Name'), room.name, (name) => editor.nameRoom(room, name, ''), t('kitchen, bathroom, …')), el('label', {}, t('Use'), use), el('label', {}, t('Area'), el('output', {}, numbers(`${areaOf(room.polygon).toFixed(1)} m²`))), ...this.ofSpot()];
  }

  /** @returns {any[]} what detects somebody at the place that was pressed */
  ofSpot() {
    const { told: { coverage }, spot } = this.editor;
    if (!coverage || !spot) return [];
    const { standing, fallen } = sensorsAt(coverage, spot), row = (/** @type {string} */ text, /** @type {string[]} */ names) => el('label', { class: 'wide' }, text, el('output', {}, names.join(', ') || t('no sensor')));
    return [row(t('Who walks here is seen by'), standing), row(t('Who has fallen here and moves, by'), fallen)];
  }

  /** @param {string} list @param {string} key @param {any} item @returns {any[]} */
  of(list, key, item) {
    const { editor } = this, { storey } = editor, put = (/** @type {any} */ more) => this.set(key, { ...item, ...more });
    const degrees = (/** @type {string} */ label) => this.number(label, Math.round((item.yaw ?? 0) / DEGREE), 15, (value) => put({ yaw: normal(value * DEGREE) }), -360, 360);
    if (list === 'walls') {
      return [this.number(t('Length, m'), lengthOf(item), 0.1, (long) => editor.do(stretched(storey, key, 'end', placeOn(item, long).map(exact)), [key]), 0.1),
        this.number(t('Thickness, m'), item.thickness, 0.05, (thickness) => editor.do(withWalls(storey, new Map([[key, { ...item, thickness }]])), [key]), 0.05, 1),
        this.number(t('Height, m'), item.top - item.bottom, 0.1, (high) => put({ top: exact(item.bottom + high) }), 0.1, 10)];
    }
    if (list === 'openings') {
      return [this.number(t('Width, m'), item.width, 0.1, (width) => this.set(key, widened(item, width)), 0.3, 6),
        this.number(t('Height, m'), item.top - item.bottom, 0.05, (high) => put({ top: exact(item.bottom + high) }), 0.2, 5),
        this.number(t('Sill, m'), item.bottom - storey.elevation, 0.05, (sill) => put({ bottom: exact(storey.elevation + sill), top: exact(item.top - item.bottom + storey.elevation + sill) }), 0, 3)];
    }
    if (list === 'pieces') {
      return [this.text(t('Name'), item.name ?? '', (name) => put({ name }), item.source || item.thing), this.number(t('Width, m'), item.width, 0.05, (width) => put({ width }), 0.02, 20), this.number(t('Depth, m'), item.depth, 0.05, (depth) => put({ depth }), 0.02, 20),
        this.number(t('Height, m'), item.height, 0.05, (height) => put({ height }), 0.01, 10), degrees(t('Front, °'))];
    }
    if (list === 'lamps') return [this.number(t('Light, lm'), item.flux, 100, (flux) => put({ flux }), 0, 20000), this.number(t('Height, m'), item.z - storey.elevation, 0.1, (high) => put({ z: exact(storey.elevation + high) }), 0.1, 10)];
    if (list === 'movers') {
      const { day, ...undated } = item, habits = el('select', { onchange: () => this.set(key, { ...undated, habits: habits.value }) }, ...['', ...editor.profiles].map((value) => el('option', { value, selected: value === (item.habits ?? '') }, value ? words(value) : t('stands'))));
      return [this.text(t('Name'), item.name ?? '', (name) => put({ name }), item.kind), degrees(t('Direction, °')), item.kind === 'person' ? el('label', {}, t('Lives as'), habits) : null,
        item.habits ? el('button', { type: 'button', id: 'day-open', onclick: () => editor.dayPlan?.open(key) }, t('Its day …')) : null];
    }
    if (list === 'lifts') {
      const floors = editor.history.now.plan.storeys.filter((each) => item.stops.includes(each.number)).map((each) => floorName(each));
      return [this.text(t('Name'), item.name, (name) => put({ name: name || 'elevator' })), degrees(t('Doors to, °')), el('label', {}, t('Stops at'), el('output', {}, floors.join(', ')))];
    }
    if (list === 'sensors') {
      return [this.text(t('Name'), item.name ?? '', (name) => put({ name }), t('by its room')), this.number(t('Height, m'), item.z - storey.elevation, 0.1, (high) => put({ z: exact(storey.elevation + high) }), 0, 10), degrees(t('Direction, °')),
        this.number(t('Down, °'), Math.round((item.pitch ?? 0) / DEGREE), 5, (value) => put({ pitch: exact(value * DEGREE) }), -90, 90)];
    }
    return [];
  }
}

/** @param {any} storey @returns {string} */
export const floorName = ({ name, number }) => (name ? t(name) : t('Floor {number}', { number }));
