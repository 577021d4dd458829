/** The card of one device, sensor or room: its state and its commands, as its kind describes them. */
import { denied } from './access.js';
import { by, el, glyph, words } from './dom.js';
import { middleOf } from './home.js';
import { floorText, roomText } from './labels.js';
import { numbers, t } from './lang.js';

export class Card {
  /** @param {import('./home.js').Home} home @param {any} page choosePoint, plot, robot, isTold, say */
  constructor(home, page) {
    this.home = home;
    this.page = page;
    this.element = by('card');
    /** @type {any} */
    this.shown = null;
    /** @type {(() => void)[]} of sliders, which follow the state while they are not dragged */
    this.follow = [];
    for (const topic of ['rows', 'trips']) home.on(topic, () => this.refresh());
    home.on('entities', () => this.again());
  }

  close() {
    this.shown = null;
    this.element.hidden = true;
    this.from?.focus?.();
  }

  again() {
    if (this.shown?.entity) {
      const { kind, name } = this.shown.entity;
      const entity = this.home.entities.find((e) => e.kind === kind && e.name === name);
      if (!entity) this.close();
    } else if (this.shown?.room) this.showRoom(this.shown.room, this.shown.point);
    else if (this.shown) this.showPlace(this.shown.point);
  }

  /** @param {string} title @param {string[]} under @param {any[]} content */
  open(title, under, content) {
    const active = /** @type {any} */ (document.activeElement), byKey = active?.matches(':focus-visible') ?? false;
    if (this.element.hidden) this.from = active;
    this.element.hidden = false;
    this.element.setAttribute('aria-label', title);
    this.element.replaceChildren(el('header', {}, el('div', {}, el('h2', {}, title), el('div', { class: 'soft' }, ...under.flatMap((text, i) => [i ? ' · ' : '', el('span', {}, text)]))),
      el('button', { class: 'icon', type: 'button', 'aria-label': t('Close'), onclick: () => this.close() }, '✕')), ...content);
    if (byKey && !this.element.contains(active)) this.element.focus(); // the next Tab is in the card
  }

  /** @param {any} entity */
  show(entity) {
    this.shown = { entity };
    this.follow = [];
    const { home } = this, kind = home.kinds[entity.kind];
    const rooms = home.roomsOf(entity).map(roomText).join(' – ');
    this.state = el('p', { class: 'state', role: 'status' });
    const parts = [this.state, ...this.verbs(entity, kind)];
    if (home.isRobot(entity)) parts.push(...trip(home, this.page, entity));
    parts.push(el('div', { class: 'verbs' }, home.isRobot(entity) && el('button', { type: 'button', order: 'drive', onclick: () => this.page.robot(entity) }, t('Drive')),
      this.page.sees(entity) && el('button', { type: 'button', onclick: () => this.page.look(entity) }, entity.kind === 'person' ? t('Through the eyes') : t('Its view')),
      home.fields(entity.kind).length > 0 && el('button', { type: 'button', onclick: () => this.page.plot(entity) }, t('Plot'))));
    if (kind?.role === 'sensor' && !home.status.replay) {
      parts.push(el('div', { class: 'verbs' }, el('button', { type: 'button', order: 'delete', onclick: () => this.remove(entity) }, t('Delete'))));
    }
    const beside = home.ofModel(entity.model).filter((e) => e !== entity).slice(0, 12);
    if (beside.length) parts.push(el('h3', {}, t('Of the same model')), ...beside.map((e) => thingRow(home, e, () => this.show(e))));
    this.open(entity.name, [home.isRobot(entity) ? t('Robot') : words(entity.kind), rooms, t(kind?.doc ?? '')].filter(Boolean), parts);
    this.refresh();
  }

