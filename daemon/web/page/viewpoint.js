// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// From where one looks: orbit, pan, zoom, all of it, straight down as on a plan, and along with a robot.
import {Box3, MOUSE, OrthographicCamera, Spherical, Quaternion, TOUCH, Vector3} from './three.module.js';
import {OrbitControls} from './OrbitControls.js';

const NEAREST_M = 0.2;
const FARTHEST_M = 800;
const SHARE_OF_VIEW = 0.94;
// Higher than all that stands in a world.
const PLAN_HEIGHT_M = 250;
// Slightly from the south, so that x is to the right and y is up.
const DOWN = new Vector3(0, -1e-4, 1);
const UP = new Vector3(0, 0, 1);
// Spherical coordinates of three.js have y up.
const TO_Y_UP = new Quaternion().setFromUnitVectors(UP, new Vector3(0, 1, 0));

export class Viewpoint extends EventTarget {
  constructor(stage) {
    super();
    this.stage = stage;
    this.eye = stage.camera;
    this.plan = new OrthographicCamera(-1, 1, 1, -1, 0, 2 * PLAN_HEIGHT_M);
    this.plan.up.copy(UP);
    // To look from again after a plan.
    this.arm = new Vector3(-6, -8, 9);
    this.controls = new OrbitControls(this.camera, stage.canvas);
    this.controls.enableKeys = false;
    this.controls.minDistance = NEAREST_M;
    this.controls.maxDistance = FARTHEST_M;
    this.controls.maxPolarAngle = 0.497 * Math.PI;
    this.controls.minZoom = 1 / FARTHEST_M;
    this.controls.maxZoom = 1 / NEAREST_M;
    this.controls.addEventListener('change', () => this.changed());
    this.followed = null;
    this.camera.position.copy(this.arm);
    this.controls.update();
    stage.beforeEach(() => this.fitPlan());
  }

  changed() {
    this.stage.invalidate();
    this.dispatchEvent(new Event('change'));
  }

  get camera() {
    return this.stage.camera;
  }

  get isPlan() {
    return this.camera === this.plan;
  }

  get target() {
    return this.controls.target;
  }

  /** From what one looks at to the eye. */
  get direction() {
    return this.camera.position.clone().sub(this.target);
  }

  /** Of a plan, from where the eye would see as much. */
  get distance_m() {
    return this.isPlan ? 1 / this.plan.zoom : this.camera.position.distanceTo(this.target);
  }

  /** Metres that a pixel of the page covers in the middle of the view. */
  get metresPerPixel() {
    return 2 * this.slope * this.distance_m / this.stage.canvas.clientHeight;
  }

  /** And around a place. */
  metresPerPixelAt(place) {
    return this.isPlan
      ? this.metresPerPixel : this.metresPerPixel * this.camera.position.distanceTo(place) / this.distance_m;
  }

  /** Of the upper edge of the view. */
  get slope() {
    return Math.tan(this.eye.fov * Math.PI / 360);
  }

  get aspect() {
    const {clientWidth, clientHeight} = this.stage.canvas;
    return clientWidth / clientHeight;
  }

  state() {
    const at = this.target.toArray();
    if (!this.isPlan) return {eye: this.camera.position.toArray(), at, top: false};
    return {eye: [at[0], at[1], at[2] + this.distance_m], at, top: true};
  }

  restore({eye, at, top}) {
    if (top) {
      this.lookDown(new Vector3(...at), eye[2] - at[2]);
      return;
    }
    this.leavePlan();
    this.camera.position.set(...eye);
    this.target.set(...at);
    this.controls.update();
    this.changed();
  }

  /** Shows a whole box from where one looks now. */
  show(box) {
    this.leavePlan();
    this.fit(box, this.direction);
  }

  /** Shows a whole box as on a plan: what stands on the same place is seen at the same place, be it high or low. */
  fromAbove(box) {
    const size = box.getSize(new Vector3());
    const up = 2 * this.slope * SHARE_OF_VIEW;
    this.lookDown(box.getCenter(new Vector3()), Math.max(size.y / up, size.x / (up * this.aspect)));
  }

  lookDown(middle, distance_m) {
    if (!this.isPlan) this.enterPlan();
    this.plan.zoom = 1 / Math.min(Math.max(distance_m, NEAREST_M), FARTHEST_M);
    this.lookFrom(middle, DOWN, PLAN_HEIGHT_M);
    this.fitPlan(true);
  }

  enterPlan() {
    this.arm.copy(this.eye.position).sub(this.target);
    this.take(this.plan);
  }

  /** Back to where one looked from, at what one looks at now. */
  leavePlan() {
    if (!this.isPlan) return;
    const {distance_m} = this;
    this.take(this.eye);
    this.stage.fit();
    this.lookFrom(this.target.clone(), this.arm, distance_m);
  }

  /** A plan is moved where the world would be turned. */
  take(camera) {
    this.stage.camera = camera;
    this.controls.object = camera;
    this.controls.enableRotate = !this.isPlan;
    this.controls.mouseButtons.LEFT = this.isPlan ? MOUSE.PAN : MOUSE.ROTATE;
    this.controls.touches.ONE = this.isPlan ? TOUCH.PAN : TOUCH.ROTATE;
  }

  /** The view may have become wider. */
  fitPlan(always = false) {
    const right = this.slope * this.aspect;
    if (!always && (!this.isPlan || this.plan.right === right)) return;
    Object.assign(this.plan, {left: -right, right, top: this.slope, bottom: -this.slope});
    this.plan.updateProjectionMatrix();
  }

  /** From a direction, and from so far away that no corner is out of sight. */
  fit(box, direction) {
    const middle = box.getCenter(new Vector3());
    this.lookFrom(middle, direction, 2);
    const up = this.slope * SHARE_OF_VIEW;
    const across = up * this.aspect;
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
    this.leavePlan();
    const arm = this.direction.applyQuaternion(TO_Y_UP);
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
    if (this.isPlan) {
      this.lookDown(this.target.clone(), this.distance_m * factor);
      return;
    }
    const arm = this.direction;
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
