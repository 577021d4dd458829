/** The lists beside the view: rooms, sensors with plots, events, costs, robots. */
import { denied } from './access.js';
import { by, el, isNarrow, words } from './dom.js';
import { thingRow } from './card.js';
import { happened, measured, noun, numbers, t } from './lang.js';
import { Plots } from './plots.js';
import { RobotPanel } from './robot.js';
import { floorText, roomText } from './labels.js';

const PERIOD = 200; // ms
const SMALL = new Set(['changed', 'changes', 'steady']); // events of light and surfaces, which come often
const MANY = 60; // rooms: more are listed by floor, those of a floor once it is opened

/** @typedef {{id: string, text: string, build: () => any[], update: () => void, topics: string[]}} Panel */

export class Panels {
  /** @param {import('./home.js').Home} home @param {any} page */
  constructor(home, page) {
    this.home = home;
    this.page = page;
    /** @type {any} */
    this.filter = null;
    /** @type {any} */
    this.eventFilter = null;
    /** @type {any} whether events of small changes are listed */
    this.small = null;
    /** @type {Map<string, any>} */
    this.lines = new Map();
    this.count = 0;
    /** @type {Set<number>} floors whose rooms are listed */
    this.opened = new Set();
    /** @type {any} */
    this.timer = undefined;
    this.plots = new Plots(home, () => this.open('sensors'));
    this.robot = new RobotPanel(home, page);
    /** @type {Panel[]} */
    this.all = [
      { id: 'rooms', text: t('Rooms'), build: () => this.rooms(), update: () => this.refreshRooms(), topics: ['rows'] },
      { id: 'sensors', text: t('Sensors'), build: () => this.sensors(), update: () => this.refreshSensors(), topics: ['rows'] },
      { id: 'events', text: t('Events'), build: () => this.events(), update: () => this.refreshEvents(), topics: ['events'] },
      { id: 'robot', text: t('Robot'), build: () => this.robot.build(), update: () => this.robot.update(), topics: ['rows'] },
      { id: 'costs', text: t('Costs'), build: () => this.costs(), update: () => this.refreshCosts(), topics: ['cost', 'stats'] },
    ];
    this.current = this.all[0];
    by('tabs').append(...this.all.map((panel) => el('button', { type: 'button', role: 'tab', id: `tab-${panel.id}`, 'aria-controls': 'panel',
      onclick: () => this.open(panel.id, true) }, panel.text)));
    by('tabs').addEventListener('keydown', (/** @type {KeyboardEvent} */ e) => this.arrow(e));
    for (const topic of ['home', 'entities', 'status', 'access']) home.on(topic, () => this.rebuild());
    for (const topic of ['rows', 'events', 'cost', 'stats']) {
      home.on(topic, () => { if (this.current.topics.includes(topic)) this.later(); });
    }
    this.open('rooms');
  }

  /** Lists need no more than a few updates per second. */
  later() {
    this.timer ??= setTimeout(() => { this.timer = undefined; this.current.update(); }, PERIOD);
  }

  /** @param {KeyboardEvent} e */
  arrow(e) {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[e.key];
    if (!step) return;
    const next = this.all[(this.all.indexOf(this.current) + step + this.all.length) % this.all.length];
    this.open(next.id);
    by(`tab-${next.id}`).focus();
  }

  /** @param {string} id @param {boolean} [byHand] */
  open(id, byHand = false) {
    if (byHand && isNarrow()) by('side').classList.toggle('low', this.current.id === id && !by('side').classList.contains('low'));
    this.current = this.all.find((panel) => panel.id === id) ?? this.all[0];
    for (const panel of this.all) {
      by(`tab-${panel.id}`).setAttribute('aria-selected', String(panel === this.current));
      by(`tab-${panel.id}`).tabIndex = panel === this.current ? 0 : -1;
    }
    by('panel').setAttribute('aria-labelledby', `tab-${id}`);
    this.home.connection.subscribe('costs', id === 'costs' ? ['cost'] : []);
    if (id !== 'robot') this.robot.leave();
    this.rebuild();
    by('panel').scrollTop = 0;
  }

  rebuild() {
    by('panel').replaceChildren(...this.current.build().filter(Boolean));
    this.current.update();
  }

  // --- rooms

  rooms() {
    const { home } = this;
    /** @type {Map<string, any[]>} */
    const things = new Map();
    const movers = new Set(home.movers.map((e) => e.model));
    for (const e of home.entities) {
      if (home.kinds[e.kind]?.role !== 'device' || (!home.isMover(e) && movers.has(e.model))) continue;
      const rooms = home.roomsOf(e);
      for (const name of rooms.length ? rooms.map((room) => room.name) : ['']) things.set(name, [...(things.get(name) ?? []), e]);
    }
    const shown = this.page.storey === null ? home.rooms : home.rooms.filter((room) => room.storey === this.page.storey);
    const box = (/** @type {any} */ room) => this.roomBox(room, things.get(room.name) ?? []);
    const parts = shown.length > MANY ? this.floors(shown, box) : shown.map(box);
    const rest = (things.get('') ?? []).filter((e) => home.kinds[e.kind].verbs.length || home.isMover(e));
    if (rest.length && (this.page.storey === null || !shown.length)) {
      parts.push(el('section', { class: 'room' }, el('header', {}, el('b', {}, shown.length ? t('Elsewhere') : t('Devices'))), ...rest.map((e) => thingRow(home, e, () => this.page.show(e)))));
    }
    if (!parts.length) parts.push(el('p', { class: 'soft' }, home.status.node || home.status.replay ? t('This world has no devices.') : t('Waiting for the simulator.')));
    return [...this.tools(), ...parts];
  }