  /** @param {any} entity @param {any} kind */
  verbs(entity, kind) {
    if (this.home.status.replay) return [];
    const plain = [], rows = [];
    for (const verb of kind?.verbs ?? []) {
      const send = (/** @type {string | number} */ value) => this.home.command(entity, value === '' ? verb.name : `${verb.name} ${value}`);
      if (!verb.argument) plain.push(el('button', { type: 'button', title: t(verb.doc), 'data-verb': verb.name, order: 'command', onclick: () => send('') }, spaced(verb.name)));
      else if (verb.type === 'integer' && verb.argument === 'floor') plain.push(...this.floors(send));
      else if (verb.count === 2 && verb.argument === 'x y') {
        plain.push(el('button', { type: 'button', title: t(verb.doc), 'data-verb': verb.name, order: 'command',
          onclick: () => this.page.choosePoint(t('{verb}: a place for {name}', { verb: spaced(verb.name), name: entity.name }), Array.from(this.home.place(entity)), (/** @type {number[]} */ p) => send(`${p[0].toFixed(2)} ${p[1].toFixed(2)}${verb.place && this.home.storeys.length > 1 ? ` ${this.home.storeyAt(p[2])}` : ''}`)) }, `${spaced(verb.name)} …`));
      } else if (verb.count === 1) rows.push(this.slider(entity, verb, send));
    }
    return [el('div', { class: 'verbs' }, ...plain), ...(rows.length ? [el('div', { class: 'verbs' }, ...rows)] : [])];
  }

  /** @param {(value: number) => void} send */
  floors(send) {
    return [...this.home.storeys].reverse().map((storey) => el('button', { type: 'button', title: floorText(storey), order: 'command', onclick: () => send(storey.number) }, t('Floor {number}', { number: storey.number })));
  }

  /** @param {any} entity @param {any} verb @param {(value: string | number) => void} send */
  slider(entity, verb, send) {
    const value = this.valueOf(entity, verb);
    if (verb.min === null || verb.max === null || verb.max - verb.min > 1000) {
      const input = el('input', { type: 'number', step: 'any', min: verb.min, max: verb.max, value: value ?? '', order: 'command' });
      return el('label', {}, el('span', {}, spaced(verb.name)), input, el('span', { class: 'soft' }, verb.unit),
        el('button', { type: 'button', order: 'command', onclick: () => input.value !== '' && send(Number(input.value)) }, t('Send')));
    }
    const fine = verb.max - verb.min <= 5, output = el('output', { class: 'number' });
    const input = el('input', { type: 'range', min: verb.min, max: verb.max, step: fine ? 0.01 : 1, 'data-verb': verb.name, value: value ?? verb.min, order: 'command' });
    const say = () => { output.textContent = `${numbers(Number(input.value))} ${verb.unit}`; };
    input.addEventListener('input', say);
    input.addEventListener('change', () => send(Number(input.value)));
    say();
    this.follow.push(() => {
      const now = this.valueOf(entity, verb);
      if (now === null || input === document.activeElement || Number(input.value) === now) return;
      input.value = String(now);
      say();
    });
    return el('label', { title: t(verb.doc) }, el('span', {}, spaced(verb.name)), input, output);
  }

  /**
   * The field that a verb sets, by its unit: percent, lx, …
   * @param {any} entity
   * @param {any} verb
   */
  valueOf(entity, verb) {
    const fields = this.home.fields(entity.kind), at = fields.findIndex((field) => field.unit === verb.unit);
    return at < 0 ? null : this.home.row(entity)?.values[at] ?? null;
  }

  /** @param {any} entity */
  async remove(entity) {
    const own = this.home.ofModel(entity.model).length === 1;
    const answer = await this.home.order({ do: 'delete', name: own ? entity.model : entity.name });
    if (answer.ok) this.close();
  }

  /** @param {any} room @param {number[]} [point] */
  showRoom(room, point) {
    const { home } = this;
    this.shown = { room, point };
    this.state = null;
    const things = home.entities.filter((e) => e.kind !== 'model' && home.roomsOf(e).includes(room));
    const devices = things.filter((e) => home.kinds[e.kind]?.role === 'device'), sensors = things.filter((e) => home.kinds[e.kind]?.role === 'sensor');
    const parts = [...devices.map((e) => thingRow(home, e, () => this.show(e)))];
    if (sensors.length) parts.push(el('h3', {}, t('Sensors')), ...sensors.map((e) => thingRow(home, e, () => this.show(e))));
    const middle = middleOf(room.polygon), [x, y] = point ?? middle;
    if (!home.status.replay && !denied('spawn')) parts.push(el('h3', {}, t('Add a sensor')), this.adder(room.name, [x, y, room.floor], middle));
    this.open(roomText(room), [`${words(room.use)}, ${t('floor {number}', { number: room.storey })}, ${numbers(room.area.toFixed(1))} m²`], parts);
  }

