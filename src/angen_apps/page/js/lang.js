/** The page in the user's language: texts are English in the code, which lang/CODE.json has by these in another. */

const given = /** @type {HTMLMetaElement | null} */ (document.querySelector('meta[name=languages]'))?.content.split(' ') ?? ['en'];
const wishes = [new URLSearchParams(location.search).get('lang'), localStorage.getItem('lang'), ...navigator.languages.map((one) => one.split('-')[0])];
const language = wishes.find((wish) => wish && given.includes(wish)) ?? 'en';
/** @type {Record<string, string>} */
const table = language === 'en' ? {} : await fetch(`/page/lang/${language}.json`).then((answer) => (answer.ok ? answer.json() : {}));
const POINT = new Intl.NumberFormat(language).formatToParts(0.5).find((part) => part.type === 'decimal')?.value ?? '.';
const NONE = 'none'; // as an empty list is written
const ATTRIBUTES = ['title', 'aria-label', 'alt'];

/** @type {Map<string, RegExp>} of the words of states */
const patterns = new Map();

/** @param {string | number} text with numbers as programs write them */
export const numbers = (text) => (POINT === '.' ? String(text) : String(text).replace(/(\d)\.(?=\d)/g, `$1${POINT}`));

/**
 * A text, or a name of the catalog, in the user's language.
 * @param {string} text English @param {Record<string, string | number>} [values] of its {names}
 */
export function t(text, values = {}) {
  const found = Object.hasOwn(table, text) ? table[text] : text;
  return found.replace(/\{(\w+)\}/g, (_, name) => (typeof values[name] === 'number' ? numbers(values[name]) : String(values[name])));
}

/**
 * A state as the simulator writes it, of the words of its kind and of numbers.
 * @param {string} text @param {any} [kind] of the catalog
 */
export function state(text, kind) {
  if (language === 'en' || !text) return text;
  const words = (kind?.fields ?? []).flatMap((/** @type {any} */ field) => field.words ?? []).filter(Boolean).concat(NONE);
  let pattern = patterns.get(kind?.kind);
  if (!pattern) {
    const parts = words.sort((/** @type {string} */ a, /** @type {string} */ b) => b.length - a.length).map((/** @type {string} */ word) => word.replace(/[.*+?^${}()|[\]\\]/g, '\\$&'));
    patterns.set(kind?.kind, pattern = new RegExp(`(?<!\\w)(?:${parts.join('|')})(?!\\w)`, 'gi'));
  }
  return numbers(text.replace(pattern, (word) => {
    const plain = word.toLowerCase(), own = `${kind?.kind}: ${plain}`, found = t(Object.hasOwn(table, own) ? own : plain); // which may have another meaning elsewhere
    return word === word.toUpperCase() ? found.toUpperCase() : found;
  }).replace(/(?<= · )\w+$/, (activity) => t(activity.replaceAll('_', ' '))));
}

/**
 * A kind within a sentence, in which English writes it small.
 * @param {string} kind
 */
export function noun(kind) {
  const plain = kind.replaceAll('_', ' ');
  return table[plain.slice(0, 1).toUpperCase() + plain.slice(1)] ?? plain;
}

/**
 * An event's word, which may be another than that of a state.
 * @param {string} word
 */
export const happened = (word) => table[`event: ${word}`] ?? word.replaceAll('_', ' ');

/**
 * An event's detail, such as "signal 0.5 m": a field, a number and its unit.
 * @param {string} detail
 */
export const measured = (detail) => numbers(detail.replace(/^[a-z]+(?= -?\d)/, (field) => t(field)));

/** @returns {{code: string, name: string, chosen: boolean}[]} the languages of this page, each by its own name */
export const languages = () => given.map((code) => ({ code, name: new Intl.DisplayNames([code], { type: 'language' }).of(code) ?? code, chosen: code === language }));

/** @param {string} code of the language, which the page has from now on */
export function choose(code) {
  const url = new URL(location.href);
  url.searchParams.delete('lang');
  localStorage.setItem('lang', code);
  history.replaceState(null, '', url);
  location.reload();
}

/** The texts of the HTML itself. */
function translate() {
  document.documentElement.lang = language;
  for (const element of document.body.querySelectorAll('*')) {
    for (const name of ATTRIBUTES) if (element.hasAttribute(name)) element.setAttribute(name, t(element.getAttribute(name) ?? ''));
    for (const node of element.childNodes) if (node.nodeType === Node.TEXT_NODE) node.nodeValue = (node.nodeValue ?? '').replace(/\S(?:.*\S)?/, (text) => t(text));
  }
}

if (language !== 'en') translate();
