/** Plays a recording: play, scrub, speed, events, and who was in which room. */
import { accessed } from './access.js';
import { by, clockText, el, notice } from './dom.js';
import { inside } from './home.js';
import { t } from './lang.js';

const SPEEDS = [0.5, 1, 2, 5, 20, 100, 1000];
const LINE = 14; // px of a person's line
const NAMES = 44; // px of their names
const COLORS = ['#0f766e', '#b45309', '#7c3aed', '#2563eb', '#cf2369', '#4d7c0f', '#0e7490', '#a16207', '#9333ea', '#dc2626', '#64748b', '#047857'];

/** The states of an entity over time. */
class Track {
  constructor() {
    /** @type {number[]} */
    this.t = [];
    /** @type {any[]} */
    this.v = [];
    this.at = -1; // of the time that is shown
  }

  /** @param {number} time @returns {boolean} whether the value has changed */
  seek(time) {
    let at = this.at;
    if (at >= 0 && time < this.t[at]) at = -1;
    if (at < 0 || (at + 1 < this.t.length && time >= this.t[Math.min(at + 8, this.t.length - 1)])) {
      let low = 0, high = this.t.length;
      while (low < high) {
        const middle = (low + high) >> 1;
        if (this.t[middle] <= time) low = middle + 1;
        else high = middle;
      }
      at = low - 1;
    } else {
      while (at + 1 < this.t.length && this.t[at + 1] <= time) at++;
    }
    const changed = at !== this.at;
    this.at = at;
    return changed;
  }
}

export class Player {
  /** @param {import('./home.js').Home} home */
  constructor(home) {
    this.home = home;
    const given = new URLSearchParams(location.search).get('t');
    this.time = Number(given) || 0;
    this.begun = given !== null;
    this.playing = true;
    this.speed = 1;
    this.end = Infinity; // until the recording is known
    this.loaded = 0;
    /** @type {Map<number, Track>} by id of a link */
    this.links = new Map();
    /** @type {Map<number, Track>} */
    this.lights = new Map();
    /** @type {Map<string, Track>} */
    this.rows = new Map();
    /** @type {any[][]} */
    this.events = [];
    /** @type {Map<string, string> | null} */
    this.colors = null;
    /** @type {{name: string, spans: any[][]}[]} */
    this.drawn = [];
    this.last = performance.now();
    home.on('timeline', (entries) => this.take(entries));
    home.on('line', () => this.onLine());
    home.on('scene', () => { if (home.status.replay) this.onScene(); });
  }

  onLine() {
    const { begin, end, loaded, speed } = this.home.line, before = this.loaded;
    this.end = end;
    this.loaded = loaded;
    if (this.within(this.time) !== this.time) this.seek(this.time);
    if (before < this.time && loaded >= this.time) this.seek(this.time);
    if (!this.bar) this.build();
    this.slider.max = String(end);
    if (!this.begun && begin !== undefined) {
      this.begun = true;
      this.speed = speed;
      this.rate.value = String(speed);
      if (this.time < begin) this.seek(begin);
    }
    this.ribbonStale = true;
  }

  onScene() {
    /** @type {Map<number, number>} link by id */
    this.linkOf = new Map((this.home.scene.ids ?? []).map((/** @type {number} */ id, /** @type {number} */ i) => [id, i]));
    this.lightOf = new Map((this.home.scene.light_ids ?? []).map((/** @type {number} */ id, /** @type {number} */ i) => [id, i]));
    this.seek(this.time);
  }

  /** @param {any[]} entries */
  take(entries) {
    const push = (/** @type {Map<any, Track>} */ map, /** @type {any} */ key, /** @type {number} */ t, /** @type {any} */ v) => {
      let track = map.get(key);
      if (!track) map.set(key, track = new Track());
      track.t.push(t);
      track.v.push(v);
    };
    for (const entry of entries) {
      const [kind, t] = entry;
      if (kind === 'p') entry[2].forEach((/** @type {number} */ id, /** @type {number} */ i) => push(this.links, id, t, entry[3].slice(7 * i, 7 * i + 7)));
      else if (kind === 'l') entry[2].forEach((/** @type {number} */ id, /** @type {number} */ i) => push(this.lights, id, t, entry[3][i]));
      else if (kind === 'r') push(this.rows, `${entry[2]}/${entry[3]}`, t, entry.slice(2));
      else if (kind === 'e') this.events.push(entry[2]);
    }
    this.events.sort((a, b) => a[0] - b[0]);
  }

