/** Names of rooms and people over the 3D view. */
import * as THREE from '../vendor/three/three.module.min.js';
import { by, el, words } from './dom.js';
import { inside, middleOf } from './home.js';
import { t } from './lang.js';
import { Taken } from './places.js';

const MOST = 26; // rooms with a label
const LINE = 24; // px of a label's height
const NEAR = [0, 1, -1].map((line) => [0, line * LINE]), OTHERS = [0, -1, 1, -2, -3, 2, 3].map((line) => [0, line * LINE]); // px

export class Labels {
  constructor() {
    /** @type {Map<string, any>} */
    this.shown = new Map();
  }

  /**
   * Places them as the camera sees them; where two would cover each other, the second one moves up or down.
   * @param {import('./view3d.js').View3d} view
   */
  place(view) {
    const due = new Map();
    const { home } = view, floors = view.storey === null ? home.rooms : []; // these may hide a label
    for (const [model, { figure, text: doing }] of view.people.all) {
      const p = figure.group.position;
      if (figure.group.visible) due.set(`person ${model}`, { at: [p.x, p.y, p.z + 2], text: model, person: true, small: t(doing.replaceAll('_', ' ')), behind: isBehind(view, floors, [p.x, p.y, p.z + 0.9]) });
    }
    const rooms = home.rooms.filter((room) => view.showsStorey(room.storey)).sort((a, b) => b.floor - a.floor); // the upper ones first
    if (rooms.length <= MOST) {
      for (const room of rooms) {
        const middle = middleOf(room.polygon), at = [...middle, room.floor + 0.3];
        if (isBehind(view, floors, at)) continue;
        const lit = view.glows.meshes.get(room.name)?.userData.lit;
        const lux = view.lights.lux(room);
        due.set(`room ${room.name}`, { at, text: roomText(room), lit, small: lux === null || lux < 0.5 ? '' : `${Math.round(lux)} lx` });
      }
    }
    const { clientWidth: width, clientHeight: height } = view.element, point = new THREE.Vector3();
    for (const [key, label] of this.shown) {
      if (!due.has(key)) { label.remove(); this.shown.delete(key); }
    }
    const taken = new Taken();
    for (const [key, { at, text, lit, person, small, behind }] of due) {
      let label = this.shown.get(key);
      if (!label) {
        label = el('div', { class: person ? 'label person' : 'label' }, text, el('small'));
        this.shown.set(key, label);
        by('labels').append(label);
      }
      if (!label.half || label.lastChild.textContent !== (small ?? '')) {
        label.lastChild.textContent = small ?? '';
        label.half = label.offsetWidth / 2;
      }
      label.classList.toggle('lit', Boolean(lit));
      label.classList.toggle('behind', Boolean(behind));
      point.fromArray(at).project(view.viewpoint.camera);
      const x = ((point.x + 1) / 2) * width, y = ((1 - point.y) / 2) * height, half = label.half || 40;
      const free = point.z < 1 ? taken.put([x, y, half + 2, LINE / 2], person ? OTHERS : NEAR) : null;
      label.style.visibility = free ? '' : 'hidden';
      if (free) label.style.transform = `translate(${x + free[0]}px, ${y + free[1]}px) translate(-50%, -50%)`;
    }
  }
}

/**
 * Whether the floor of a room above hides a place.
 * @param {import('./view3d.js').View3d} view @param {any[]} rooms @param {number[]} at
 */
function isBehind(view, rooms, at) {
  const eye = view.viewpoint.camera.position;
  return rooms.some((room) => {
    if (room.floor < at[2] + 1 || eye.z < room.floor) return false;
    const part = (room.floor - at[2]) / (eye.z - at[2]);
    return inside(room.polygon, at[0] + part * (eye.x - at[0]), at[1] + part * (eye.y - at[1]));
  });
}

/**
 * Its name without the number of its floor.
 * @param {any} room
 * @returns {string}
 */
export function roomText(room) {
  const name = room.name.replace(/\d+$/, '');
  return name ? words(name) : room.name;
}

/** @param {{number: number, name: string}} storey */
export const floorText = ({ number, name }) => (!name || name === `Floor ${number}` ? t('Floor {number}', { number }) : t(name));
