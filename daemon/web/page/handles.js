// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The handles by which what was added here is made larger or smaller: one on each side and one on top. While one is
// dragged, edges show the size to come; the world changes when it is let go.
import {
  BoxBufferGeometry, EdgesGeometry, Group, LineBasicMaterial, LineSegments, Matrix4, Mesh, MeshBasicMaterial, Plane,
  Vector3,
} from './three.module.js';
import {matrixOf} from './pose.js';
import {middleOf, stretched} from './shapes.js';

const COLOUR = 0xf09a1a;
const SIZE_PX = 9;
const GRIP_PX = 26;
const FACES = [[0, 1], [0, -1], [1, 1], [1, -1], [2, 1]];

export class Handles {
  constructor({stage, viewpoint, selection, locks, robots, edits}) {
    Object.assign(this, {stage, viewpoint, selection, locks, robots, edits});
    const cube = new BoxBufferGeometry(1, 1, 1);
    const seen = new MeshBasicMaterial({color: COLOUR, depthTest: false, transparent: true});
    this.grips = FACES.map(([axis, sign]) => {
      const grip = new Mesh(cube, new MeshBasicMaterial({visible: false}));
      const mark = new Mesh(cube, seen);
      mark.scale.setScalar(SIZE_PX / GRIP_PX);
      mark.renderOrder = 6;
      grip.add(mark);
      grip.userData = {axis, sign};
      return grip;
    });
    this.edges = new LineSegments(new EdgesGeometry(cube), new LineBasicMaterial({color: COLOUR, depthTest: false}));
    this.edges.matrixAutoUpdate = false;
    this.edges.renderOrder = 6;
    this.group = new Group();
    this.group.add(...this.grips, this.edges);
    stage.scene.add(this.group);
    this.drag = null;
    stage.beforeEach(() => this.place());
  }

  /** {shape, pose} of what can be resized now, or null. */
  get target() {
    const {thing} = this.selection;
    const shape = thing?.kind === 'models' && !this.locks.isLocked(thing) ? this.edits.shapeOf(thing.name) : null;
    const pose = shape && this.robots.poseOf('models', thing.name);
    return pose ? {name: thing.name, shape, pose} : null;
  }

  place() {
    const target = this.drag ?? this.target;
    this.group.visible = Boolean(target);
    this.edges.visible = Boolean(this.drag);
    if (!target) return;
    const {size, shift} = this.drag?.next ?? {size: target.shape.size, shift: [0, 0, 0]};
    const matrix = matrixOf(target.pose);
    const middle = new Vector3(...middleOf(target.shape, size)).add(new Vector3(...shift));
    for (const grip of this.grips) {
      const {axis, sign} = grip.userData;
      grip.visible = axis !== 2 || !this.viewpoint.isPlan;
      grip.position.copy(faceOf(middle, size, axis, sign).applyMatrix4(matrix));
      grip.quaternion.setFromRotationMatrix(matrix);
      grip.scale.setScalar(GRIP_PX * this.viewpoint.metresPerPixelAt(grip.position));
    }
    const there = new Matrix4().makeTranslation(...middle.toArray());
    this.edges.matrix.copy(matrix).multiply(there).scale(new Vector3(...size));
    this.group.updateMatrixWorld();
  }

  /** [{place, radius_px}] of the handles that are seen. */
  places() {
    return this.group.visible ? this.grips.filter((grip) => grip.visible)
      .map(({position}) => ({place: position, radius_px: GRIP_PX / 2})) : [];
  }

  /** The handle under the pointer, or null. */
  under(event) {
    if (!this.group.visible) return null;
    this.selection.aim(event);
    const grips = this.grips.filter((grip) => grip.visible);
    return this.selection.caster.intersectObjects(grips, false)[0]?.object ?? null;
  }

  /** Whether a drag has begun here. */
  press(event) {
    const grip = this.under(event);
    const target = grip && this.target;
    if (!target) return false;
    const {axis, sign} = grip.userData;
    const along = new Vector3().setComponent(axis, sign).transformDirection(matrixOf(target.pose));
    this.drag = {...target, axis, sign, along, at: grip.position.clone(), next: null};
    this.drag.from_m = this.alongUnder(event);
    return true;
  }

  move(event) {
    const {shape, axis, sign, from_m} = this.drag;
    const to_m = this.alongUnder(event);
    if (to_m === null || from_m === null) return;
    this.drag.next = stretched(shape, axis, sign, to_m - from_m);
    this.stage.invalidate();
  }

  release() {
    const {name, next} = this.drag;
    this.drag = null;
    if (next) this.edits.resize(name, next.size, next.shift);
    this.stage.invalidate();
  }

  /** How far along the handle's own line the pointer is, in the plane through the line that faces the eye most. */
  alongUnder(event) {
    const {at, along} = this.drag;
    this.selection.aim(event);
    const {ray} = this.selection.caster;
    const across = new Vector3().crossVectors(along, ray.direction);
    const plane = new Plane().setFromNormalAndCoplanarPoint(across.cross(along).normalize(), at);
    const there = ray.intersectPlane(plane, new Vector3());
    return there ? there.sub(at).dot(along) : null;
  }
}

/** The middle of a face. */
function faceOf(middle, size, axis, sign) {
  const place = middle.clone();
  return place.setComponent(axis, place.getComponent(axis) + sign * size[axis] / 2);
}