  /** @param {any[]} rooms @param {(room: any) => any} box */
  floors(rooms, box) {
    return [...this.home.storeys].reverse().map((storey) => {
      const own = rooms.filter((room) => room.storey === storey.number), key = storey.number;
      const part = el('details', { class: 'floor', open: this.opened.has(key) }, el('summary', {}, el('b', {}, floorText(storey)), el('span', { class: 'soft' }, ` ${t('{count} rooms', { count: own.length })}`)));
      const fill = () => {
        if (part.open) this.opened.add(key);
        else this.opened.delete(key);
        if (part.open && part.children.length === 1) part.append(...own.map(box));
      };
      part.addEventListener('toggle', fill);
      fill();
      return part;
    });
  }

  tools() {
    const { home } = this;
    if (home.status.replay || !home.status.node) return [];
    const all = (/** @type {string} */ kind, /** @type {string} */ verb) => () => home.order({ do: 'command', target: `${kind}/all`, text: verb });
    const pair = (/** @type {string} */ kind, /** @type {string} */ text, /** @type {string[]} */ ...verbs) => (home.entities.some((e) => e.kind === kind)
      ? el('span', { class: 'pair', role: 'group', 'aria-label': text }, el('span', { class: 'soft' }, text), ...verbs.map((verb) => el('button', { type: 'button', order: 'command', onclick: all(kind, verb) }, t(verb)))) : null);
    return [denied('spawn') && el('p', { class: 'soft', id: 'limits' }, denied('spawn')), el('div', { class: 'tools' }, pair('lamp', t('Lamps'), 'On', 'Off'), pair('door', t('Doors'), 'Open', 'Close'))];
  }

  /** @param {any} room @param {any[]} things */
  roomBox(room, things) {
    const { home } = this, box = el('section', { class: 'room' });
    const info = el('span', { class: 'soft number' });
    box.append(el('header', {}, el('button', { type: 'button', onclick: () => this.page.showRoom(room) }, roomText(room)),
      el('span', { class: 'soft' }, home.storeys.length > 1 ? t('floor {number}', { number: room.storey }) : ''), el('span', { class: 'grow' }), info));
    box.append(...things.filter((e) => !home.isMover(e)).sort((a, b) => rank(a) - rank(b)).map((e) => thingRow(home, e, () => this.page.show(e))));
    const movers = el('div', {});
    box.append(movers);
    const measured = home.entities.filter((e) => ['luminosity', 'temperature'].includes(e.kind) && home.roomsOf(e)[0] === room).slice(0, 2);
    const lamps = things.filter((e) => e.kind === 'lamp');
    box.refresh = () => {
      const text = measured.map((e) => home.told(e)).filter(Boolean).join(' · ');
      if (info.textContent !== text) info.textContent = text;
      box.classList.toggle('lit', lamps.some((e) => /^on/i.test(home.row(e)?.text ?? '')));
      const here = home.movers.filter((e) => home.roomsOf(e)[0] === room);
      const names = here.map((e) => `${e.kind}/${e.name}`).join();
      if (movers.dataset.names !== names) {
        movers.dataset.names = names;
        movers.replaceChildren(...here.map((e) => thingRow(home, e, () => this.page.show(e))));
      }
    };
    return box;
  }

  refreshRooms() {
    for (const part of by('panel').querySelectorAll('.room, .thing')) /** @type {any} */ (part).refresh?.();
  }

  // --- sensors

  sensors() {
    const { home } = this;
    this.filter ??= el('input', { type: 'search', placeholder: t('Name or kind'), 'aria-label': t('Filter'), oninput: () => this.rebuildRows() });
    this.table = el('tbody');
    this.rebuildRows();
    return [this.plots.element, el('div', { class: 'tools' }, this.filter,
      ...(home.status.replay ? [] : [el('button', { type: 'button', order: 'spawn', onclick: () => this.page.addSensor() }, t('Add a sensor …')),
        el('button', { type: 'button', order: 'save', onclick: () => this.page.save() }, t('Save world'))])),
    el('table', {}, el('colgroup', {}, el('col', { style: 'width: 44px' }), el('col'), el('col', { style: 'width: 38%' })),
      el('thead', {}, el('tr', {}, el('th', {}, el('span', { class: 'soft' }, t('Plot'))), el('th', {}, t('Name')), el('th', {}, t('Reading')))), this.table)];
  }

