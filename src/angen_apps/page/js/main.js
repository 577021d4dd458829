/** The page: the selection, the clock, the keys. */
import { accessed, denied } from './access.js';
import { by, download, el, isForOthers, isNarrow, limit, notice } from './dom.js';
import { Card } from './card.js';
import { Carry } from './carry.js';
import { sunAt } from './daylight.js';
import { Goal } from './goal.js';
import { Home } from './home.js';
import { floorText } from './labels.js';
import { numbers, t } from './lang.js';
import { Panels } from './panels.js';
import { Plan } from './plan.js';
import { Player } from './player.js';
import { beginTheme, setTheme, showKeys } from './settings.js';
import { share } from './share.js';
import { View3d } from './view3d.js';

const NO_3D = t('This browser has no WebGL, which the 3D view needs: the plan has everything.');
const EMPTY = t('This world has no rooms and no devices.');
const DUSK = 0.1; // sine of the sun's height, below which lamps are wanted
/** @type {Record<string, string>} */
const LIVE = { look: t('Live, to look only'), switch: t('Live, to switch only') };
const RATES = [0.1, 0.5, 1, 2, 5, 10, 100, 0];

class Page {
  constructor() {
    this.home = new Home();
    this.storey = /** @type {number | null} */ (null);
    /** @type {((point: number[]) => void) | null} */
    this.choosing = null;
    const pick = (/** @type {any} */ hit) => this.pick(hit);
    this.player = new Player(this.home);
    /** @type {import('./record.js').Recorder | undefined} */
    this.recording = undefined;
    this.plan = new Plan(this.home, pick);
    try {
      this.view = new View3d(this.home, pick);
    } catch {
      this.view = null;
      notice(NO_3D, true);
    }
    this.goal = new Goal(this.home, this);
    this.card = new Card(this.home, this);
    this.panels = new Panels(this.home, this);
    this.buildBar();
    this.buildFloors();
    this.buildLayers();
    this.carry = new Carry(this.home, this);
    for (const topic of ['status', 'access']) this.home.on(topic, () => this.showStatus());
    this.home.on('stats', () => this.showClock());
    this.home.on('home', () => this.buildFloors());
    for (const topic of ['status', 'scene', 'home', 'entities']) this.home.on(topic, () => { this.showNothing(); this.begin(); });
    setInterval(() => this.showClock(), 200);
    addEventListener('keydown', (e) => this.key(e));
    addEventListener('hashchange', () => { if (location.hash === '#home') this.whole(); });
    this.showNothing();
    beginTheme((theme) => this.setTheme(theme));
    this.setView(this.view && !isNarrow() ? '3d' : 'plan');
    if (isNarrow()) by('side').classList.add('low');
    this.home.begin();
  }

  // --- the bar

  buildBar() {
    const { home } = this;
    const ask = (/** @type {string} */ what, more = {}) => () => home.order({ do: what, ...more });
    this.time = el('time', { class: 'number', role: 'timer', 'aria-label': t('Simulated time') });
    this.play = el('button', { type: 'button', id: 'play', class: 'icon', order: 'pause', onclick: () => home.order({ do: home.stats.paused ? 'resume' : 'pause' }) });
    this.rate = el('select', { id: 'rate', 'aria-label': t('Speed'), order: 'rate', onchange: () => home.order({ do: 'rate', rate: Number(this.rate.value) }) },
      ...RATES.map((rate) => el('option', { value: rate, selected: rate === 1 }, rate ? `${numbers(rate)}×` : t('max'))));
    this.factor = el('span', { class: 'soft number wide' });
    by('clock').append(this.time, this.play,
      el('button', { type: 'button', class: 'wide', title: t('One second on, while paused (.)'), order: 'step', onclick: ask('step', { seconds: 1 }) }, '+1 s'), this.rate,
      el('button', { type: 'button', class: 'wide', title: t('To the start'), order: 'reset', onclick: ask('reset') }, t('Reset')), this.factor);
    for (const [id, text] of [['3d', '3D'], ['plan', t('Plan')]]) {
      by('views').append(el('button', { type: 'button', id: `view-${id}`, disabled: id === '3d' && !this.view, title: id === '3d' && !this.view && NO_3D, onclick: () => this.setView(id) }, text));
    }
    by('help').addEventListener('click', () => this.help());
    by('share').addEventListener('click', () => share());
    home.on('access', () => { by('share').hidden = !accessed().tokens.build; });
    this.showStatus();
  }

