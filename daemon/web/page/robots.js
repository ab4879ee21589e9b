// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where robots and movable models are. A robot without a body in the world gets a mark, so that one can see and take
// it.
import {
  CylinderBufferGeometry, Group, Matrix4, Mesh, RingBufferGeometry, ShapeBufferGeometry, Shape,
  Vector3,
} from './three.module.js';
import {makeSurface} from './surface.js';
import {matrixOf, poseOf} from './pose.js';

const ROBOT = [0.16, 0.47, 0.86];
export const MARK_RADIUS_M = 0.22;

/** Tells moved (detail: {kind, name}) and known, when others are there. */
export class Robots extends EventTarget {
  constructor(stage, connection, world) {
    super();
    this.stage = stage;
    this.connection = connection;
    this.world = world;
    this.poses = {robots: new Map(), models: new Map()};
    this.marks = new Map();
    this.held = null;
    this.isFrozen = false;
    this.missed = new Map();
    this.time_s = 0;
    this.owed = false;
    this.isStale = false;
    connection.addEventListener('text', (event) => this.take(event.detail));
    connection.addEventListener('open', () => {
      this.owed = false;
      this.isStale = true;
    });
    stage.afterEach(() => this.acknowledge());
    world.addEventListener('changed', () => this.placeAll());
  }

  take(message) {
    if (!message.robots && !message.models) return;
    this.time_s = message.time_s ?? this.time_s;
    // The first message of a connection has all that moves.
    if (this.isStale) this.forget();
    const before = this.poses.robots.size + this.poses.models.size;
    for (const kind of ['robots', 'models']) {
      for (const [name, pose] of Object.entries(message[kind] || {})) this.set(kind, name, pose);
    }
    this.owed = true;
    this.stage.invalidate();
    if (this.poses.robots.size + this.poses.models.size !== before) {
      this.dispatchEvent(new Event('known'));
    }
  }

  acknowledge() {
    if (!this.owed) return;
    this.owed = false;
    this.connection.send({ack_poses: true});
  }

  set(kind, name, pose) {
    if (this.held?.kind === kind && this.held.name === name) return;
    if (this.isFrozen) this.missed.set(`${kind}:${name}`, [kind, name, pose]);
    else this.place(kind, name, pose);
  }

  /** While the page stands still, what the daemon says waits. */
  freeze(on) {
    if (this.isFrozen === on) return;
    if (on) this.rememberAll();
    this.isFrozen = on;
    if (on) return;
    for (const late of this.missed.values()) this.place(...late);
    this.missed.clear();
  }

  /** Those that do not move meanwhile come back as well. */
  rememberAll() {
    for (const [kind, poses] of Object.entries(this.poses)) {
      for (const [name, pose] of poses) this.missed.set(`${kind}:${name}`, [kind, name, pose]);
    }
  }

  /** Shows it there at once; what the daemon says comes after. */
  place(kind, name, pose) {
    this.poses[kind].set(name, pose);
    this.world.move(kind, name, pose);
    if (kind === 'robots') this.mark(name, pose);
    this.dispatchEvent(new CustomEvent('moved', {detail: {kind, name}}));
    this.stage.invalidate();
  }

  /** How many can move: robots, and models of their own. */
  get movers() {
    return this.poses.robots.size + this.poses.models.size;
  }

  /** While somebody drags a thing, the daemon's older poses of it do not count. */
  hold(kind, name) {
    this.held = {kind, name};
  }

  release() {
    this.held = null;
  }

  placeAll() {
    for (const [name, pose] of this.poses.robots) this.place('robots', name, pose);
    for (const [name, pose] of this.poses.models) this.world.move('models', name, pose);
  }

  forget() {
    this.isStale = false;
    for (const mark of this.marks.values()) this.stage.scene.remove(mark);
    this.marks.clear();
    this.poses = {robots: new Map(), models: new Map()};
  }

  poseOf(kind, name) {
    const known = this.poses[kind].get(name);
    if (known) return known;
    const body = kind === 'models' ? this.world.bodies.get(`model:${name}`) : null;
    return body ? poseOf(body.matrix) : null;
  }

  positionOf(kind, name) {
    const pose = this.poseOf(kind, name);
    return pose ? new Vector3(...pose.xyz) : null;
  }

  mark(name, pose) {
    const hasBody = this.world.bodies.has(`robot:${name}`);
    if (!this.marks.has(name)) {
      const made = makeMark(name);
      this.marks.set(name, made);
      this.stage.scene.add(made);
    }
    const mark = this.marks.get(name);
    mark.visible = !hasBody;
    mark.matrix.copy(matrixOf(pose));
    mark.matrixWorldNeedsUpdate = true;
  }
}

function makeMark(name) {
  const group = new Group();
  group.matrixAutoUpdate = false;
  const surface = makeSurface(ROBOT);
  const body = new Mesh(new CylinderBufferGeometry(MARK_RADIUS_M, MARK_RADIUS_M, 0.12, 40), surface);
  body.rotation.x = Math.PI / 2;
  body.position.z = 0.09;
  const rim = new Mesh(new RingBufferGeometry(MARK_RADIUS_M, MARK_RADIUS_M + 0.02, 40), surface);
  rim.position.z = 0.02;
  const arrow = new Mesh(new ShapeBufferGeometry(arrowShape()), makeSurface([1, 1, 1]));
  arrow.position.z = 0.155;
  group.add(body, rim, arrow);
  group.userData = {robot: name};
  group.matrix.copy(new Matrix4());
  return group;
}

function arrowShape() {
  const shape = new Shape();
  shape.moveTo(0.15, 0);
  shape.lineTo(-0.08, 0.09);
  shape.lineTo(-0.04, 0);
  shape.lineTo(-0.08, -0.09);
  return shape;
}
