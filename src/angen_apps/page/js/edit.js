/** The page of angen edit: a home is drawn, checked while one draws, saved and simulated. */
import { Board } from './board.js';
import { sentence } from './coverage.js';
import { DayPlan } from './dayplan.js';
import { by, el, notice, showDialog } from './dom.js';
import { GRID, HEIGHT, History, apply, copied, empty, innerPoint, keysOf, labelIn, middleOf, removed, shifted, storeyOf, turned, withFloor, within, withoutFloor } from './drawing.js';
import { Form, floorName } from './form.js';
import { help, pressed } from './keys.js';
import { t } from './lang.js';
import { beginTheme, setTheme } from './settings.js';
import { Shelf } from './shelf.js';

const KEEP = 400, SURVEY = 350, AGAIN = 1500; // ms after a change until it is kept, and checked; between tries
const COPIES = 'angen-edit-copies'; // in this browser's session
const TOOLS = [['select', '⬉', t('Select'), 'V'], ['wall', '╱', t('Walls'), 'W'], ['room', '▭', t('Room'), 'Q']];

export class Editor {
  constructor() {
    /** @type {any} */
    this.catalog = { sensors: [], pieces: [] };
    /** @type {Record<string, number[][][]>} */
    this.symbols = {};
    /** @type {string[]} */
    this.profiles = []; // habits that a person can have
    /** @type {Record<string, import('./dayplan.js').Planned[]>} */
    this.days = {}; // the usual day of each
    /** @type {Record<string, number>} */
    this.durations = {}; // s of each activity
    /** @type {History} */
    this.history = /** @type {any} */ (null);
    this.floor = 0;
    /** @type {string[]} */
    this.selection = [];
    /** @type {number | null} index in the rooms that are shown */
    this.room = null;
    /** @type {number[] | null} the place in that room that was pressed */
    this.spot = null;
    this.covers = false; // whether one wants to see what motion sensors see
    /** @type {any} a drawing with a sensor that is aimed, which is not done yet */
    this.trial = null;
    this.tried = ''; // that edit as text
    this.several = false;
    this.closed = true;
    this.thickness = 0.1;
    /** @type {any[]} rooms of all floors, as the server found them */
    this.found = [];
    /** @type {{findings: string[], remarks: string[], ruled?: any[], wrong?: string, coverage?: import('./coverage.js').Coverage | null}} */
    this.told = { findings: [], remarks: [] };
    this.version = 0;
    this.line = Promise.resolve(); // ends with the last change that was sent
    this.connected = true;
    this.dirty = false;
    this.kept = false; // whether the server has the drawing as a draft
    this.base = ''; // the drawing that is saved, as text
    this.place = ''; // the key of the drawing in this browser
    this.board = new Board(this);
    beginTheme(setTheme);
    by('help').addEventListener('click', help);
    by('undo').addEventListener('click', () => this.undo());
    by('redo').addEventListener('click', () => this.redo());
    by('save').addEventListener('click', () => this.save());
    by('simulate').addEventListener('click', () => this.simulate());
    by('a-day').addEventListener('click', () => this.simulate(false, 'day'));
    document.addEventListener('keydown', (e) => pressed(this, e));
    addEventListener('beforeunload', (e) => { if (this.dirty && !this.connected) e.preventDefault(); });
    this.load();
  }

  get storey() { return storeyOf(this.history.now, this.floor); }

  /** The rooms of the floor that is shown. */
  get rooms() { return this.found.filter((room) => room.storey === this.storey.number); }

  /** @returns {any[]} the sensors of that floor that rules have placed */
  get ruled() { return (this.told.ruled ?? []).filter((sensor) => sensor.storey === this.storey.number); }

  /** @returns {number} m of the floor's ceiling over it */
  get ceiling() { return Math.max(...(this.storey.walls ?? []).map((/** @type {any} */ wall) => wall.top - this.storey.elevation), 0) || HEIGHT; }

  // --- the server

