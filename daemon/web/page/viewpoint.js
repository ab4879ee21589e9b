// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// From where one looks: orbit, pan, zoom, from above, all of it, and along with a robot.
import {Box3, Spherical, Quaternion, Vector3} from './three.module.js';
import {OrbitControls} from './OrbitControls.js';

const NEAREST_M = 0.2;
const FARTHEST_M = 800;
const SHARE_OF_VIEW = 0.94;
const UP = new Vector3(0, 0, 1);
// Spherical coordinates of three.js have y up.
const TO_Y_UP = new Quaternion().setFromUnitVectors(UP, new Vector3(0, 1, 0));

export class Viewpoint extends EventTarget {
  constructor(stage) {
    super();
    this.stage = stage;
    this.camera = stage.camera;
    this.controls = new OrbitControls(this.camera, stage.canvas);
    this.controls.enableKeys = false;
    this.controls.minDistance = NEAREST_M;
    this.controls.maxDistance = FARTHEST_M;
    this.controls.maxPolarAngle = 0.497 * Math.PI;
    this.controls.addEventListener('change', () => this.changed());
    this.followed = null;
    this.camera.position.set(-6, -8, 9);
    this.controls.update();
  }

  changed() {
    this.stage.invalidate();
    this.dispatchEvent(new Event('change'));
  }

  get target() {
    return this.controls.target;
  }

  get distance_m() {
    return this.camera.position.distanceTo(this.target);
  }

  /** Metres that a pixel of the page covers in the middle of the view. */
  get metresPerPixel() {
    const half = Math.tan(this.camera.fov * Math.PI / 360) * this.distance_m;
    return 2 * half / this.stage.canvas.clientHeight;
  }

  state() {
    return {eye: this.camera.position.toArray(), at: this.target.toArray()};
  }

  restore({eye, at}) {
    this.camera.position.set(...eye);
    this.target.set(...at);
    this.controls.update();
    this.changed();
  }

  /** Shows a whole box from where one looks now. */
  show(box) {
    this.fit(box, this.camera.position.clone().sub(this.target));
  }

  /** Slightly from the south, so that x is to the right and y is up. */
  fromAbove(box) {
    this.fit(box, new Vector3(0, -1e-4, 1));
  }

  /** From a direction, and from so far away that no corner is out of sight. */
  fit(box, direction) {
    const middle = box.getCenter(new Vector3());
    this.lookFrom(middle, direction, 2);
    const up = Math.tan(this.camera.fov * Math.PI / 360) * SHARE_OF_VIEW;
    const across = up * this.camera.aspect;
    const toCamera = this.camera.quaternion.clone().inverse();
    let distance_m = NEAREST_M;
    for (const corner of cornersOf(box)) {
      const {x, y, z} = corner.sub(middle).applyQuaternion(toCamera);
      distance_m = Math.max(distance_m, z + Math.abs(x) / across, z + Math.abs(y) / up);
    }
    this.lookFrom(middle, direction, Math.min(distance_m, FARTHEST_M));
  }

  lookFrom(middle, direction, distance_m) {
    this.target.copy(middle);
    this.camera.position.copy(middle).addScaledVector(direction.clone().normalize(), distance_m);
    this.controls.update();
    this.changed();
  }

  orbit(around_rad, up_rad) {
    const arm = this.camera.position.clone().sub(this.target).applyQuaternion(TO_Y_UP);
    const spherical = new Spherical().setFromVector3(arm);
    spherical.theta += around_rad;
    const lowest = this.controls.maxPolarAngle;
    spherical.phi = Math.min(Math.max(spherical.phi - up_rad, 1e-4), lowest);
    arm.setFromSpherical(spherical).applyQuaternion(TO_Y_UP.clone().inverse());
    this.camera.position.copy(this.target).add(arm);
    this.controls.update();
    this.changed();
  }

  /** By pixels of the page. */
  pan(right_px, up_px) {
    const right = new Vector3().setFromMatrixColumn(this.camera.matrix, 0);
    const ahead = new Vector3().crossVectors(UP, right);
    const step = right.multiplyScalar(right_px).addScaledVector(ahead, up_px);
    this.move(step.multiplyScalar(this.metresPerPixel));
  }

  move(step) {
    this.target.add(step);
    this.camera.position.add(step);
    this.controls.update();
    this.changed();
  }

  zoom(factor) {
    const arm = this.camera.position.clone().sub(this.target);
    const distance_m = Math.min(Math.max(arm.length() * factor, NEAREST_M), FARTHEST_M);
    this.lookFrom(this.target.clone(), arm, distance_m);
  }

  /** place() tells where the followed thing is now; null follows nothing. */
  follow(name, place) {
    this.followed = name ? {name, place} : null;
    if (name) this.keepUp();
    this.dispatchEvent(new Event('follow'));
  }

  keepUp() {
    const there = this.followed?.place();
    if (!there) return;
    const step = there.clone().sub(this.target);
    if (step.lengthSq() > 1e-10) this.move(step);
  }
}

function cornersOf({min, max}) {
  return [0, 1, 2, 3, 4, 5, 6, 7].map((i) => new Vector3(
    (i & 1 ? max : min).x, (i & 2 ? max : min).y, (i & 4 ? max : min).z));
}

/** The box of a few metres around a place, for worlds that have nothing. */
export function boxAround(place, half_m) {
  const size = new Vector3(2 * half_m, 2 * half_m, half_m);
  return new Box3().setFromCenterAndSize(place, size);
}