  /**
   * A place in no room.
   * @param {number[]} point
   */
  showPlace(point) {
    this.shown = { point };
    this.state = null;
    this.open(t('Outside of all rooms'), [], [el('h3', {}, t('Add a sensor')), this.adder('', point, point)]);
  }

  /**
   * @param {string} room for the name
   * @param {number[]} point on the floor
   * @param {number[]} faced
   */
  adder(room, point, faced) {
    const { home } = this, [dx, dy] = [faced[0] - point[0], faced[1] - point[1]];
    const input = (/** @type {string} */ label, /** @type {number} */ value, more = {}) => el('input', { type: 'number', value, step: 0.1, 'aria-label': label, ...more });
    const x = input(t('x in m'), Number(point[0].toFixed(2))), y = input(t('y in m'), Number(point[1].toFixed(2)));
    const turn = input(t('Heading in degrees'), Math.hypot(dx, dy) > 0.5 ? Math.round((Math.atan2(dy, dx) * 36) / Math.PI) * 5 : 0, { step: 5 });
    const kinds = Object.values(home.kinds).filter((kind) => kind.role === 'sensor' && kind.models.length).map((kind) => kind.kind).sort();
    const kind = el('select', { 'aria-label': t('Kind') }, ...kinds.map((name) => el('option', { value: name, selected: name === 'pir' }, words(name))));
    const height = input(t('Height in m'), 1.2, { min: 0, max: 10 });
    const name = el('input', { type: 'text', 'aria-label': t('Name') });
    const propose = () => {
      let n = 1;
      const stem = `${room.replaceAll(/[:/]/g, '_')}${room ? '_' : ''}${kind.value}`; // no topic may have these
      while (home.entities.some((e) => e.name === `${stem}_${n}`)) n++;
      name.value = `${stem}_${n}`;
    };
    propose();
    kind.addEventListener('change', propose);
    const add = async () => {
      const pose = { x: Number(x.value), y: Number(y.value), z: point[2] + Number(height.value), roll: 0, pitch: 0, yaw: (Number(turn.value) * Math.PI) / 180 };
      const answer = await home.order({ do: 'spawn', kind: kind.value, name: name.value, pose });
      if (answer.ok) this.page.say(answer.text);
    };
    const field = (/** @type {string} */ text, /** @type {any} */ value, /** @type {string} */ unit) => el('label', {}, el('span', {}, text), value, el('span', { class: 'soft' }, unit));
    return el('div', { class: 'adder' }, kind, name, field('x', x, 'm'), field('y', y, 'm'), field(t('height'), height, 'm'), field(t('faces'), turn, '°'),
      el('button', { class: 'main', type: 'button', id: 'add', order: 'spawn', onclick: add }, t('Add')));
  }

  refresh() {
    if (this.state && this.shown?.entity) {
      const row = this.home.row(this.shown.entity), told = this.home.told(this.shown.entity), isSensor = this.home.kinds[this.shown.entity.kind]?.role === 'sensor';
      const text = (told && this.home.isRobot(this.shown.entity) ? placeText(this.home.place(this.shown.entity), told) : told) || (!this.page.isTold(this.shown.entity) ? t('The recording does not have it.') : isSensor ? t('no reading yet') : '–');
      if (this.state.textContent !== text) this.state.textContent = text;
      this.state.classList.toggle('alarm', Boolean(row?.alarm));
      for (const follow of this.follow) follow();
    }
    for (const update of this.element.querySelectorAll('.thing')) /** @type {any} */ (update).refresh?.();
  }
}

/**
 * FrontLeft as "Front left".
 * @param {string} name
 */
const spaced = (name) => words(name.replace(/([a-z])([A-Z])/g, '$1 $2').toLowerCase());

/**
 * "ON 40 % 320 lm" as "on 40 %": beside a switch that is enough.
 * @param {string} text @param {boolean} on
 */
const shortState = (text, on) => `${text.split(' ')[0].toLowerCase()}${on ? / \d+ %/.exec(text)?.[0] ?? '' : ''}`;

/** @param {import('./home.js').Home} home @param {any} e */
function title(home, e) {
  const kind = home.isRobot(e) ? t('Robot') : words(e.kind);
  return e.name === e.kind ? kind : `${kind} ${e.name}`;
}