  showStatus() {
    const { home } = this;
    const text = !home.connected ? t('No connection to the server') : home.status.replay ? t('Recording') : home.status.node ? (LIVE[accessed().role] ?? t('Live')) : t('Waiting for the simulator');
    by('status').textContent = text;
    by('status').title = denied('spawn');
    by('status').classList.toggle('off', !home.connected || !(home.status.node || home.status.replay));
    by('clock').classList.toggle('replay', home.status.replay);
    for (const control of by('clock').querySelectorAll('button, select')) {
      limit(control, control.dataset.order);
      control.disabled ||= !home.connected || !home.status.node;
    }
    this.showClock();
  }

  /** Why there is no home to see. */
  showNothing() {
    const { connected, status, scene, described, rooms, entities } = this.home, known = scene && described;
    const text = known ? (rooms.length || entities.some((e) => e.kind !== 'model') ? '' : status.replay ? EMPTY : `${EMPTY} ${t('Click the ground to add a sensor.')}`)
      : !connected ? t('Connecting to the server …') : status.replay ? t('Reading the recording …')
        : status.node ? t('Loading the home …') : t('Waiting for a simulator: ./angen run starts one');
    by('nothing').textContent = text;
    by('nothing').hidden = !text;
  }

  showClock() {
    const { stats, status } = this.home;
    if (!this.time) return;
    const since = Math.min(1.2, (performance.now() - this.home.statsAt) / 1000);
    const now = stats.time + (stats.paused || !status.node ? 0 : since * stats.factor);
    const text = this.home.clock(now);
    if (this.time.textContent !== text) this.time.textContent = text;
    this.time.title = t('{time} s simulated', { time: numbers(now.toFixed(1)) });
    const play = stats.paused ? '▶' : '❚❚';
    if (this.play.textContent !== play) {
      this.play.textContent = play;
      this.play.title = denied('pause') || (stats.paused ? t('Go on (space)') : t('Pause (space)'));
      this.play.setAttribute('aria-label', stats.paused ? t('Go on') : t('Pause'));
    }
    this.factor.textContent = status.node ? `${stats.paused ? t('paused') : t('{factor}× real time', { factor: numbers(stats.factor.toFixed(stats.factor < 10 ? 2 : 0)) })}${status.seed === undefined ? '' : `, ${t('seed {seed}', { seed: String(status.seed) })}`}` : '';
  }

  /** @param {string} theme */
  setTheme(theme) {
    setTheme(theme);
    this.view?.setTheme(theme === 'dark');
    this.panels.plots.restyle();
    this.player.ribbonStale = true;
  }

  /** @param {string} id */
  setView(id) {
    if (!this.view) id = 'plan';
    if (id === 'plan') this.view?.eyes.end();
    by('scene').hidden = id !== '3d';
    by('labels').hidden = id !== '3d';
    by('plan').hidden = id !== 'plan';
    for (const other of ['3d', 'plan']) by(`view-${other}`).setAttribute('aria-pressed', String(other === id));
    if (this.view) this.view.hidden = id !== '3d';
    this.plan.hidden = id !== 'plan';
    for (const control of by('layers').children) control.hidden = id === 'plan' && !control.classList.contains('both');
    this.plan.stale = true;
    this.plan.draw();
    this.view?.resize();
    this.buildFloors();
  }

  // --- floors and layers

  /** The first view: the floor with the most people, or robots. */
  begin() {
    const { home } = this, { storeys, movers } = home;
    if (this.begun || !storeys.length || !home.scene || !home.entities.length || !Object.keys(home.kinds).length) return;
    this.begun = true;
    const people = movers.filter((e) => e.kind === 'person'), on = (people.length ? people : movers).map((e) => home.storeyAt(home.place(e)[2]));
    const count = (/** @type {number} */ number) => on.filter((one) => one === number).length;
    if (storeys.length > 1 && on.length) this.setStorey([...storeys].sort((a, b) => count(b.number) - count(a.number))[0].number);
    this.welcome();
  }

  buildFloors() {
    const { storeys } = this.home, many = storeys.length > 1;
    const plan = this.plan.hidden === false;
    const shown = plan && this.storey === null ? storeys[0]?.number : this.storey;
    const button = (/** @type {number | null} */ number, /** @type {string} */ text) => el('button', { type: 'button', 'aria-pressed': String(shown === number), onclick: () => this.setStorey(number) }, text);
    by('floors').replaceChildren(...(many ? [...(plan ? [] : [button(null, t('All floors'))]), ...[...storeys].reverse().map((s) => button(s.number, floorText(s)))] : []));
  }

  /** @param {number | null} number */
  setStorey(number) {
    this.storey = number;
    this.view?.setStorey(number);
    this.plan.setStorey(number);
    this.buildFloors();
    this.panels.rebuild();
  }