  async load() {
    const answer = await fetch('/home.json').catch(() => null);
    if (!answer?.ok) {
      this.setStatus('off', t('No server'));
      setTimeout(() => this.load(), AGAIN);
      return;
    }
    const given = await answer.json();
    Object.assign(this, { catalog: given.catalog, symbols: given.symbols, profiles: given.profiles, days: given.days, durations: given.durations, version: given.version });
    this.given = given;
    this.place = `angen-edit ${given.path}`;
    by('file').textContent = given.file;
    document.title = `${given.file}: Angen`;
    const saved = given.drawing ?? empty(), draft = this.newest(given.draft);
    this.base = given.drawing && !given.saved ? '' : JSON.stringify(saved); // an imported plan is not saved yet
    this.kept = Boolean(given.draft);
    this.history = new History(draft ?? saved);
    this.dirty = JSON.stringify(this.history.now) !== this.base;
    this.closed = Boolean(given.reason);
    this.shelf = new Shelf(this);
    this.form = new Form(this);
    this.dayPlan = new DayPlan(this);
    if (given.behind) this.board.showBehind(given.behind);
    this.buildTools();
    if (this.closed) this.showClosed(given.reason);
    else if (this.dirty && draft) this.ask(t('The changes that were not saved are here again.'), [[t('Continue'), () => {}], [t('Show the saved home'), () => this.discard()]]);
    this.listen();
    this.changed();
    this.board.whole();
  }

  /** @param {{at: number, drawing: any} | null} draft of the server @returns {any} the drawing that was changed last, here or there */
  newest(draft) {
    let own = null;
    try {
      own = JSON.parse(localStorage.getItem(this.place) ?? 'null');
    } catch { /* it is not ours */ }
    const last = own?.drawing?.plan?.storeys?.length && own.at > (draft?.at ?? 0) ? own : draft;
    return last?.drawing ?? null;
  }

  /**
   * Changes follow one another: each is based on the version that the one before has made.
   * @param {string} kind @param {any} [order] @returns {Promise<any>}
   */
  order(kind, order = {}) {
    const turn = this.line.then(() => this.send(kind, order));
    this.line = turn.then((answer) => { if (answer.ok) this.version = answer.version; });
    return turn;
  }

  /** @param {string} kind @param {any} order @returns {Promise<any>} */
  async send(kind, order) {
    try {
      const answer = await fetch(`/do/${kind}`, { method: 'POST', headers: { 'Content-Type': 'application/json' }, body: JSON.stringify({ ...order, base: this.version }) });
      const said = await answer.json();
      this.setConnected(true);
      return { ...said, ok: answer.ok, conflict: answer.status === 409 };
    } catch {
      this.setConnected(false);
      return { ok: false, lost: true, text: t('There is no connection to the server; the drawing is kept in this browser.') };
    }
  }

  listen() {
    const socket = new WebSocket(`${location.protocol === 'https:' ? 'wss' : 'ws'}://${location.host}/windows`);
    socket.onopen = () => { this.setConnected(true); };
    socket.onmessage = (event) => {
      const { windows } = JSON.parse(event.data);
      if (windows > 1 && !this.closed) this.hint(t('This home is open in {windows} windows: change it in one of them', { windows }));
    };
    socket.onclose = () => {
      this.setConnected(false);
      setTimeout(() => this.listen(), AGAIN);
    };
  }

  /** @param {boolean} connected */
  setConnected(connected) {
    const back = connected && !this.connected;
    this.connected = connected;
    this.showStatus();
    if (back && this.dirty) this.later();
  }

  // --- changes

  /** @param {import('./drawing.js').Edit} edit @param {string[]} [selection] after it */
  do(edit, selection = []) {
    if (this.closed) return;
    this.history.do({ ...edit, storey: this.floor });
    this.floor = Math.min(this.floor, this.history.now.plan.storeys.length - 1);
    this.selection = selection;
    this.room = null;
    this.changed();
  }

  /** @param {any} edit @returns {any} the floor as it would be */
  previewed(edit) { return storeyOf(apply(this.history.now, { ...edit, storey: this.floor }), this.floor); }