/**
 * The place of a robot in the world, as people have it, before that by its wheels.
 * @param {ArrayLike<number>} pose @param {string} text
 */
const placeText = (pose, text) => t('{x} m  {y} m in the world, by its wheels {text}', { x: numbers(pose[0].toFixed(2)), y: numbers(pose[1].toFixed(2)), text });

/**
 * The activity of a person, the speed of a robot: their places are visible.
 * @param {import('./home.js').Home} home @param {any} e @param {string} text
 */
function motion(home, e, text) {
  if (!home.isRobot(e)) return text.split('  ')[0].toLowerCase();
  const speed = home.row(e)?.values[home.fields(e.kind).findIndex((field) => field.unit === 'm/s')];
  return typeof speed === 'number' ? `${numbers(Math.abs(speed).toFixed(2))} m/s` : text;
}

/**
 * A line of a list: name, state, and a switch where the kind has two opposite verbs.
 * @param {import('./home.js').Home} home
 * @param {any} e
 * @param {() => void} open
 * @returns {any}
 */
export function thingRow(home, e, open) {
  const state = el('span', { class: 'state number' });
  const verbs = (home.kinds[e.kind]?.verbs ?? []).filter((/** @type {any} */ v) => !v.argument).map((/** @type {any} */ v) => v.name);
  const pair = [['On', 'Off'], ['Open', 'Close']].find(([a, b]) => verbs.includes(a) && verbs.includes(b));
  const toggle = pair && !home.status.replay ? el('button', { type: 'button', order: 'command' }) : null;
  const row = el('div', { class: 'thing' }, el('span', { class: 'glyph', 'aria-hidden': 'true' }, glyph(e.kind)),
    el('button', { class: 'name', type: 'button', title: e.name, onclick: open }, title(home, e)), state, toggle);
  row.refresh = () => {
    const now = home.row(e), text = home.told(e), on = Boolean(pair) && home.isOn(now);
    const shown = pair ? shortState(text, on) : home.isMover(e) ? motion(home, e, text) : text;
    if (state.textContent !== shown) { state.textContent = shown; state.title = text; }
    row.classList.toggle('on', on);
    row.classList.toggle('alarm', Boolean(now?.alarm));
    if (toggle && pair) { toggle.dataset.verb = on ? pair[1] : pair[0]; toggle.textContent = t(toggle.dataset.verb ?? ''); }
  };
  toggle?.addEventListener('click', () => home.command(e, toggle.dataset.verb));
  row.refresh();
  return row;
}

/**
 * A menu of goals of a robot, and what becomes of its drive to one.
 * @param {import('./home.js').Home} home @param {any} page @param {any} robot
 * @returns {any[]}
 */
export function trip(home, page, robot) {
  if (home.status.replay) return [];
  const send = () => {
    if (goals.value) home.order({ do: 'goal', name: robot.name, room: goals.value });
    else page.goal.begin(robot);
    goals.selectedIndex = 0;
  };
  const goals = el('select', { class: 'goals', 'aria-label': t('Send {name} to', { name: robot.name }), order: 'goal', onchange: send }, el('option', { hidden: true }, t('Go to …')), el('option', { value: '' }, t('a place …')),
    ...[...home.storeys].reverse().map((storey) => el('optgroup', { label: floorText(storey) },
      ...home.rooms.filter((room) => room.storey === storey.number).map((room) => el('option', { value: room.name }, roomText(room))))));
  const text = el('span', { role: 'status' }), done = el('i'), bar = el('div', { class: 'bar' }, done);
  const stop = el('button', { type: 'button', order: 'halt', onclick: () => home.order({ do: 'halt', name: robot.name }) }, t('Stop'));
  const row = el('div', { class: 'thing trip' }, el('div', {}, text, bar), stop);
  row.refresh = () => {
    const now = home.trips[robot.name], shown = now ? t('To {goal}: {text}', { goal: now.goal, text: numbers(now.text) }) : '';
    row.hidden = !now;
    stop.hidden = !now?.drives;
    bar.hidden = !now?.drives || now.share === null;
    done.style.width = `${100 * (now?.share ?? 0)}%`;
    if (text.textContent !== shown) text.textContent = shown;
  };
  row.refresh();
  return [el('div', { class: 'verbs' }, goals), row];
}