  build() {
    this.play = el('button', { type: 'button', class: 'icon main', id: 'replay', 'aria-label': t('Play or pause'), onclick: () => this.toggle() });
    this.rate = el('select', { 'aria-label': t('Speed'), onchange: () => { this.speed = Number(this.rate.value); } }, ...SPEEDS.map((s) => el('option', { value: s, selected: s === 1 }, `${s}×`)));
    this.slider = el('input', { type: 'range', id: 'moment', min: 0, step: 'any', value: 0, 'aria-label': t('Time'), oninput: () => this.seek(Number(this.slider.value)) });
    this.label = el('span', { class: 'number' });
    this.ribbon = el('canvas', { role: 'img', 'aria-label': t('What each person did, or the room that each was in') });
    this.ribbon.addEventListener('pointermove', (/** @type {PointerEvent} */ e) => { this.ribbon.title = this.textAt(e); });
    this.ribbon.addEventListener('click', (/** @type {PointerEvent} */ e) => this.seek(this.timeAt(e)));
    const share = el('button', { type: 'button', title: t('The address of this moment'), onclick: () => {
      const url = new URL(location.href);
      url.searchParams.set('t', this.time.toFixed(1));
      const { role, tokens } = accessed();
      if (tokens[role]) url.searchParams.set('token', tokens[role]);
      history.replaceState(null, '', url);
      const copied = () => notice(t('The address of this moment is copied.')), shown = () => notice(t('The address above opens at this moment.'));
      (navigator.clipboard?.writeText(url.href) ?? Promise.reject()).then(copied, shown);
    } }, t('Link'));
    this.bar = el('section', { id: 'player', 'aria-label': t('Recording') }, el('div', { class: 'line' }, this.ribbon, this.slider),
      el('div', { class: 'tools' }, this.play, el('button', { type: 'button', title: t('To the next event (N)'), onclick: () => this.next() }, t('Next event')), this.rate, this.label, el('span', { class: 'grow' }), share));
    by('side').before(this.bar);
    new ResizeObserver(() => { this.ribbonStale = true; }).observe(this.bar);
    const frame = () => { requestAnimationFrame(frame); this.frame(); };
    frame();
  }

  frame() {
    const now = performance.now(), dt = (now - this.last) / 1000;
    this.last = now;
    const playing = this.playing && this.time < this.end;
    const next = Math.min(this.time + dt * this.speed, this.loaded);
    if (playing && next > this.time) this.seek(next, true); // it waits for the rows
    this.play.textContent = playing ? '❚❚' : '▶';
    this.slider.value = String(this.time);
    const text = `${clockText(this.time)} / ${clockText(this.end)}${this.end ? '' : `, ${t('one moment: it has no duration')}`}${this.loaded < this.end ? `, ${t('read {share} %', { share: Math.round((100 * this.loaded) / this.end) })}` : ''}`;
    if (this.label.textContent !== text) this.label.textContent = text;
    if (this.ribbonStale && now - (this.ribbonAt ?? 0) > 1000) {
      this.ribbonStale = false;
      this.ribbonAt = now;
      this.drawRibbon();
    }
  }

  /** @param {string} key kind/name @returns {boolean} whether there is a state of it at any time */
  has(key) {
    return this.rows.get(key)?.v.some(([, , text]) => text) ?? false;
  }

  /** Plays or pauses; at the end it begins again. */
  toggle() {
    const ended = this.time >= this.end;
    this.playing = ended || !this.playing;
    if (ended) this.seek(0);
  }

  next() {
    const next = this.events.find(([t]) => t > this.time + 0.01);
    if (next) this.seek(next[0]);
  }

  /** @param {number} time @returns {number} the nearest time of the recording */
  within(time) {
    return Math.max(0, Math.min(time, this.end));
  }

  /** @param {number} moment of the recording, or the nearest one @param {boolean} [onwards] */
  seek(moment, onwards = false) {
    const { home } = this, time = this.within(moment);
    if (time < this.time) home.series.clear();
    this.time = time;
    if (!home.scene || !this.linkOf || !this.lightOf) return;
    const moved = [];
    for (const [id, track] of this.links) {
      const link = this.linkOf.get(id);
      const changed = track.seek(time);
      if (link === undefined || track.at < 0) continue;
      const last = track.at + 1 === track.t.length;
      if (changed || !last) { home.poses.set(link, between(track, time)); moved.push(link); }
    }
    for (const [id, track] of this.lights) {
      const light = this.lightOf.get(id);
      if (light !== undefined && (track.seek(time) || !onwards)) home.levels.set(light, track.at < 0 ? 0 : track.v[track.at]);
    }
    const rows = [];
    for (const track of this.rows.values()) if (track.seek(time) && track.at >= 0) rows.push(track.v[track.at]);
    home.poseScene = home.scene.number;
    if (moved.length) home.tell('poses', moved);
    home.tell('levels');
    if (rows.length) home.takeRows(rows, false);
    home.stats = { ...home.stats, time, paused: !this.playing, factor: this.speed };
    home.statsAt = performance.now();
    home.tell('stats');
    const shown = this.events.filter(([t]) => t <= time).slice(-500);
    if (shown.length !== home.events.length || shown[0] !== home.events[0]) { home.events = shown; home.tell('events', []); }
  }

