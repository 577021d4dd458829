/** Names of rooms and people over the 3D view. */
import * as THREE from '../vendor/three/three.module.min.js';
import { by, el } from './dom.js';

const MOST = 26; // rooms with a label

export class Labels {
  constructor() {
    /** @type {Map<string, any>} */
    this.shown = new Map();
  }

  /**
   * Places them as the camera sees them; where two would cover each other, the first one stays.
   * @param {import('./view3d.js').View3d} view
   */
  place(view) {
    const wanted = new Map();
    const { home } = view;
    for (const [model, { figure }] of view.people.all) {
      const p = figure.group.position;
      if (figure.group.visible) wanted.set(`person ${model}`, { at: [p.x, p.y, p.z + 2], text: model, person: true });
    }
    const rooms = home.rooms.filter((room) => view.showsStorey(room.storey)).sort((a, b) => b.floor - a.floor); // the upper ones first
    if (rooms.length <= MOST) {
      for (const room of rooms) {
        const at = middleOf(room.polygon), lit = view.glows.meshes.get(room.name)?.userData.lit;
        const lux = view.lux(room);
        wanted.set(`room ${room.name}`, { at: [at[0], at[1], room.floor + 0.3], text: roomText(room), lit, small: lux === null ? '' : `${Math.round(lux)} lx` });
      }
    }
    const { clientWidth: width, clientHeight: height } = view.element, point = new THREE.Vector3();
    for (const [key, label] of this.shown) {
      if (!wanted.has(key)) { label.remove(); this.shown.delete(key); }
    }
    /** @type {number[][]} */
    const taken = [];
    for (const [key, { at, text, lit, person, small }] of wanted) {
      let label = this.shown.get(key);
      if (!label) {
        label = el('div', { class: person ? 'label person' : 'label' }, text, el('small'));
        this.shown.set(key, label);
        by('labels').append(label);
      }
      if (label.lastChild.textContent !== (small ?? '')) label.lastChild.textContent = small ?? '';
      label.classList.toggle('lit', Boolean(lit));
      point.fromArray(at).project(view.camera);
      const x = ((point.x + 1) / 2) * width, y = ((1 - point.y) / 2) * height, half = label.offsetWidth / 2 || 40;
      const free = point.z < 1 && !taken.some(([u, v, w]) => Math.abs(u - x) < half + w + 4 && Math.abs(v - y) < 24);
      if (free) taken.push([x, y, half]);
      label.style.visibility = free ? '' : 'hidden';
      label.style.transform = `translate(${x}px, ${y}px) translate(-50%, -50%)`;
    }
  }
}

/** @param {number[][]} polygon @returns {number[]} */
export function middleOf(polygon) {
  let area = 0, x = 0, y = 0;
  polygon.forEach(([x0, y0], i) => {
    const [x1, y1] = polygon[(i + 1) % polygon.length], cross = x0 * y1 - x1 * y0;
    area += cross;
    x += (x0 + x1) * cross;
    y += (y0 + y1) * cross;
  });
  return area ? [x / (3 * area), y / (3 * area)] : polygon[0];
}

/**
 * Its name without the number of its floor.
 * @param {any} room
 * @returns {string}
 */
export function roomText(room) {
  const name = room.name.replace(/\d+$/, '').replaceAll('_', ' ');
  return name ? name[0].toUpperCase() + name.slice(1) : room.name;
}
