/** The usual day of a person on a ribbon of 24 hours: activities as blocks that one drags. */
import { by, clockText, el, words } from './dom.js';
import { itemOf } from './drawing.js';
import { t } from './lang.js';

/** @typedef {{do: string[], low: number, high: number, days: string, chance?: number, together?: boolean, lasts?: number[]}} Planned */

const DAY = 86400, STEP = 900, FINE = 300; // s; of an arrow key, of a drag or with Shift
const LEAST = 900, LABEL = 8400, LANE = 46, TOP = 20; // s: the widths of a short block and of a text; px of a lane, above all
const CLICK = 5; // px
const BOUNDS = ['wake', 'sleep']; // they begin and end the day, and stay

/** @param {string} activity */
const doing = (activity) => t(activity.replaceAll('_', ' '));
/** @param {string} text */
const capital = (text) => text[0].toUpperCase() + text.slice(1);

export class DayPlan {
  /** @param {import('./edit.js').Editor} editor */
  constructor(editor) {
    this.editor = editor;
    this.element = by('day');
    this.key = ''; // of the person
    this.kind = 'weekday';
    /** @type {{index: number, id: number, x: number, by: number} | null} a block that is dragged */
    this.held = null;
  }

  /** @param {string} key of a person, or nothing */
  open(key) {
    this.key = key;
    this.show();
    if (key) this.element.querySelector('.block')?.focus();
  }

  get person() { return this.key ? itemOf(this.editor.storey, this.key) : null; }

  /** @returns {Planned[]} */
  get day() { return this.person?.day ?? this.editor.days[this.person?.habits] ?? []; }

  /** @param {Planned[]} day @param {number} [focused] the block that keeps the focus */
  set(day, focused = -1) {
    const { key, person } = this;
    this.editor.do({ change: { [key]: { ...person, day } } }, [key]);
    if (focused >= 0) /** @type {any} */ (this.element.querySelector(`[data-index="${focused}"]`))?.focus();
  }

  /** @param {number} index @param {number} by s */
  shift(index, by) {
    const day = this.split(index), part = day[index], low = (part.low + by + DAY) % DAY;
    day[index] = { ...part, low, high: low + part.high - part.low };
    if (by) this.set(day, index);
  }

  /** @param {number} index */
  remove(index) { if (!BOUNDS.includes(this.day[index].do[0])) this.set(this.split(index).filter((_, i) => i !== index)); }

  /** @param {number} index @returns {Planned[]} the day with that block for the shown days alone, and one as it was for the others */
  split(index) {
    const part = this.day[index], other = this.kind === 'weekday' ? 'weekend' : 'weekday';
    if (part.days !== 'all') return [...this.day];
    return [...this.day.map((each) => (each === part ? { ...part, days: this.kind } : each)), { ...part, days: other }];
  }

  /** @param {Planned} part @returns {number} s that it takes */
  long({ do: what, lasts }) { return what.reduce((sum, each, i) => sum + (i === 0 && lasts ? Math.sqrt(lasts[0] * lasts[1]) : this.editor.durations[each] ?? 0), 0); }

  show() {
    const { editor, element, person, key } = this, shown = !editor.closed && person?.kind === 'person' && person.habits && editor.selection.join() === key;
    element.hidden = !shown;
    if (!shown || this.held) return;
    const focused = /** @type {any} */ (document.activeElement)?.dataset?.index;
    const button = (/** @type {string} */ text, /** @type {any} */ more) => el('button', { type: 'button', ...more }, text);
    const kinds = [['weekday', t('Mon – Fri')], ['weekend', t('Sat, Sun')]].map(([kind, text]) => button(text, { 'aria-pressed': String(kind === this.kind), onclick: () => { this.kind = kind; this.show(); } }));
    const adds = el('select', { 'aria-label': t('Add an activity'), onchange: () => this.set([...this.day, { do: [adds.value], low: 43200, high: 45000, days: this.kind }], this.day.length) },
      el('option', { value: '' }, t('Add …')), ...Object.keys(editor.durations).filter((name) => name !== 'sleep').map((name) => el('option', { value: name }, capital(doing(name)))));
    const reset = person.day ? button(t('As usual'), { title: t('The day of the profile {name}', { name: words(person.habits) }), onclick: () => { const { day, ...rest } = person; editor.do({ change: { [key]: rest } }, [key]); } }) : null;
    element.replaceChildren(el('header', {}, el('h2', {}, t('The day of {name}', { name: person.name })), ...kinds, adds, reset, el('button', { class: 'icon', type: 'button', 'aria-label': t('Close'), onclick: () => this.open('') }, '×')),
      el('div', { class: 'scroll' }, this.track()));
    if (focused !== undefined) /** @type {any} */ (element.querySelector(`[data-index="${focused}"]`))?.focus();
  }