  undo() { this.step(this.history.undo()); }
  redo() { this.step(this.history.redo()); }

  /** @param {number | null} floor on which something was undone or done again */
  step(floor) {
    if (floor === null) return;
    this.selection = [];
    this.room = null;
    this.goTo(Math.min(floor, this.history.now.plan.storeys.length - 1));
    this.changed();
  }

  /** @param {number} floor that is shown */
  goTo(floor) {
    if (floor === this.floor) return;
    this.floor = floor;
    this.later(); // what its sensors see
  }

  /** Asks for the walls of a further floor, and adds it. */
  addFloor() {
    const add = (/** @type {boolean} */ walled) => {
      this.do(withFloor(this.history.now, walled));
      this.goTo(this.history.now.plan.storeys.length - 1);
      this.show();
    };
    if (this.closed) return;
    if (this.history.now.plan.storeys.every((storey) => !storey.walls)) add(false);
    else this.ask(t('The new floor on top of the home has'), [[t('the walls of the one below'), () => add(true)], [t('no walls'), () => add(false)], [t('Cancel'), () => {}]]);
  }

  removeFloor() {
    if (this.history.now.plan.storeys.length > 1) this.do(withoutFloor(this.history.now, this.floor));
  }

  /** Shows, keeps and checks the drawing. */
  changed() {
    this.dirty = JSON.stringify(this.history.now) !== this.base;
    this.show();
    if (this.closed) return;
    try {
      if (this.dirty) localStorage.setItem(this.place, JSON.stringify({ at: Date.now(), drawing: this.history.now }));
      else localStorage.removeItem(this.place);
    } catch { /* there is no place; the server keeps it too */ }
    this.later();
  }

  later() {
    clearTimeout(this.keeping);
    clearTimeout(this.surveying);
    this.keeping = setTimeout(() => this.keep(), KEEP);
    this.surveying = setTimeout(() => this.survey(), SURVEY);
  }

  async keep() {
    await this.line;
    if (this.conflict || (!this.dirty && !this.kept)) return;
    const answer = await (this.dirty ? this.order('keep', { drawing: this.history.now, at: Date.now() }) : this.order('discard')); // all is undone
    if (answer.conflict) this.showConflict(answer);
    else if (!answer.ok && !answer.lost) notice(t('The draft is not kept: {why}', { why: answer.text }), true);
    this.kept = answer.ok && this.dirty;
    this.showStatus();
  }

  /**
   * Shows what motion sensors would see after an edit that is not done yet; null: there is none.
   * @param {any} edit
   */
  tryOut(edit) {
    const text = edit ? JSON.stringify(edit) : '';
    if (text === this.tried) return;
    this.tried = text;
    this.trial = edit && apply(this.history.now, { ...edit, storey: this.floor });
    this.survey();
  }

  showCoverage() {
    this.covers = !this.covers;
    this.showFindings();
    this.board.draw();
  }

  async survey() {
    if (this.asking) {
      this.stale = true;
      return;
    }
    this.asking = true;
    const { trial } = this, answer = await this.send('survey', { drawing: trial ?? this.history.now, floor: this.storey.number });
    this.asking = false;
    if (trial) this.told.coverage = answer.ok ? answer.coverage : null;
    else if (answer.ok) {
      this.found = answer.rooms;
      this.told = answer;
    } else if (!answer.lost) this.told = { findings: [], remarks: [], wrong: answer.text };
    if (this.room !== null && !this.rooms[this.room]) this.room = null;
    this.showFindings();
    this.board.draw();
    if (this.room !== null) this.form?.show();
    if (this.stale) {
      this.stale = false;
      this.survey();
    }
  }

  /** @param {boolean} [anyway] also if another program changed the file */
  async save(anyway = false) {
    if (this.closed) return;
    clearTimeout(this.keeping);
    const drawing = this.history.now, answer = await this.order('save', { drawing, anyway });
    this.saved(answer, drawing, () => this.save(true));
    if (answer.ok) notice(answer.text);
  }

