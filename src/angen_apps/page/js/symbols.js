/** What a plan draws of furniture, devices, people and sensors: on the page of a running home and where one is drawn. */
import { glyph, svg } from './dom.js';

const CORNERS = [[-1, -1], [1, -1], [1, 1], [-1, 1]], ROUND = Array.from({ length: 24 }, (_, i) => [Math.cos((i * Math.PI) / 12), Math.sin((i * Math.PI) / 12)]);

/**
 * The outline and the symbol of a piece of furniture, as angen plan draws them.
 * @param {number[][][] | undefined} symbol lines from -1 to 1, x to the front @param {(u: number, v: number) => number[]} at the place of such a point
 * @param {boolean} [round] @param {boolean} [hung] above one's head
 * @returns {any[]}
 */
export function furniture(symbol, at, round = false, hung = false) {
  const line = (/** @type {number[][]} */ points) => `M${points.map(([u, v]) => {
    const [x, y] = at(u, v);
    return `${x.toFixed(3)} ${(-y).toFixed(3)}`;
  }).join('L')}`, more = hung ? ' hung' : '';
  return [svg('path', { class: `furniture${more}`, d: `${line(round ? ROUND : CORNERS)}Z` }), svg('path', { class: `symbol${more}`, d: (symbol ?? []).map(line).join('') })];
}

/**
 * The mark of a kind: a circle for people, robots and lamps, a square for other devices, a diamond for sensors.
 * @param {string} kind @param {number} size half of its width @param {boolean} sensor @param {boolean} mover
 * @returns {any[]}
 */
export function signOf(kind, size, sensor, mover) {
  if (sensor) return [svg('path', { class: 'face', d: `M${size} 0L0 ${size}L${-size} 0L0 ${-size}Z` })];
  if (mover) return [svg('path', { class: 'face', d: `M${size * 1.7} 0L${size * 0.5} ${-size * 0.85}V${size * 0.85}Z` }), svg('circle', { class: 'face', r: size })];
  const part = size * Math.SQRT1_2;
  if (kind === 'lamp') return [svg('circle', { class: 'face', r: size }), svg('path', { class: 'sign', d: `M${-part} ${-part}L${part} ${part}M${-part} ${part}L${part} ${-part}` })];
  return [svg('rect', { class: 'face', x: -size, y: -size, width: 2 * size, height: 2 * size, rx: 0.3 * size }), svg('text', { class: 'sign', y: 0.55 * size, 'font-size': 1.6 * size }, glyph(kind))];
}
