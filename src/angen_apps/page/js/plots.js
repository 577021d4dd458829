/** Plots of readings over the last five minutes, or of the whole run, which the server keeps. */
import uPlot from '../vendor/uplot/uPlot.esm.js';
import { el, notice } from './dom.js';
import { HISTORY } from './home.js';
import { numbers, t } from './lang.js';

const MOST = 6;
const PERIOD = 250, AGAIN = 10000; // ms; after the latter the whole run is asked for again

export class Plots {
  /** @param {import('./home.js').Home} home @param {() => void} open */
  constructor(home, open) {
    this.home = home;
    this.open = open;
    this.paused = false;
    /** @type {{key: string, kind: string, name: string, field: any, box: any, plot: any, zoomed: boolean, whole: {t: number[], v: number[]}, asked: number}[]} */
    this.shown = [];
    this.holder = el('div');
    this.pause = el('button', { type: 'button', 'aria-pressed': 'false', onclick: () => this.setPaused(!this.paused) }, t('Pause plots'));
    this.whole = el('button', { type: 'button', 'aria-pressed': 'false', title: t('Since the server was started'), onclick: () => {
      this.whole.setAttribute('aria-pressed', String(!this.isWhole()));
      this.update();
    } }, t('Whole run'));
    this.tools = el('div', { class: 'tools', hidden: true }, this.pause, this.whole, el('button', { type: 'button', title: t('All readings since the server was started'), onclick: () => el('a', { href: '/readings.csv', download: '' }).click() }, 'CSV'), el('span', { class: 'soft' }, t('Drag to zoom, double click to reset')));
    this.element = el('div', {}, this.tools, this.holder);
    setInterval(() => this.update(), PERIOD);
  }

  /** @param {boolean} paused */
  setPaused(paused) {
    this.paused = paused;
    this.pause.setAttribute('aria-pressed', String(paused));
  }

  /**
   * Plots a field of a sensor or device, its most telling one.
   * @param {string} kind
   * @param {string} name
   * @param {string} [chosen]
   */
  add(kind, name, chosen) {
    const fields = this.home.fields(kind).filter((field, i, all) => all.findIndex((other) => other.name === field.name) === i
      && this.home.series.has(`${kind}/${name}/${field.name}`));
    if (!fields.length) { notice(t('{name} has no numbers yet.', { name })); return; }
    const field = fields.find((one) => one.name === chosen) ?? fields.find((one) => one.shown && one.type !== 'flag') ?? fields[0];
    const key = `${kind}/${name}/${field.name}`;
    this.open();
    if (this.shown.some((one) => one.key === key)) return;
    if (this.shown.length >= MOST) this.remove(this.shown[0]);
    const choice = el('select', { 'aria-label': t('Field of {name}', { name }) }, ...fields.map((one) => el('option', { value: one.name, selected: one === field }, t(one.name.replaceAll('_', ' ')))));
    const box = el('div', { class: 'plot' }, el('header', {}, el('span', { title: `${kind} ${name}` }, name), choice));
    const entry = { key, kind, name, field, box, plot: /** @type {any} */ (null), zoomed: false, whole: { t: /** @type {number[]} */ ([]), v: /** @type {number[]} */ ([]) }, asked: -Infinity };
    choice.addEventListener('change', () => { this.remove(entry); this.add(kind, name, choice.value); });
    box.firstChild.append(el('button', { class: 'icon', type: 'button', 'aria-label': t('Close the plot of {name}', { name }), onclick: () => this.remove(entry) }, '✕'));
    this.holder.append(box);
    this.shown.push(entry);
    this.tools.hidden = false;
    entry.plot = this.make(entry);
    this.update();
  }

  /** @param {any} entry */
  make(entry) {
    const style = getComputedStyle(document.documentElement), ink = style.getPropertyValue('--soft'), line = style.getPropertyValue('--line');
    const unit = entry.field.unit === '%' || !entry.field.unit ? entry.field.unit : ` ${entry.field.unit}`;
    const axis = { stroke: ink, grid: { stroke: line, width: 1 }, ticks: { stroke: line, width: 1 }, font: '11px system-ui' };
    return new uPlot({
      width: 316, height: 140, legend: { show: false },
      cursor: { drag: { x: true, y: false } },
      scales: { x: { time: false }, y: { range: (/** @type {any} */ _, /** @type {number} */ low, /** @type {number} */ high) => {
        const more = Math.max((high - low) * 0.1, Math.abs(high) * 0.02, 1e-3);
        return [low - more, high + more];
      } } },
      hooks: { setSelect: [(/** @type {any} */ u) => { if (u.select.width > 0) entry.zoomed = true; }], ready: [(/** @type {any} */ u) => {
        u.over.addEventListener('dblclick', () => { entry.zoomed = false; });
      }] },
      axes: [{ ...axis, values: (/** @type {any} */ _, /** @type {number[]} */ times) => times.map((t) => `${Math.round(t - this.now())} s`), size: 28 },
        { ...axis, values: (/** @type {any} */ _, /** @type {number[]} */ v) => v.map((one) => `${numbers(Number(one.toPrecision(4)))}${unit}`), size: 66 }],
      series: [{}, { stroke: style.getPropertyValue('--accent'), width: 2, fill: undefined, points: { show: false },
        paths: entry.field.type === 'flag' ? uPlot.paths.stepped?.({ align: 1 }) : undefined }],
    }, [[], []], entry.box);
  }

  isWhole() {
    return this.whole.getAttribute('aria-pressed') === 'true';
  }

  /** @param {any} entry whose whole run is shown */
  async ask(entry) {
    entry.asked = performance.now();
    const answer = await fetch(`/history.json?${new URLSearchParams({ kind: entry.kind, name: entry.name, field: entry.field.name })}`);
    if (answer.ok) entry.whole = await answer.json();
  }

  /**
   * What is plotted: the last minutes; of a whole run what the server had, then these; of a whole recording all.
   * @param {any} entry @returns {{t: number[], v: (number | null)[]}}
   */
  points({ key, whole }) {
    const recent = this.home.series.get(key) ?? { t: [], v: [] };
    if (!this.isWhole()) return recent;
    if (this.home.status.replay) return whole;
    const found = whole.t.findIndex((/** @type {number} */ time) => time >= recent.t[0]), end = found < 0 ? whole.t.length : found;
    return { t: [...whole.t.slice(0, end), ...recent.t], v: [...whole.v.slice(0, end), ...recent.v] };
  }

  now() {
    return this.home.stats.time;
  }

  /** @param {any} entry */
  remove(entry) {
    entry.plot?.destroy();
    entry.box.remove();
    this.shown = this.shown.filter((one) => one !== entry);
    this.tools.hidden = !this.shown.length;
  }

  restyle() {
    for (const entry of this.shown) {
      entry.plot.destroy();
      entry.plot = this.make(entry);
    }
    this.update();
  }

  update() {
    if (this.paused || document.hidden) return;
    for (const entry of this.shown) {
      if (!entry.box.isConnected) continue;
      if (this.isWhole() && performance.now() - entry.asked > AGAIN) this.ask(entry).then(() => this.update());
      const points = this.points(entry), times = [...points.t], values = [...points.v];
      const to = Math.max(this.now(), times[times.length - 1] ?? 0), from = Math.max(this.isWhole() ? -Infinity : to - HISTORY, Math.min(times[0] ?? to, to - 10));
      if (times.length && times[times.length - 1] < to) { times.push(to); values.push(values[values.length - 1]); }
      entry.plot.setData([times, values], !entry.zoomed);
      if (!entry.zoomed) entry.plot.setScale('x', { min: from, max: to });
    }
  }
}