  /** @param {any} answer @param {any} drawing that was sent @param {() => void} anyway */
  saved(answer, drawing, anyway) {
    if (answer.conflict) this.showConflict(answer, anyway);
    else if (!answer.ok) notice(answer.text, true);
    if (!answer.ok) return;
    this.base = JSON.stringify(drawing);
    this.kept = false;
    this.given.saved = true;
    this.changed(); // there may be later ones
  }

  /** @param {boolean} [anyway] @param {'simulate' | 'day'} [what] live, or a generated day in the player */
  async simulate(anyway = false, what = 'simulate') {
    if (this.closed) return;
    clearTimeout(this.keeping);
    const shown = window.open('', `angen-${what}`), buttons = [by('simulate'), by('a-day')]; // while it is the answer to a click
    for (const button of buttons) button.disabled = true;
    this.hint(what === 'day' ? t('Writes the world, and people live in it for a day …') : t('Writes the world and starts the simulator …'));
    const drawing = this.history.now, answer = await this.order(what, { drawing, anyway });
    for (const button of buttons) button.disabled = false;
    this.hint('');
    this.saved(answer, drawing, () => this.simulate(true, what));
    if (answer.address && shown) shown.location.href = answer.address;
    else if (answer.address) location.href = answer.address;
    else shown?.close();
    if (answer.wrong) notice(t('It is saved, and does not run: {why}', { why: answer.wrong }), true);
  }

  async discard() {
    const answer = await this.order('discard');
    if (answer.conflict) this.showConflict(answer);
    if (!answer.ok) return;
    localStorage.removeItem(this.place);
    location.reload();
  }

  /** @param {any} answer @param {() => void} [anyway] */
  showConflict(answer, anyway) {
    this.conflict = true;
    this.ask(`${answer.text[0].toUpperCase()}${answer.text.slice(1)}.`, [
      [t('Show the other'), () => { localStorage.removeItem(this.place); location.reload(); }],
      [t('Keep mine'), () => {
        this.conflict = false;
        this.version = answer.version;
        if (anyway) anyway();
        else this.keep();
      }]]);
  }

  // --- a selection

  /** @param {string[]} keys */
  select(keys) {
    this.selection = keys;
    this.room = null;
    this.show();
  }

  /** @param {number[] | null} at */
  selectRoom(at) {
    this.selection = [];
    const index = at ? this.rooms.findIndex((room) => inRoom(room, at)) : -1;
    this.room = index < 0 ? null : index;
    this.spot = index < 0 ? null : at;
    this.show();
  }

  /** @param {any} room @param {string} name @param {string} use */
  nameRoom(room, name, use) {
    const own = (this.storey.rooms ?? []).findIndex((/** @type {any} */ one) => inRoom(one, innerPoint(room.polygon))), in_ = labelIn(this.storey, room), [x, y] = innerPoint(room.polygon).map((value) => Math.round(value * 1e3) / 1e3);
    const index = this.room, named = { name, ...(use ? { use } : {}) };
    if (own >= 0) this.do({ change: { [`rooms/${own}`]: { ...this.storey.rooms[own], name, use } } });
    else if (in_) this.do({ change: { [in_.key]: name || use ? { x: in_.label.x, y: in_.label.y, ...named } : null } });
    else this.do({ add: [['labels', { x, y, ...named }]] });
    room.name = name;
    if (use) room.use = use;
    this.room = index;
    this.show();
  }

  remove() { if (this.selection.length) this.do(removed(this.storey, this.selection)); }

  /** @param {number} angle */
  turn(angle) {
    if (this.board.tool.name === 'put') {
      this.board.tool.turn += angle;
      this.board.draw();
    } else if (this.selection.length) this.do(turned(this.storey, this.selection, angle), this.selection);
  }

  copy() {
    if (this.selection.length) sessionStorage.setItem(COPIES, JSON.stringify(copied(this.storey, this.selection)));
  }

