/** The view from a person's eyes, a robot or a camera: it goes where they go. */
import * as THREE from '../vendor/three/three.module.min.js';
import { yawOf } from './fields.js';
import { poseMatrix } from './shapes.js';

const WIDE = 72, ROBOT = 47, USUAL = 38; // degrees of the view, upright: a person's, a robot's without a camera, that of the home
const STAND = 0.93, SIT = 1.15, LIE = 0.75; // share of a height; m over the floor
const TOP = 0.5; // m over the base of a robot without a camera
const DOWN = 0.12, UP = 1; // rad that one looks down; up, who lies
const CAMERAS = ['camera', 'depth'];
const turn = new THREE.Matrix4(), way = new THREE.Vector3();

export class Eyes {
  /** @param {import('./view3d.js').View3d} view */
  constructor(view) {
    this.view = view;
    /** @type {any} whose view it is */
    this.entity = null;
    /** @type {{storey: number | null, walls: string, at: any, target: any} | null} */
    this.before = null;
    /** @type {() => void} */
    this.ended = () => {};
  }

  /** @param {any} entity @returns {boolean} whether it sees */
  has(entity) {
    return entity.kind === 'person' || this.view.home.isRobot(entity) || CAMERAS.includes(entity.kind);
  }

  /** @param {any} entity @param {() => void} ended */
  begin(entity, ended) {
    this.end();
    const { view } = this, { camera, controls } = view.viewpoint;
    this.before = { storey: view.storey, walls: view.walls, at: camera.position.clone(), target: controls.target.clone() };
    this.entity = entity;
    this.ended = ended;
    view.viewpoint.goal = null;
    controls.enabled = false;
    view.people.hidden = entity.kind === 'person' ? entity.model : '';
    this.widen(this.wide());
    view.fields.group.visible = false;
    document.body.classList.add('eyes');
    view.storey = view.home.storeyAt(view.home.place(entity)[2]);
    view.setWalls('full');
  }

  end() {
    if (!this.entity || !this.before) return;
    const { view, before } = this, { camera, controls } = view.viewpoint;
    this.entity = null;
    view.people.hidden = '';
    this.widen(USUAL);
    view.fields.group.visible = true;
    camera.position.copy(before.at);
    controls.target.copy(before.target);
    camera.lookAt(before.target); // a picture may be taken before the next frame
    controls.enabled = true;
    document.body.classList.remove('eyes');
    view.storey = before.storey;
    view.setWalls(before.walls);
    this.ended();
  }

  /** @returns {number} degrees of the view, upright, in which the whole picture of the camera is */
  wide() {
    const { camera: { aspect } } = this.view.viewpoint, { camera: own } = this.camera();
    const field = own && this.view.home.scene?.sensors.find((/** @type {any} */ one) => one.kind === own.kind && one.name === own.name);
    return field ? (2 * Math.atan(Math.max(Math.tan(field.pitch[1]), Math.tan(field.yaw[1]) / aspect)) * 180) / Math.PI : this.entity.kind === 'person' ? WIDE : ROBOT;
  }

  /** @param {number} degrees of the view, upright */
  widen(degrees) {
    const { camera } = this.view.viewpoint;
    camera.fov = degrees;
    camera.updateProjectionMatrix();
  }

  /** @returns {any} the camera that the entity is or has, and the place of what it is mounted on when both were listed */
  camera() {
    const { home } = this.view, own = home.ofModel(this.entity.model).filter((e) => CAMERAS.includes(e.kind));
    return { camera: own.includes(this.entity) ? this.entity : own[0], base: home.movers.find((e) => e.model === this.entity.model && home.isRobot(e)) };
  }

  /** Puts the camera where the eyes are. */
  place() {
    const { view, entity } = this, { home } = view, { camera } = view.viewpoint;
    if (!home.entities.some((e) => e.kind === entity.kind && e.name === entity.name)) { this.end(); return; }
    const link = home.linksOf(entity.model)[0], pose = link === undefined ? entity.pose : view.drawn.get(link) ?? home.pose(link);
    const { camera: sensor, base } = this.camera(), figure = view.people.all.get(entity.model)?.figure;
    let yaw = yawOf(pose), pitch = -DOWN;
    if (sensor) {
      poseMatrix(sensor.pose, turn);
      if (base) turn.premultiply(poseMatrix(base.pose, new THREE.Matrix4()).invert()).premultiply(poseMatrix(pose, new THREE.Matrix4()));
      way.set(1, 0, 0).transformDirection(turn);
      camera.position.setFromMatrixPosition(turn);
      yaw = Math.atan2(way.y, way.x);
      pitch = Math.asin(Math.max(-1, Math.min(1, way.z)));
    } else if (figure) {
      const { position } = figure.group, up = figure.posture === 'sit' ? SIT : figure.posture === 'lie' ? LIE : STAND * figure.height;
      camera.position.set(position.x, position.y, position.z + up);
      if (figure.posture === 'lie') pitch = UP;
    } else camera.position.set(pose[0], pose[1], pose[2] + TOP);
    way.set(Math.cos(yaw) * Math.cos(pitch), Math.sin(yaw) * Math.cos(pitch), Math.sin(pitch)).add(camera.position);
    camera.lookAt(way);
    const storey = home.storeyAt(camera.position.z);
    if (storey !== view.storey) { view.storey = storey; view.placeAll(); }
  }
}