  buildLayers() {
    this.walls = el('select', { 'aria-label': t('Walls'), onchange: () => this.view?.setWalls(this.walls.value) },
      el('option', { value: 'cut' }, t('Low walls')), el('option', { value: 'clear' }, t('See-through walls')), el('option', { value: 'full' }, t('Whole walls')));
    const fields = el('button', { type: 'button', 'aria-pressed': 'false', title: t('Fields of view of sensors, and scans of lidars (F)') }, t('Sensor fields'));
    fields.addEventListener('click', () => {
      const on = fields.getAttribute('aria-pressed') !== 'true';
      fields.setAttribute('aria-pressed', String(on));
      this.view?.setFields(on);
      const lidars = this.home.entities.filter((e) => e.type === 'sensor_msgs/LaserScan' && e.topic);
      this.home.connection.subscribe('fields', on ? lidars.slice(0, 4).map((e) => `scan:${e.name}`) : []);
      this.plan.withFields = on;
      this.plan.update();
    });
    this.fieldsButton = fields;
    fields.classList.add('both');
    this.record = el('button', { type: 'button', id: 'record', class: 'both', 'aria-pressed': 'false', title: t('Records a video of the home, until it is pressed again'), onclick: async () => {
      this.record.setAttribute('aria-pressed', String((await this.recorder()).toggle()));
    } }, t('Record'));
    by('layers').append(this.walls, fields, el('button', { type: 'button', title: t('From above (P)'), onclick: () => this.view?.look(true) }, t('From above')),
      el('button', { type: 'button', title: t('The whole home (H)'), onclick: () => this.whole() }, t('Whole home')),
      el('button', { type: 'button', id: 'picture', class: 'both', title: t('Saves a picture of the home'), onclick: async () => (await this.recorder()).picture() }, t('Picture')), this.record);
  }

  /** @returns {Promise<import('./record.js').Recorder>} what is loaded when it is used */
  async recorder() {
    const { Recorder } = await import('./record.js');
    return (this.recording ??= new Recorder(this));
  }

  whole() {
    if (this.plan.hidden) this.view?.look();
    else this.plan.zoom.whole();
  }

  // --- choosing

  /** What to try, until something is tried. */
  welcome() {
    const { home } = this, robot = home.movers.some((e) => home.isRobot(e)) && !home.status.replay && !denied('goal');
    const dark = (sunAt(home.described, home.stats.time)?.[2] ?? 1) < DUSK && home.entities.some((e) => e.kind === 'lamp');
    const what = home.status.replay ? t('a person or a room, or the line below') : dark && !denied('command') ? t('a lamp and switch it on: it is dark') : t('a door, lamp, person or room');
    by('welcome').textContent = `${isNarrow() ? t('Tap {what}', { what }) : t('Click {what}', { what })}${robot ? ` · ${t('drag the robot to another room')}` : ''}`;
    by('welcome').hidden = localStorage.getItem('welcome') === 'seen';
    const seen = () => { by('welcome').hidden = true; localStorage.setItem('welcome', 'seen'); };
    by('stage').addEventListener('pointerdown', seen, { once: true, capture: true }); // also one that sets a goal
  }

  /** @param {any} hit */
  pick(hit) {
    const { home } = this;
    if (this.choosing && hit.point) {
      const choose = this.choosing;
      this.stopChoosing();
      choose(hit.point);
      return;
    }
    if (hit.entity) { this.show(hit.entity); return; }
    const own = hit.model === undefined ? [] : home.ofModel(hit.model);
    const devices = own.filter((e) => home.kinds[e.kind]?.role === 'device');
    const first = devices.find((e) => home.kinds[e.kind].verbs.length) ?? devices[0] ?? own[0];
    if (first && hit.cls !== 'floor' && hit.cls !== 'wall') { this.show(first); return; }
    this.place(hit.point);
  }

  /** @param {number[]} point */
  place(point) {
    const { home } = this, [x, y, z] = point, room = home.roomAt(x, y, z) ?? home.roomAt(x, y, z + 0.2);
    if (room) this.showRoom(room, point);
    else if (home.status.replay || denied('spawn') || (home.rooms.length && !this.card.element.hidden)) this.card.close();
    else this.card.showPlace([x, y, Math.min(z, this.goal.floorAt(point))]);
  }

  /** @param {any} entity */
  show(entity) {
    this.card.show(entity);
  }

  /** @param {any} room @param {number[]} [point] */
  showRoom(room, point) {
    this.card.showRoom(room, point);
  }

  /** @param {string} text @param {number[]} from where keys begin @param {(point: number[]) => void} then */
  choosePoint(text, from, then) {
    this.choosing = then;
    this.goal.mark(from, (point) => { this.stopChoosing(); then(point); });
    by('hint').textContent = `${text}. ${isNarrow() ? '' : t('Keys: arrows move the mark, Enter takes it, Esc ends')}`;
    by('hint').hidden = false;
  }

