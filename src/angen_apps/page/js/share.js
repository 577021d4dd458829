/** The links for others, which the owner of a page that has tokens gives away. */
import { accessed } from './access.js';
import { el, notice, showDialog } from './dom.js';
import { t } from './lang.js';

/** @type {Record<string, string>} */
const TEXTS = { look: t('To look only'), switch: t('To switch and send, not to build'), build: t('To do all, as you') };

export function share() {
  const { tokens } = accessed();
  const rows = Object.entries(TEXTS).filter(([role]) => tokens[role]).map(([role, text]) => {
    const url = `${location.origin}/?token=${tokens[role]}`, field = el('input', { type: 'text', readonly: true, value: url, onfocus: () => field.select() });
    const copied = () => notice(t('The address is copied.')), shown = () => field.select(); // a page without https may not copy
    return el('label', { class: 'link' }, el('span', {}, text), field, el('button', { type: 'button', onclick: () => { (navigator.clipboard?.writeText(url) ?? Promise.reject()).then(copied, shown); } }, t('Copy')));
  });
  showDialog(el('h2', {}, t('Links for others')), ...rows, el('form', { method: 'dialog' }, el('button', { class: 'main' }, t('Close'))));
}
