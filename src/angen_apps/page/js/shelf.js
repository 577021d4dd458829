/** The catalog: all that one can put into a home, with pictures, and a search. */
import { by, el, svg, words } from './dom.js';
import { SORTS } from './drawing.js';
import { t } from './lang.js';
import { furniture, signOf } from './symbols.js';

const RULES = { none: t('Only those that I put'), seed: t('By rules: two motion sensors and a light sensor a room, contacts at doors and seats'), casas: t('By rules: a motion sensor on each ceiling, contacts at doors') };

export class Shelf {
  /** @param {import('./edit.js').Editor} editor */
  constructor(editor) {
    this.editor = editor;
    /** @type {Map<any, any>} buttons by what they put */
    this.buttons = new Map();
    const search = el('input', { type: 'search', placeholder: t('Search: bed, window, camera …'), 'aria-label': t('Search the catalog'), oninput: () => this.search(search.value) });
    this.rules = el('select', { onchange: () => editor.do({ home: { sensors: this.rules.value } }, editor.selection) }, ...Object.entries(RULES).map(([value, text]) => el('option', { value }, text)));
    const { pieces, sensors } = editor.catalog;
    this.groups = [
      this.group(t('Doors and windows'), Object.keys(SORTS).map((sort) => [sort, { list: 'openings', of: sort }])),
      this.group(t('Furniture'), pieces.map((/** @type {any} */ piece) => [piece.name, { list: 'pieces', of: piece }])),
      this.group(t('Lamps, people, robots, elevators'), [['lamp', { list: 'lamps', of: 'lamp' }], ['person', { list: 'movers', of: 'person' }], ['robot', { list: 'movers', of: 'robot' }], ['elevator', { list: 'lifts', of: 'elevator' }]]),
      this.group(t('Sensors'), sensors.map((/** @type {any} */ sensor) => [sensor.name, { list: 'sensors', of: sensor }])),
    ];
    by('panel').replaceChildren(search, ...this.groups.map(({ element }) => element), el('h3', {}, t('Sensors of the home')), el('label', { class: 'rules' }, this.rules));
  }

  /** @param {string} title @param {[string, any][]} entries */
  group(title, entries) {
    const buttons = entries.map(([name, what]) => {
      const button = el('button', { type: 'button', 'aria-pressed': 'false', 'data-name': name, onclick: () => this.editor.put(what) }, svg('svg', { viewBox: '-1.35 -1.1 2.7 2.2', 'aria-hidden': 'true' }, ...this.picture(what)), words(name));
      this.buttons.set(what, button);
      return button;
    });
    return { buttons, element: el('section', {}, el('h3', {}, title), el('div', { class: 'shelf' }, ...buttons)) };
  }

  /** @param {any} what @returns {any[]} */
  picture({ list, of }) {
    if (list === 'pieces') { // its front below
      const long = Math.max(of.width, of.depth), [w, d] = [of.width / long, of.depth / long];
      return furniture(this.editor.symbols[of.thing], (u, v) => [v * w, -u * d], of.shape === 'cylinder', of.shape === 'flat');
    }
    if (list !== 'openings') return [svg('g', { class: `item ${list === 'lamps' ? 'lamp' : list === 'sensors' ? 'sensor' : of}` }, ...signOf(list === 'lamps' ? 'lamp' : of.kind ?? of, 0.6, list === 'sensors', list === 'movers'))];
    const how = /** @type {any} */ (SORTS)[of], leaves = how.slides ? 'M-1.1 .22H0' : how.leaves === 2 ? 'M-.6 0V-.6M.6 0V-.6' : how.leaves ? 'M-.6 0V-1.1' : '', swing = how.leaves === 2 ? 'M-.6-.6A.6.6 0 0 1 0 0A.6.6 0 0 1 .6-.6' : how.leaves ? 'M-.6-1.1A1.1 1.1 0 0 1 .55 0' : '';
    return [svg('path', { class: 'wall', d: 'M-1.25 0H-.7M.7 0H1.25', 'vector-effect': 'non-scaling-stroke' }), how.kind === 'window' || how.glazed ? svg('path', { class: 'pane', d: 'M-.6-.08H.6M-.6.08H.6' }) : null,
      svg('g', { class: `item ${how.kind}` }, svg('path', { class: 'swing symbol', d: swing }), leaves ? svg('path', { class: 'leaf', d: leaves, 'vector-effect': 'non-scaling-stroke' }) : null)].filter(Boolean);
  }

  /** @param {string} text */
  search(text) {
    const wanted = text.toLowerCase().trim();
    for (const { buttons, element } of this.groups) {
      for (const button of buttons) button.hidden = ![button.dataset.name, button.textContent.toLowerCase()].some((name) => name.includes(wanted));
      element.hidden = buttons.every((button) => button.hidden);
    }
  }

  show() {
    const { tool } = this.editor.board;
    for (const [what, button] of this.buttons) button.setAttribute('aria-pressed', String(tool.name === 'put' && tool.list === what.list && tool.of === what.of));
    this.rules.value = this.editor.history.now.sensors;
  }
}
