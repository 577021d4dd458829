/** Elements, icons and short notices. Text of others becomes text nodes only, never HTML. */

import { denied } from './access.js';
import { t } from './lang.js';

/**
 * @param {string} tag
 * @param {Record<string, any>} [attributes] `on…` are listeners, `order` is what it orders, which this page may not be allowed to, the rest attributes; null: left out
 * @param {...(Node | string | number | null | undefined | false)} children
 * @returns {any}
 */
export function el(tag, attributes = {}, ...children) {
  return fill(document.createElement(tag), attributes, children);
}

/**
 * @param {string} tag
 * @param {Record<string, any>} [attributes]
 * @param {...(Node | string | number | null | undefined | false)} children
 * @returns {any}
 */
export function svg(tag, attributes = {}, ...children) {
  return fill(document.createElementNS('http://www.w3.org/2000/svg', tag), attributes, children);
}

/** @param {any} element @param {Record<string, any>} attributes @param {any[]} children */
function fill(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (name === 'order') limit(element, value);
    else if (name.startsWith('on')) element.addEventListener(name.slice(2), value);
    else element.setAttribute(name, value === true ? '' : String(value));
  }
  for (const child of children) {
    if (child !== null && child !== undefined && child !== false) element.append(/** @type {any} */ (child));
  }
  return element;
}

/** @param {any} element a control, which is disabled with the reason where this page may not give its order @param {string} order */
export function limit(element, order) {
  const why = denied(order);
  element.dataset.order = order;
  element.disabled = Boolean(why);
  if (why) element.dataset.why = element.title = why;
}

/** @param {string} id @returns {any} */
export const by = (id) => document.getElementById(id);

/** @returns {boolean} whether the page is as on a phone, by the rule of style.css */
export const isNarrow = () => matchMedia('(max-width: 820px)').matches;
export const isLow = () => matchMedia('(max-height: 520px)').matches; // a phone across

/** @param {KeyboardEvent} e @returns {boolean} whether a key is the browser's, or one of a field in which one types */
export const isForOthers = (e) => e.ctrlKey || e.metaKey || e.altKey || /^(INPUT|SELECT|TEXTAREA)$/.test(/** @type {any} */ (e.target).tagName ?? '');

/** @type {Record<string, number[]>} x y of the keys that move something */
export const ARROWS = { ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowLeft: [-1, 0], ArrowDown: [0, -1] };

/** @param {string} text @param {boolean} [bad] */
export function notice(text, bad = false) {
  const shown = el('div', { class: bad ? 'notice bad' : 'notice' }, text);
  by('notices').append(shown);
  while (by('notices').children.length > 3) by('notices').firstChild.remove();
  setTimeout(() => shown.remove(), bad ? 7000 : 3500);
}

/** @param {...any} children of the dialog, which opens */
export function showDialog(...children) {
  by('dialog').replaceChildren(...children);
  if (!by('dialog').open) by('dialog').showModal();
}

/** @param {string} name @param {string} text @param {string} type of a file for the user */
export function download(name, text, type) {
  const link = el('a', { href: URL.createObjectURL(new Blob([text], { type })), download: name });
  link.click();
  URL.revokeObjectURL(link.href);
}

/** @param {string} name of the catalog */
export const words = (name) => (name ? t(name[0].toUpperCase() + name.slice(1).replaceAll('_', ' ')) : '');

/**
 * A symbol for a kind, of signs that every font has.
 * @type {Record<string, string>}
 */
const GLYPHS = {
  lamp: '●', door: '▮', window: '▯', cabinet: '▤', elevator: '↕', person: '☻', drive: '◆', pir: '◉', switch: '→', luminosity: '☼',
  camera: '▣', depth: '▣', lidar: '✳', stove: '♨', microphone: '♪', doorbell: '♪',
};
/** @param {string} kind */
export const glyph = (kind) => GLYPHS[kind] ?? '•';

/** @param {number} seconds since midnight or the start */
export function clockText(seconds) {
  const s = Math.max(0, Math.floor(seconds));
  const two = (/** @type {number} */ n) => String(n).padStart(2, '0');
  return `${two(Math.floor(s / 3600))}:${two(Math.floor(s / 60) % 60)}:${two(s % 60)}`;
}