  /** @param {[string, any][]} items @param {number} dx @param {number} dy */
  add(items, dx, dy) {
    const before = this.storey, made = shifted(items, dx, dy), keys = keysOf(before);
    if (!made.length) return;
    const counts = /** @type {Record<string, number>} */ ({});
    const added = made.map(([list]) => `${list}/${(before[list]?.length ?? 0) + (counts[list] = (counts[list] ?? -1) + 1)}`);
    this.do({ add: made }, added.filter((key) => !keys.includes(key) && !key.startsWith('labels/')));
  }

  paste() {
    /** @type {[string, any][]} */
    const items = JSON.parse(sessionStorage.getItem(COPIES) ?? '[]');
    if (!items.length) return;
    const storey = Object.fromEntries(items.map(([list]) => [list, items.filter(([name]) => name === list).map(([, item]) => item)])), [mx, my] = middleOf(storey, keysOf(storey)), [x, y] = this.board.inside ? this.board.at : [mx + 0.5, my - 0.5];
    this.add(items, Math.round((x - mx) / GRID) * GRID, Math.round((y - my) / GRID) * GRID);
  }

  duplicate() { this.add(copied(this.storey, this.selection), 0.5, -0.5); }

  /** @param {any} what of the catalog */
  put(what) {
    if (this.closed) return;
    this.selection = [];
    this.room = null;
    this.board.use({ name: 'put', ...what });
    this.form?.show();
    this.hint(what.list === 'openings' ? t('Press on a wall; R turns it') : what.list === 'lifts' ? t('Press behind the wall in which its doors are; R turns it') : what.list === 'sensors' ? t('Press at its place, and drag to aim it') : t('Press at its place; R turns it'));
    by('board').focus();
  }

  // --- what it shows

  show() {
    this.board.draw();
    this.form?.show();
    this.dayPlan?.show();
    this.shelf?.show();
    this.buildFloors();
    by('undo').disabled = this.closed || this.history.at === 0;
    by('redo').disabled = this.closed || this.history.at === this.history.all.length - 1;
    by('save').disabled = this.closed;
    by('simulate').disabled = by('a-day').disabled = this.closed;
    this.showStatus();
  }

  showStatus() {
    if (!this.history || this.closed) return;
    if (!this.connected) this.setStatus('off', t('No connection: kept in this browser'));
    else if (this.dirty) this.setStatus('kept', this.kept ? t('Draft kept') : t('Changed'));
    else this.setStatus('', this.given.saved ? t('Saved') : t('New'));
  }

  /** @param {string} cls @param {string} text */
  setStatus(cls, text) {
    by('status').className = cls;
    by('status').textContent = text;
    by('status').title = text;
  }

  showFindings() {
    const { findings, remarks, wrong } = this.told, item = (/** @type {string} */ text, cls = '') => el('li', { class: cls }, text);
    const rows = wrong ? [item(wrong, 'bad')] : [...findings.map((text) => item(text)), ...remarks.map((text) => item(text))];
    const none = this.rooms.length ? t('Nothing is wrong with the home.') : t('Draw a room first: the tool Room, or walls around it.'), { coverage } = this.told;
    const button = (/** @type {string} */ text, /** @type {boolean} */ on, /** @type {() => void} */ does) => el('button', { type: 'button', 'aria-pressed': String(on), onclick: does }, text);
    const rules = this.history.now.sensors !== 'none', seen = coverage ? [el('div', { class: 'seen' }, el('p', {}, sentence(coverage)), button(t('Show coverage'), this.covers, () => this.showCoverage()),
      button(t('Sensors for me'), rules, () => this.do({ home: { sensors: rules ? 'none' : 'seed' } }, this.selection)))] : [];
    by('findings').replaceChildren(el('h2', {}, `${t('Findings')}${rows.length ? ` (${rows.length})` : ''}`), el('ul', {}, ...(rows.length ? rows : [item(none, 'good')])), ...seen);
  }

