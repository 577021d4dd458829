/** The floors of things on the plan and in 3D, in node: python3 -m pytest tests/page/test_home.py */
import { readFileSync } from 'node:fs';
import './browserless.mjs';

const { Home } = await import('./js/home.js');
const { Matrix4 } = await import('./vendor/three/three.module.min.js');
const { Shapes, poseMatrix } = await import('./js/shapes.js');
const { View3d } = await import('./js/view3d.js');

Home.prototype.tell = () => {};
Home.prototype.load = function load(scene) { this.scene = scene; };
globalThis.WebSocket = class {};
const home = new Home();
home.take(JSON.parse(readFileSync(process.argv[2], 'utf8')));
const shapes = new Shapes(home.scene, new Set(), () => [1, 1, 1], true), view = { home, storeyOf: View3d.prototype.storeyOf };
const things = new Map(home.described.things.map((thing) => [thing.name, thing]));
const found = {};
home.scene.links.forEach((link, i) => {
  if (!things.has(link.model)) return;
  const one = (found[link.model] ??= { plan: home.storeyOf(link.model, things.get(link.model).pose[2] + 0.2), parts: [] });
  shapes.place(i, poseMatrix(link.pose, new Matrix4()), (part, z) => {
    one.parts.push(view.storeyOf(part, z), view.storeyOf({ ...part, moves: true }, z));
    return null;
  });
});
console.log(JSON.stringify(found));
