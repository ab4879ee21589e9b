// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The ring around the selected thing, by which it is turned; its notch shows where the thing looks.
import {
  ConeBufferGeometry, DoubleSide, Group, Mesh, MeshBasicMaterial, RingBufferGeometry,
} from './three.module.js';
import {yawOf} from './pose.js';

const COLOUR = 0xf09a1a;
const LEAST_PX = 46;

export class Ring {
  constructor({stage, viewpoint, selection, locks, robots}) {
    Object.assign(this, {stage, viewpoint, selection, locks, robots});
    const material = new MeshBasicMaterial({
      color: COLOUR, side: DoubleSide, transparent: true, opacity: 0.85, depthTest: false,
    });
    this.band = new Mesh(new RingBufferGeometry(0.9, 1, 64), material);
    // What a finger meets is wider than what one sees.
    this.grip = new Mesh(new RingBufferGeometry(0.78, 1.14, 32), new MeshBasicMaterial({
      side: DoubleSide, visible: false}));
    const notch = new Mesh(new ConeBufferGeometry(0.12, 0.24, 3), material);
    notch.rotation.z = -Math.PI / 2;
    notch.position.x = 1.06;
    this.group = new Group();
    this.group.add(this.band, this.grip, notch);
    this.group.traverse((part) => { part.renderOrder = 5; });
    this.group.visible = false;
    stage.scene.add(this.group);
    stage.beforeEach(() => this.place());
  }

  place() {
    const thing = this.selection.thing;
    const pose = this.locks.moves(thing) ? this.robots.poseOf(thing.kind, thing.name) : null;
    this.group.visible = Boolean(pose);
    if (!pose) return;
    this.group.position.set(pose.xyz[0], pose.xyz[1], pose.xyz[2] + 0.02);
    this.group.rotation.z = yawOf(pose);
    const radius_m = Math.max(0.45, LEAST_PX * this.viewpoint.metresPerPixelAt(this.group.position));
    this.group.scale.set(radius_m, radius_m, radius_m);
    this.group.updateMatrixWorld();
  }

  /** [{place, radius_px}] of the ring, if it is seen. */
  places() {
    const {position, scale} = this.group;
    return this.group.visible
      ? [{place: position, radius_px: 1.2 * scale.x / this.viewpoint.metresPerPixelAt(position)}] : [];
  }

  under(event) {
    if (!this.group.visible) return null;
    this.selection.aim(event);
    return this.selection.caster.intersectObject(this.grip)[0] || null;
  }
}