  showTool() {
    for (const [name] of TOOLS) by(`tool-${name}`)?.setAttribute('aria-pressed', String(this.board.tool.name === name));
    by('board').classList.toggle('draws', this.board.tool.name !== 'select');
    if (this.thick) this.thick.hidden = !['wall', 'room'].includes(this.board.tool.name);
    if (this.board.tool.name !== 'put') this.hint('');
    this.shelf?.show();
  }

  buildTools() {
    const button = (/** @type {string} */ name, /** @type {string} */ sign, /** @type {string} */ text, /** @type {string} */ key) => el('button', { id: `tool-${name}`, type: 'button', 'aria-pressed': 'false', title: `${text} (${key})`, 'aria-label': text, onclick: () => { this.select([]); this.board.use({ name }); } }, sign, el('span', {}, text));
    const toggle = (/** @type {string} */ sign, /** @type {string} */ text, /** @type {string} */ title, /** @type {boolean} */ on, /** @type {(on: boolean) => void} */ set) => {
      const made = el('button', { type: 'button', 'aria-pressed': String(on), title, 'aria-label': text, onclick: () => { on = !on; made.setAttribute('aria-pressed', String(on)); set(on); } }, sign, el('span', {}, text));
      return made;
    };
    const several = toggle('☑', t('Several'), t('Each press selects one more'), false, (on) => { this.several = on; });
    const picture = this.given.behind ? [toggle('▦', t('Picture'), t('The picture from which it was read, behind the drawing'), true, (on) => { this.board.bare = !on; this.board.draw(); })] : [];
    this.thick = el('select', { 'aria-label': t('Thickness of walls'), onchange: () => { this.thickness = Number(this.thick.value); } }, ...[0.1, 0.15, 0.2, 0.3].map((value) => el('option', { value }, `${value * 100} cm`)));
    by('tools').replaceChildren(...TOOLS.map(([name, sign, text, key]) => button(name, sign, text, key)), several, el('button', { type: 'button', title: t('The whole home (H)'), 'aria-label': t('The whole home'), onclick: () => this.board.whole() }, '⤢', el('span', {}, t('Whole'))), ...picture, this.thick);
    by('tools').hidden = this.closed;
    this.showTool();
  }

  buildFloors() {
    const { storeys } = this.history.now.plan;
    const button = (/** @type {string} */ id, /** @type {string} */ sign, /** @type {string} */ text, /** @type {() => void} */ does) => el('button', { id, type: 'button', title: text, 'aria-label': text, onclick: does }, sign);
    by('floors').replaceChildren(...(this.closed ? [] : [button('floor-add', t('+ Floor'), t('Add a floor on top'), () => this.addFloor())]),
      ...(storeys.length > 1 ? [...storeys.entries()].sort(([, a], [, b]) => b.elevation - a.elevation).map(([i, one]) => el('button', { type: 'button', 'aria-pressed': String(i === this.floor), onclick: () => { this.goTo(i); this.select([]); this.board.whole(); } }, floorName(one))) : []),
      ...(this.closed || storeys.length < 2 ? [] : [button('floor-remove', t('− Floor'), t('Remove this floor'), () => this.removeFloor())]));
  }

  /** @param {string} reason why the world cannot be edited */
  showClosed(reason) {
    by('board').hidden = true;
    by('side').hidden = true;
    by('picture').hidden = false;
    by('picture').src = '/plan.svg';
    this.setStatus('off', t('Read only'));
    this.hint(reason);
  }

  /** @param {string} text */
  hint(text) {
    by('hint').textContent = text;
    by('hint').hidden = !text;
  }

  /** @param {string} text @param {[string, () => void][]} answers */
  ask(text, answers) {
    showDialog(el('p', {}, text), el('form', { method: 'dialog', class: 'tools' }, ...answers.map(([name, does], i) => el('button', { class: i ? null : 'main', onclick: does }, name))));
  }
}

/** @param {{polygon: number[][], holes?: number[][][]}} room @param {number[]} at */
function inRoom({ polygon, holes }, at) {
  return within(polygon, at) && !(holes ?? []).some((hole) => within(hole, at));
}

/** @type {any} */ (window).angen = new Editor(); // for tests and the console
