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

const KINDS = ['robots', 'models'];
const ROBOT = [0.16, 0.47, 0.86];
export const MARK_RADIUS_M = 0.22;

/** Tells moved and gone (detail: {kind, name}), and known, when others are there. */
export class Robots extends EventTarget {
  constructor(stage, connection, world) {
    super();
    this.stage = stage;
    this.connection = connection;
    this.world = world;
    this.poses = {robots: new Map(), models: new Map()};
    this.marks = new Map();
    this.held = null;
    // What the daemon says, while the page stands still and shows something else.
    this.present = null;
    this.time_s = 0;
    this.owed = false;
    this.isStale = false;
    this.isWhole = false;
    connection.addEventListener('text', (event) => this.take(event.detail));
    connection.addEventListener('open', () => {
      this.owed = false;
      this.isStale = true;
    });
    stage.afterEach(() => this.acknowledge());
    world.addEventListener('changed', () => this.placeAll());
  }

  take(message) {
    if ('scene' in message) this.isWhole = true;
    if (!message.robots && !message.models) return;
    this.time_s = message.time_s ?? this.time_s;
    // The first message of a connection has all that moves, and so has the first about another scene.
    const isWhole = this.isStale || this.isWhole;
    this.isStale = this.isWhole = false;
    if (isWhole) this.keepOnly(message);
    const before = this.movers;
    for (const kind of KINDS) {
      for (const [name, pose] of Object.entries(message[kind] || {})) this.set(kind, name, pose);
    }
    this.owed = true;
    this.stage.invalidate();
    if (this.movers !== before) this.dispatchEvent(new Event('known'));
  }

  acknowledge() {
    if (!this.owed) return;
    this.owed = false;
    this.connection.send({ack_poses: true});
  }

  set(kind, name, pose) {
    if (this.isHeld(kind, name)) return;
    if (this.isFrozen) this.present[kind].set(name, pose);
    else this.place(kind, name, pose);
  }

  get isFrozen() {
    return this.present !== null;
  }

  /** While the page stands still, what the daemon says waits. */
  freeze(on) {
    if (this.isFrozen === on) return;
    const {present} = this;
    this.present = on ? {robots: new Map(this.poses.robots), models: new Map(this.poses.models)} : null;
    if (!on) this.showOnly(present);
  }

  /** These poses, {robots, models}, and nothing else that moves. */
  showOnly(poses) {
    this.dropAllBut((kind, name) => poses[kind].has(name));
    for (const kind of KINDS) {
      for (const [name, pose] of poses[kind]) {
        if (!this.isHeld(kind, name)) this.place(kind, name, pose);
      }
    }
    this.dispatchEvent(new Event('known'));
  }

  /** Shows it there at once; what the daemon says comes after. */
  place(kind, name, pose) {
    this.poses[kind].set(name, pose);
    this.world.move(kind, name, pose);
    if (kind === 'robots') this.mark(name, pose);
    this.dispatchEvent(new CustomEvent('moved', {detail: {kind, name}}));
    this.stage.invalidate();
  }

  /** How many can move now: robots, and models of their own. */
  get movers() {
    const {robots, models} = this.present || this.poses;
    return robots.size + models.size;
  }

  /** While somebody drags a thing, the daemon's older poses of it do not count. */
  hold(kind, name) {
    this.held = {kind, name};
  }

  isHeld(kind, name) {
    return this.held?.kind === kind && this.held.name === name;
  }

  release() {
    this.held = null;
  }

  /** Other objects are there, which stand where they stood: nothing has moved. */
  placeAll() {
    for (const [name, pose] of this.poses.robots) {
      this.world.move('robots', name, pose);
      this.mark(name, pose);
    }
    for (const [name, pose] of this.poses.models) this.world.move('models', name, pose);
  }

  /** The others are gone. In the past they may still be seen. */
  keepOnly(message) {
    const isThere = (kind, name) => name in (message[kind] || {});
    if (!this.isFrozen) {
      if (this.dropAllBut(isThere)) this.dispatchEvent(new Event('known'));
      return;
    }
    for (const kind of KINDS) {
      for (const name of this.present[kind].keys()) {
        if (!isThere(kind, name)) this.present[kind].delete(name);
      }
    }
  }

  /** True if some are gone. */
  dropAllBut(isThere) {
    const gone = KINDS.flatMap((kind) =>
      [...this.poses[kind].keys()].filter((name) => !isThere(kind, name)).map((name) => [kind, name]));
    for (const [kind, name] of gone) this.drop(kind, name);
    return gone.length > 0;
  }

  /** It is gone, as the daemon will say. */
  leave(kind, name) {
    this.present?.[kind].delete(name);
    this.drop(kind, name);
    this.dispatchEvent(new Event('known'));
  }

  drop(kind, name) {
    this.poses[kind].delete(name);
    if (kind === 'robots') {
      this.stage.scene.remove(this.marks.get(name));
      this.marks.delete(name);
    }
    this.dispatchEvent(new CustomEvent('gone', {detail: {kind, name}}));
  }

  poseOf(kind, name) {
    const known = this.poses[kind].get(name);
    if (known) return known;
    const body = kind === 'models' ? this.world.bodies.get(`model:${name}`) : null;
    return body ? poseOf(body.matrix) : null;
  }

  /** Where it is now, whatever the page shows. */
  poseNow(kind, name) {
    return this.present?.[kind].get(name) ?? this.poseOf(kind, name);
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
