/** The people of a home as figures. */
import * as THREE from '../vendor/three/three.module.min.js';
import { yawOf } from './fields.js';
import { Figure } from './figure.js';

export class People {
  /** @param {import('./home.js').Home} home */
  constructor(home) {
    this.home = home;
    this.group = new THREE.Group();
    /** @type {Map<string, {figure: Figure, link: number, low: number, text: string}>} by model */
    this.all = new Map();
    this.hidden = ''; // the model through whose eyes one looks
  }

  /** @returns {Set<string>} their models, which nothing else shows */
  build() {
    const models = new Set(this.home.entities.filter((e) => e.kind === 'person').map((e) => e.model));
    this.group.clear();
    this.all.clear();
    [...models].forEach((model, number) => this.add(model, number));
    return models;
  }

  /** @param {string} model @param {number} number */
  add(model, number) {
    const { home } = this, links = home.linksOf(model);
    if (!links.length) return;
    const parts = home.scene.shapes.filter((/** @type {any} */ s) => links.includes(s.link));
    const heights = parts.flatMap((/** @type {any} */ s) => [s.pose[2] - s.size[2] / 2, s.pose[2] + s.size[2] / 2]);
    const low = heights.length ? Math.min(...heights) : -0.875, high = heights.length ? Math.max(...heights) : 0.875;
    const figure = new Figure(number, Math.max(1, high - low));
    const entry = { figure, link: links[0], low, text: '' };
    figure.group.userData.link = links[0];
    figure.group.traverse((/** @type {any} */ part) => { part.userData.link = links[0]; });
    this.all.set(model, entry);
    this.group.add(figure.group);
    this.setPosture(model);
  }

  /** @param {string} model */
  setPosture(model) {
    const entry = this.all.get(model), person = this.home.entities.find((e) => e.kind === 'person' && e.model === model);
    if (!entry || !person) return;
    const row = this.home.row(person), text = row?.text ?? '';
    entry.figure.posture = /\bsit/i.test(text) ? 'sit' : /\b(lie|lying)/i.test(text) ? 'lie' : /^away\b/i.test(text) ? 'away' : 'stand';
    entry.text = / · (.*)/.exec(text)?.[1] ?? '';
    const at = this.home.fields('person').findIndex((field) => field.name === 'speed');
    entry.figure.speed = row?.values[at] ?? 0;
  }

  /**
   * @param {number} link
   * @param {ArrayLike<number>} pose
   * @param {(storey: number) => boolean} shows
   */
  place(link, pose, shows) {
    for (const [model, { figure, link: own, low }] of this.all) {
      if (own !== link) continue;
      figure.group.position.set(pose[0], pose[1], pose[2] + low);
      figure.group.rotation.z = yawOf(pose);
      figure.group.visible = figure.posture !== 'away' && model !== this.hidden && shows(this.home.storeyAt(pose[2] + low + 0.3));
    }
  }

  /** @returns {any[]} the figures that are seen */
  seen() {
    return [...this.all.values()].filter(({ figure }) => figure.group.visible).map(({ figure }) => figure.group);
  }

  /**
   * @param {number} dt s
   * @returns {boolean} whether any moves
   */
  animate(dt) {
    let moves = false;
    for (const { figure } of this.all.values()) if (figure.group.visible && figure.animate(this.home.stats.paused ? 0 : dt)) moves = !this.home.stats.paused || moves;
    return moves;
  }
}
