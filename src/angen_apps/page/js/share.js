/** The links for others, which the owner of a page that has tokens gives away. */
import { accessed } from './access.js';
import { by, el, notice } from './dom.js';

/** @type {Record<string, string>} */
const TEXTS = { look: 'To look only', switch: 'To switch and send, not to build', build: 'To do all, as you' };

export function share() {
  const { tokens } = accessed();
  const rows = Object.entries(TEXTS).filter(([role]) => tokens[role]).map(([role, text]) => {
    const url = `${location.origin}/?token=${tokens[role]}`, field = el('input', { type: 'text', readonly: true, value: url, onfocus: () => field.select() });
    const copied = () => notice('The address is copied.'), shown = () => field.select(); // a page without https may not copy
    return el('label', { class: 'link' }, el('span', {}, text), field, el('button', { type: 'button', onclick: () => { (navigator.clipboard?.writeText(url) ?? Promise.reject()).then(copied, shown); } }, 'Copy'));
  });
  by('dialog').replaceChildren(el('h2', {}, 'Links for others'), ...rows, el('form', { method: 'dialog' }, el('button', { class: 'main' }, 'Close')));
  by('dialog').showModal();
}
