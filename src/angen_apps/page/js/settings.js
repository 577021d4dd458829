/** What a user sets: language and theme; the dialog of the keys, which has both. */
import { by, el, showDialog } from './dom.js';
import { choose, languages, t } from './lang.js';

/** @param {string} theme light or dark */
export function setTheme(theme) {
  document.documentElement.dataset.theme = theme;
  localStorage.setItem('theme', theme);
  by('theme').textContent = theme === 'dark' ? '☀' : '☾';
}

/** @param {(theme: string) => void} set is called with the theme that the user has, and with another one at each press */
export function beginTheme(set) {
  set(localStorage.getItem('theme') ?? (matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light'));
  by('theme').addEventListener('click', () => set(document.documentElement.dataset.theme === 'dark' ? 'light' : 'dark'));
}

/** @param {string[][]} rows keys, and what they do */
export function showKeys(rows) {
  const menu = el('select', { id: 'language', onchange: () => choose(menu.value) }, ...languages().map(({ code, name, chosen }) => el('option', { value: code, selected: chosen, lang: code }, name)));
  showDialog(el('h2', {}, t('Keys')), el('dl', {}, ...rows.flatMap(([key, text]) => [el('dt', {}, el('kbd', {}, key)), el('dd', {}, text)])),
    el('div', { class: 'settings' }, el('label', {}, t('Language'), ' ', menu), el('button', { type: 'button', onclick: () => by('theme').click() }, t('Light or dark'))),
    el('form', { method: 'dialog' }, el('button', { class: 'main', autofocus: true }, t('Close'))));
}