  /**
   * Spans of each person: activities where the recording has them, else rooms.
   * @returns {{name: string, spans: any[][]}[]} start, end, text of each span
   */
  people() {
    const { home } = this;
    if (home.line.ribbon) return home.line.ribbon.map((/** @type {any} */ [name, spans]) => ({ name, spans }));
    return home.entities.filter((e) => e.kind === 'person').slice(0, 6).map((e) => ({ name: e.name, spans: this.roomsOf(e) }));
  }

  /** @param {import('./home.js').Entity} e @returns {any[][]} */
  roomsOf(e) {
    const { home } = this, link = home.linksOf(e.model)[0], track = this.links.get(home.scene?.ids?.[link]);
    /** @type {any[][]} */
    const spans = [];
    track?.t.forEach((t, i) => {
      const [x, y, z] = track.v[i], room = home.rooms.find((r) => z > r.floor - 0.5 && z < r.ceiling && inside(r.polygon, x, y))?.name ?? '';
      const last = spans[spans.length - 1], end = track.t[i + 1] ?? this.loaded;
      if (last && last[2] === room) last[1] = end;
      else spans.push([t, end, room]);
    });
    return spans;
  }

  /** A line a person, below it marks of events. */
  drawRibbon() {
    const { ribbon } = this, people = this.drawn = this.people(), sharp = Math.min(2, devicePixelRatio);
    const width = ribbon.clientWidth || 600, height = Math.max(1, people.length) * LINE + 4;
    ribbon.style.height = `${height}px`;
    ribbon.width = width * sharp;
    ribbon.height = height * sharp;
    const context = ribbon.getContext('2d'), style = getComputedStyle(document.documentElement);
    if (!context || !this.end) return;
    context.scale(sharp, sharp);
    context.font = '11px system-ui';
    context.textBaseline = 'middle';
    people.forEach(({ name, spans }, line) => {
      for (const [start, end, text] of spans) {
        if (!text) continue;
        const x = NAMES + (start / this.end) * (width - NAMES), wide = ((end - start) / this.end) * (width - NAMES);
        context.fillStyle = this.color(text);
        context.fillRect(x, line * LINE, Math.max(0.5, wide), LINE - 2);
        const said = spanText(text);
        if (wide > 7 * said.length + 6) {
          context.fillStyle = '#fff';
          context.fillText(said, x + 4, line * LINE + LINE / 2 - 0.5);
        }
      }
      context.fillStyle = style.getPropertyValue('--ink');
      context.fillText(name, 0, line * LINE + LINE / 2 - 0.5, NAMES - 4);
    });
    for (const [t] of this.events) context.fillRect(NAMES + (t / this.end) * (width - NAMES), height - 3, 1, 3);
  }

  /** @param {string} text @returns {string} the same for the same activity or room */
  color(text) {
    this.colors ??= new Map();
    if (!this.colors.has(text)) this.colors.set(text, COLORS[this.colors.size % COLORS.length]);
    return this.colors.get(text) ?? COLORS[0];
  }

  /** @param {PointerEvent} e */
  timeAt(e) {
    return Math.min(this.loaded, Math.max(0, ((e.offsetX - NAMES) / (this.ribbon.clientWidth - NAMES)) * this.end));
  }

  /** @param {PointerEvent} e */
  textAt(e) {
    const person = this.drawn?.[Math.floor(e.offsetY / LINE)], time = this.timeAt(e);
    const span = person?.spans.find(([start, end]) => time >= start && time < end);
    return span ? `${person?.name}: ${spanText(span[2])}, ${this.home.clock(time)}` : '';
  }
}

/** @param {string} name of an activity or a room */
const spanText = (name) => t(name.replaceAll('_', ' '));

/** @param {Track} track @param {number} time @returns {Float32Array} */
function between(track, time) {
  const from = track.v[track.at], to = track.v[track.at + 1];
  if (!to) return Float32Array.from(from);
  const span = track.t[track.at + 1] - track.t[track.at], part = span > 0 ? Math.min(1, (time - track.t[track.at]) / span) : 1;
  const far = Math.hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
  if (far > 4 || span > 3) return Float32Array.from(part < 1 ? from : to); // a rest, or a jump
  const sign = from[3] * to[3] + from[4] * to[4] + from[5] * to[5] + from[6] * to[6] < 0 ? -1 : 1;
  const pose = Float32Array.from(from, (value, i) => value + part * ((i < 3 ? 1 : sign) * to[i] - value));
  const length = Math.hypot(pose[3], pose[4], pose[5], pose[6]) || 1;
  for (let i = 3; i < 7; i++) pose[i] /= length;
  return pose;
}