  rebuildRows() {
    const { home } = this, word = this.filter.value.trim().toLowerCase();
    this.lines.clear();
    const rows = [...home.rows.values()].filter((row) => home.kinds[row.kind]?.role === 'sensor' && (!word || `${row.kind} ${row.name}`.toLowerCase().includes(word)))
      .sort((a, b) => a.kind.localeCompare(b.kind) || a.name.localeCompare(b.name, undefined, { numeric: true })).slice(0, 400);
    this.table.replaceChildren(...rows.map((row) => {
      const e = home.entities.find((one) => one.kind === row.kind && one.name === row.name);
      const now = home.told(row), text = el('td', { class: 'number', title: now }, now || '–');
      const fields = home.fields(row.kind).length > 0;
      const line = el('tr', {}, el('td', {}, fields && el('button', { type: 'button', 'aria-label': t('Plot {kind} {name}', { kind: words(row.kind), name: row.name }), onclick: () => this.plots.add(row.kind, row.name) }, '+')),
        el('td', { title: `${words(row.kind)} ${row.name}` }, e ? el('button', { type: 'button', style: 'border: 0; background: none; padding: 0', onclick: () => this.page.show(e) }, row.name) : row.name, ' ', el('span', { class: 'soft' }, words(row.kind))), text);
      this.lines.set(`${row.kind}/${row.name}`, { line, text });
      return line;
    }));
    this.count = home.rows.size;
    this.refreshSensors();
  }

  refreshSensors() {
    if (this.home.rows.size !== this.count) { this.rebuildRows(); return; }
    for (const [key, { line, text }] of this.lines) {
      const { home } = this, row = home.rows.get(key);
      if (!row) continue;
      const now = home.told(row);
      if (text.textContent !== now) { text.textContent = now || '–'; text.title = now; }
      line.classList.toggle('alarm', row.alarm);
    }
  }

  // --- events

  events() {
    this.eventFilter ??= el('input', { type: 'search', placeholder: t('Filter'), 'aria-label': t('Filter'), oninput: () => this.refreshEvents() });
    this.small ??= el('input', { type: 'checkbox', onchange: () => this.refreshEvents() });
    this.list = el('ol', { class: 'events', reversed: true });
    return [el('div', { class: 'tools' }, this.eventFilter, el('label', { title: t('Light that changes, surfaces that warm') }, this.small, ` ${t('Small changes')}`)), this.list];
  }

  refreshEvents() {
    const word = this.eventFilter.value.trim().toLowerCase();
    const text = (/** @type {string[]} */ [kind, source, event, detail]) => `${source} ${noun(kind)} ${happened(event)} ${measured(detail)} ${detail} ${kind} ${event}`.toLowerCase();
    const shown = this.home.events.filter(([, ...texts]) => (this.small.checked || !SMALL.has(texts[2])) && (!word || text(texts).includes(word))).slice(-200).reverse();
    this.list.replaceChildren(...shown.map(([time, kind, source, event, detail]) => el('li', {}, el('time', { class: 'soft number' }, this.home.clock(time)),
      el('span', { class: event }, el('b', {}, source), ` ${noun(kind)} ${happened(event)}`, detail ? el('span', { class: 'soft' }, ` ${measured(detail)}`) : ''))));
    if (!shown.length) this.list.append(el('li', {}, '', el('span', { class: 'soft' }, t('No events.'))));
  }

  // --- costs

  costs() {
    this.costBox = el('div');
    return [el('p', { class: 'soft' }, t('CPU time per simulated second, as angen top shows it.')), this.costBox];
  }

  refreshCosts() {
    const { cost, stats } = this.home;
    if (!cost) {
      this.costBox.textContent = this.home.status.replay ? t('A recording has no costs.') : t('Measuring …');
      return;
    }
    const ms = (/** @type {number} */ us) => (us >= 1000 ? `${numbers((us / 1000).toFixed(1))} ms` : `${us.toFixed(0)} µs`);
    const most = Math.max(1, ...cost.instances.map((/** @type {any} */ one) => one[2]));
    this.costBox.replaceChildren(
      el('table', {}, ...Object.entries(cost.parts).map(([part, us]) => el('tr', {}, el('td', {}, words(part)), el('td', { class: 'number' }, ms(/** @type {number} */ (us)))))),
      el('p', { class: 'soft' }, t('{models} models, {devices} devices, {sensors} sensors, {awake} awake bodies', stats)),
      el('h3', {}, t('Devices and sensors')),
      el('table', {}, ...cost.instances.slice(0, 40).map((/** @type {any} */ [kind, name, us]) => el('tr', {}, el('td', {}, `${name} `, el('span', { class: 'soft' }, kind)),
        el('td', {}, el('div', { class: 'bar' }, el('i', { style: `width: ${(100 * us) / most}%` }))), el('td', { class: 'number', style: 'width: 80px' }, ms(us))))));
  }
}

const ORDER = ['lamp', 'door', 'window', 'elevator', 'stove', 'heater', 'appliance'];

/** @param {any} e */
const rank = (e) => (ORDER.includes(e.kind) ? ORDER.indexOf(e.kind) : ORDER.length);
