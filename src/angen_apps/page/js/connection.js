/** The WebSocket: it comes back by itself; each order gets an answer. */
import { t } from './lang.js';

/** @typedef {{ok: boolean, text?: string, xml?: string}} Answer */

const LATER = 1000; // ms between tries

export class Connection {
  /**
   * @param {(parts: any) => void} onParts
   * @param {(blob: ArrayBuffer) => void} onBlob
   * @param {(open: boolean) => void} onState
   */
  constructor(onParts, onBlob, onState) {
    this.onParts = onParts;
    this.onBlob = onBlob;
    this.onState = onState;
    /** @type {Map<number, (answer: Answer) => void>} */
    this.waiting = new Map();
    this.last = 0;
    /** @type {Map<string, string[]>} */
    this.topics = new Map();
    /** @type {(() => void)[]} of orders that wait for it */
    this.awaiting = [];
    /** @type {WebSocket | null} */
    this.socket = null;
    this.open();
  }

  open() {
    const socket = new WebSocket(`${location.protocol === 'https:' ? 'wss' : 'ws'}://${location.host}/socket`);
    socket.binaryType = 'arraybuffer';
    this.socket = socket;
    socket.onopen = () => {
      this.onState(true);
      this.sendTopics();
      for (const go of this.awaiting.splice(0)) go();
    };
    socket.onmessage = (event) => {
      if (typeof event.data !== 'string') {
        this.onBlob(event.data);
        return;
      }
      const parts = JSON.parse(event.data);
      for (const answer of parts.answers ?? []) {
        this.waiting.get(answer.id)?.(answer);
        this.waiting.delete(answer.id);
      }
      this.onParts(parts);
    };
    socket.onclose = () => {
      for (const answer of this.waiting.values()) answer({ ok: false, text: t('The connection to the server was lost.') });
      this.waiting.clear();
      this.onState(false);
      setTimeout(() => this.open(), LATER);
    };
  }

  /** @param {any} message */
  send(message) {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }

  /** @param {number} limit ms @returns {Promise<void>} when it is open, or after the limit */
  opened(limit) {
    return new Promise((resolve) => {
      if (this.socket?.readyState === WebSocket.OPEN) resolve();
      else {
        this.awaiting.push(resolve);
        setTimeout(resolve, limit);
      }
    });
  }

  /** @param {any} order @returns {Promise<Answer>} */
  ask(order) {
    return new Promise((resolve) => {
      if (this.socket?.readyState !== WebSocket.OPEN) {
        resolve({ ok: false, text: t('There is no connection to the server.') });
        return;
      }
      const id = ++this.last;
      this.waiting.set(id, resolve);
      this.send({ ...order, id });
    });
  }

  /**
   * Topics that one part of the page shows.
   * @param {string} who
   * @param {string[]} topics
   */
  subscribe(who, topics) {
    if (String(this.topics.get(who) ?? []) === String(topics)) return;
    this.topics.set(who, topics);
    this.sendTopics();
  }

  sendTopics() {
    this.send({ do: 'subscribe', topics: [...new Set([...this.topics.values()].flat())] });
  }
}