  stopChoosing() {
    this.choosing = null;
    this.goal.unmark();
    by('hint').hidden = true;
  }

  addSensor() {
    this.card.close();
    this.choosePoint(t('A place for the sensor: press on the floor'), this.middle(), (point) => {
      this.card.close();
      this.place(point);
      by('add').focus();
    });
  }

  /** @returns {number[]} of the floor that is shown */
  middle() {
    const { rooms, entities, storeys } = this.home, number = this.storey ?? storeys[0]?.number;
    const places = rooms.filter((room) => room.storey === number).flatMap((room) => room.polygon);
    if (!places.length) places.push(...entities.filter((e) => e.kind !== 'model').map((e) => e.pose), [0, 0]);
    const [xs, ys] = [places.map(([x]) => x), places.map(([, y]) => y)], half = (/** @type {number[]} */ all) => (Math.min(...all) + Math.max(...all)) / 2;
    return [half(xs), half(ys), storeys.find((s) => s.number === number)?.elevation ?? 0];
  }

  /** @param {any} entity @returns {boolean} whether its state is shown */
  isTold(entity) {
    return !this.home.status.replay || this.player.has(`${entity.kind}/${entity.name}`);
  }

  /** @param {any} entity */
  plot(entity) {
    this.panels.plots.add(entity.kind, entity.name);
  }

  /** @param {any} entity @returns {boolean} whether there is a view from it */
  sees(entity) { return this.view?.eyes.has(entity) ?? false; }

  /** @param {any} entity from which one looks */
  look(entity) {
    if (!this.view) return;
    this.card.close();
    this.setView('3d');
    this.view.eyes.begin(entity, () => { by('hint').hidden = true; });
    by('hint').replaceChildren(`${t('As {name} sees it', { name: entity.name })} `, el('button', { type: 'button', id: 'leave', title: t('Esc'), onclick: () => this.view?.eyes.end() }, t('Leave')));
    by('hint').hidden = false;
  }

  /** @param {any} entity */
  robot(entity) {
    this.panels.robot.name = entity.name;
    this.panels.open('robot');
  }

  rebuild() { this.panels.rebuild(); }
  refreshThings() { this.panels.refreshRooms(); }
  say(/** @type {string} */ text) { notice(text); }

  async save() {
    const answer = await this.home.order({ do: 'save' });
    if (answer.ok) download('saved.world', answer.xml ?? '', 'application/xml');
  }

  // --- keys

  /** @param {KeyboardEvent} e */
  key(e) {
    const target = /** @type {any} */ (e.target);
    if (isForOthers(e)) return;
    if (e.key === 'Escape') {
      if (this.choosing) this.stopChoosing();
      else if (this.view?.eyes.entity) this.view.eyes.end();
      else this.card.close();
      return;
    }
    const { storeys, status: { replay } } = this.home;
    /** @type {Record<string, () => void>} */
    const keys = {
      ' ': () => { if (target.tagName !== 'BUTTON' && target.getAttribute?.('role') !== 'button') (replay ? this.player : this).play?.click(); },
      '.': () => { if (!replay && !denied('step')) this.home.order({ do: 'step', seconds: 1 }); }, n: () => { if (replay) this.player.next(); },
      h: () => this.whole(), p: () => this.view?.look(true),
      f: () => this.fieldsButton.click(), t: () => by('theme').click(), v: () => this.setView(this.plan.hidden ? 'plan' : '3d'),
      '*': () => this.setStorey(null), '?': () => this.help(),
    };
    const storey = /^\d$/.test(e.key) ? storeys.find((s) => s.number === Number(e.key)) : null;
    if (storey) this.setStorey(storey.number);
    else keys[e.key.toLowerCase()]?.();
  }

  help() {
    showKeys([[t('Click'), t('a door, lamp, person, sensor or floor: what it is and does')], [t('Drag'), t('turns the view; with the right button or two fingers it moves')], [t('Wheel'), t('zooms')],
      [t('Space'), t('pauses')], ['.', t('one second on, while paused')], ['N', t('the next event, in a recording')], ['0 – 9, *', t('a floor, all floors')], ['H, P', t('the whole home, from above')], ['V', t('3D or plan')], ['F', t('sensor fields')],
      ['T', t('light or dark')], ['W A S D', t('drive the robot, in its tab')], [t('Drag the robot'), t('its goal')], ['M', t('moves things: drag them; by keys . and , choose one, arrows move it, R turns it, Enter puts it there')], [t('Esc'), t('closes')]]);
  }
}

/** @type {any} */ (window).angen = new Page(); // for tests and the console
