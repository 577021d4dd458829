/** The keys of the page on which a home is drawn. */
import { ARROWS, by } from './dom.js';
import { GRID, keysOf, moved } from './drawing.js';
import { t } from './lang.js';
import { showKeys } from './settings.js';

const FINE = 0.01; // m of an arrow key with Shift

/** @param {import('./edit.js').Editor} editor @param {KeyboardEvent} e */
export function pressed(editor, e) {
  const target = /** @type {any} */ (e.target);
  if (/^(INPUT|SELECT|TEXTAREA)$/.test(target.tagName ?? '') || by('dialog').open || !editor.history) return;
  const control = e.ctrlKey || e.metaKey, key = e.key.length === 1 ? e.key.toLowerCase() : e.key;
  if (control ? controlled(editor, key, e.shiftKey) : plain(editor, e, key)) e.preventDefault();
}

/** @param {import('./edit.js').Editor} editor @param {string} key @param {boolean} shift @returns {boolean} */
function controlled(editor, key, shift) {
  /** @type {Record<string, () => void>} */
  const keys = { z: () => (shift ? editor.redo() : editor.undo()), y: () => editor.redo(), c: () => editor.copy(), v: () => editor.paste(), x: () => { editor.copy(); editor.remove(); }, d: () => editor.duplicate(), s: () => editor.save(),
    a: () => editor.select(keysOf(editor.storey)) };
  keys[key]?.();
  return key in keys;
}

/** @param {import('./edit.js').Editor} editor @param {KeyboardEvent} e @param {string} key @returns {boolean} */
function plain(editor, e, key) {
  const { board } = editor, onBoard = document.activeElement === by('board') || document.activeElement === document.body;
  if (e.key === 'Escape') {
    if (board.tool.from) board.use(board.tool);
    else if (board.tool.name !== 'select') board.use({ name: 'select' });
    else editor.select([]);
    editor.hint('');
    return true;
  }
  if (onBoard && board.key(e.key)) return true;
  const way = ARROWS[e.key];
  if (way && onBoard) {
    const step = e.shiftKey ? FINE : GRID;
    if (editor.selection.length) editor.do(moved(editor.storey, editor.selection, way[0] * step, way[1] * step), editor.selection);
    else board.middle = [board.middle[0] + way[0] * 0.5, board.middle[1] + way[1] * 0.5];
    board.draw();
    return true;
  }
  /** @type {Record<string, () => void>} */
  const keys = { r: () => editor.turn((e.shiftKey ? 15 : 90) * (Math.PI / 180)), Delete: () => editor.remove(), Backspace: () => editor.remove(), v: () => board.use({ name: 'select' }), w: () => board.use({ name: 'wall' }), q: () => board.use({ name: 'room' }),
    '.': () => next(editor, 1), ',': () => next(editor, -1), '+': () => board.zoom(1.25), '-': () => board.zoom(0.8), h: () => board.whole(), c: () => editor.showCoverage(), t: () => by('theme').click(), '?': () => help() };
  keys[key]?.();
  return key in keys;
}

/** @param {import('./edit.js').Editor} editor @param {number} way to the next or the last thing */
function next(editor, way) {
  const keys = keysOf(editor.storey).filter((key) => !key.startsWith('labels/')), at = keys.indexOf(editor.selection[0]);
  if (keys.length) editor.select([keys[(at < 0 ? (way > 0 ? 0 : keys.length - 1) : at + way + keys.length) % keys.length]]);
}

/** Shows what keys and pointers do. */
export function help() {
  showKeys([[t('Walls (W)'), t('press where they begin, then at each corner; type a length and Enter')], [t('Room (Q)'), t('press at two corners, or drag')], [t('Click'), t('selects; with Shift several; in a room: its name')], [t('Drag'), t('moves what is selected; on the ground selects all within')],
    [t('Wheel, right button'), t('zooms, moves the sheet; on a phone two fingers')], [t('Arrows'), t('0.1 m, with Shift 0.01 m; with a tool: its place, Enter puts')], [t('R, Shift+R'), t('turns by 90°, by 15°; a door: hinge and side')], ['. ,', t('the next, the last thing')],
    [t('Del'), t('removes it')], [t('Ctrl+C X V D A'), t('copy, cut, paste, twice, all')], [t('Ctrl+Z Y'), t('undo, redo')], [t('Ctrl+S'), t('saves')], [t('Esc'), t('ends a tool')], ['H, + −', t('the whole home, zoom')], ['C', t('what motion sensors see')], ['Alt', t('turns a sensor freely')]]);
}
