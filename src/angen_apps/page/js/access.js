/** What this page may order, by the link that opened it. The server enforces it; here it is shown. */
import { t } from './lang.js';

/** @type {{role: string, may: string[] | null, reason: string, tokens: Record<string, string>}} */
let access = { role: 'build', may: null, reason: '', tokens: {} };

/** @param {any} given of the server */
export function setAccess(given) { access = given; }

export const accessed = () => access;

/** @param {string} order @returns {string} why this page may not give it; else nothing */
export const denied = (order) => (access.may === null || access.may.includes(order) ? '' : t(sentence(access.reason)));

/** @param {string} text */
const sentence = (text) => `${text[0].toUpperCase()}${text.slice(1)}.`;
