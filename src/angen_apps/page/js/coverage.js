/** What sensors see of a floor: cells, as the server found them by the simulator's rays. */
import { svg, words } from './dom.js';
import { t } from './lang.js';

/**
 * @typedef {{kind: string, name: string, box: number[], standing: string, fallen: string}} Seeing
 * @typedef {{origin: number[], side: number, rows: number, columns: number, free: string, sensors: Seeing[], share: number, rooms: Record<string, number>}} Coverage
 * Masks are bits in base64, row after row from the south; `box`: row, column, rows, columns of those of a sensor.
 */

/** @param {string} text @returns {(index: number) => boolean} */
function bits(text) {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  return (index) => Boolean((bytes[index >> 3] >> (index & 7)) & 1);
}

/** @param {Coverage} coverage @returns {Uint8Array} by cell: how many motion sensors see who stands there, from 1 on; 0 where nobody can stand */
function counted({ rows, columns, free, sensors }) {
  const isFree = bits(free), found = Uint8Array.from({ length: rows * columns }, (_, i) => Number(isFree(i)));
  for (const { kind, box: [row, column, high, wide], standing } of sensors) {
    if (kind !== 'pir') continue;
    const sees = bits(standing);
    for (let i = 0; i < high * wide; i++) {
      const at = (row + Math.floor(i / wide)) * columns + column + (i % wide);
      if (sees(i) && found[at]) found[at]++;
    }
  }
  return found;
}

/** @param {Coverage} coverage @returns {any[]} paths of what none, one, and several motion sensors see */
export function mapOf(coverage) {
  const { origin, side, rows, columns } = coverage, cells = counted(coverage), of = (/** @type {number} */ i) => Math.min(cells[i], 3), paths = ['', '', '', ''];
  for (let row = 0; row < rows; row++) {
    for (let from = 0, to; from < columns; from = to) {
      for (to = from + 1; to < columns && of(row * columns + to) === of(row * columns + from); to++);
      const wide = (to - from) * side;
      paths[of(row * columns + from)] += `M${(origin[0] + from * side).toFixed(3)} ${(-origin[1] - row * side).toFixed(3)}h${wide.toFixed(3)}v${-side}h${(-wide).toFixed(3)}Z`;
    }
  }
  return ['unseen', 'seen', 'seen twice'].map((cls, i) => svg('path', { class: `cover ${cls}`, d: paths[i + 1] }));
}

/** @param {Coverage} coverage @param {number[]} at @returns {{standing: string[], fallen: string[]}} names of the sensors that detect who walks there, and who lies there and moves */
export function sensorsAt({ origin, side, sensors }, [x, y]) {
  const column = Math.floor((x - origin[0]) / side), row = Math.floor((y - origin[1]) / side);
  const names = (/** @type {'standing' | 'fallen'} */ how) => sensors.filter(({ box: [low, left, high, wide], [how]: mask }) =>
    row >= low && row < low + high && column >= left && column < left + wide && bits(mask)((row - low) * wide + column - left)).map(({ name }) => name);
  return { standing: names('standing'), fallen: names('fallen') };
}

/** @param {Coverage} coverage @returns {string} in a sentence */
export function sentence({ share, rooms }) {
  const percent = (/** @type {number} */ part) => `${Math.round(part * 100)} %`, less = Object.entries(rooms).filter(([, part]) => part < 0.995).sort(([, a], [, b]) => a - b);
  const parts = less.map(([name, part]) => `${words(name.replace(/\d+$/, ''))} ${percent(part)}`);
  return `${t('Motion sensors see {share} of the floor', { share: percent(share) })}${parts.length && share > 0 ? `: ${parts.join(', ')}` : ''}.`;
}