  track() {
    const blocks = this.blocks(), lanes = Math.max(...blocks.map((block) => parseInt(block.style.top, 10)), TOP);
    return el('div', { class: 'track', style: `height: ${lanes + LANE}px` }, ...this.hours(), ...blocks);
  }

  hours() { return Array.from({ length: 24 }, (_, hour) => el('span', { class: 'hour', style: `left: ${(hour / 24) * 100}%` }, hour % 3 ? '' : String(hour))); }

  /** @returns {any[]} the blocks of the kind of day that is shown, each in a lane of its own where they would overlap */
  blocks() {
    /** @type {number[]} */
    const ends = [], shown = [...this.day.entries()].filter(([, part]) => part.days === 'all' || part.days === this.kind).sort(([, a], [, b]) => a.low - b.low);
    const made = shown.map(([index, part]) => {
      const begin = ((part.low + part.high) / 2) % DAY, long = Math.max(LEAST, this.long(part)), lane = ends.findIndex((end) => end <= begin), at = lane < 0 ? ends.length : lane;
      ends[at] = begin + Math.max(long, LABEL);
      return { index, part, begin, long, lane: at };
    });
    return made.map(({ index, part, begin, long, lane }) => this.block(index, part, begin, long, lane));
  }

  /** @param {number} index @param {Planned} part @param {number} begin @param {number} long @param {number} lane */
  block(index, part, begin, long, lane) {
    const bound = BOUNDS.includes(part.do[0]), name = capital(part.do.map(doing).join(', ')), at = clockText(begin).slice(0, 5), share = Math.round((part.chance ?? 1) * 100);
    const text = share < 100 ? t('{what} at {time}, on {share} % of days', { what: name, time: at, share }) : t('{what} at {time}', { what: name, time: at });
    return el('button', { type: 'button', class: `block${bound ? ' bound' : ''}`, 'data-index': index, title: `${text}. ${bound ? t('Drag it, or use arrow keys') : t('Drag it, or use arrow keys; Delete removes it')}`, 'aria-label': text,
      style: `left: ${(begin / DAY) * 100}%; width: ${(Math.min(long, DAY - begin) / DAY) * 100}%; top: ${TOP + lane * LANE}px`,
      onkeydown: (/** @type {KeyboardEvent} */ e) => this.pressed(e, index),
      onpointerdown: (/** @type {PointerEvent} */ e) => { this.held = { index, id: e.pointerId, x: e.clientX, by: 0 }; /** @type {any} */ (e.currentTarget).setPointerCapture(e.pointerId); },
      onpointermove: (/** @type {PointerEvent} */ e) => this.moved(e, begin), onpointerup: (/** @type {PointerEvent} */ e) => this.dropped(e), onpointercancel: () => { this.held = null; this.show(); } }, `${at} ${name}`);
  }

  /** @param {PointerEvent} e @param {number} begin */
  moved(e, begin) {
    const { held } = this, block = /** @type {any} */ (e.currentTarget);
    if (held?.id !== e.pointerId || (!held.by && Math.abs(e.clientX - held.x) < CLICK)) return;
    held.by = Math.round((((e.clientX - held.x) / block.parentElement.clientWidth) * DAY) / FINE) * FINE;
    held.by = Math.min(DAY - FINE - begin, Math.max(-begin, held.by));
    block.style.left = `${((begin + held.by) / DAY) * 100}%`;
    block.textContent = `${clockText(begin + held.by).slice(0, 5)} ${block.textContent.slice(6)}`;
  }

  /** @param {PointerEvent} e */
  dropped(e) {
    const { held } = this;
    if (held?.id !== e.pointerId) return;
    this.held = null;
    this.shift(held.index, held.by);
  }

  /** @param {KeyboardEvent} e @param {number} index */
  pressed(e, index) {
    const way = /** @type {any} */ ({ ArrowLeft: -1, ArrowRight: 1 })[e.key];
    if (e.ctrlKey || e.metaKey || e.altKey) return;
    if (way) this.shift(index, way * (e.shiftKey ? FINE : STEP));
    else if (e.key === 'Delete' || e.key === 'Backspace') this.remove(index);
    else if (e.key === 'Escape') this.open('');
    else return;
    e.preventDefault();
    e.stopPropagation();
  }
}
