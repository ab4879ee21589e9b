// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What is selected, in numbers that one can change, and what can be done with it.
import {Euler, Quaternion} from './three.module.js';
import {byId, make, tell} from './elements.js';
import {yawOf} from './pose.js';
import {sizeWith} from './shapes.js';

const FIELDS = ['x', 'y', 'z', 'yaw'];

export class SelectionCard {
  constructor({selection, locks, robots, world, mover, undo, edits, viewpoint, notices}) {
    Object.assign(this, {selection, locks, robots, world, mover, undo, edits, viewpoint, notices});
    this.inputs = Object.fromEntries(FIELDS.map((name) => [name, byId(`pose-${name}`)]));
    this.sizes = ['x', 'y', 'z'].map((axis) => byId(`size-${axis}`));
    this.sizes.forEach((input, axis) => input.addEventListener('change', () => this.resize(axis)));
    this.typed = null;
    for (const input of Object.values(this.inputs)) {
      input.addEventListener('input', () => { this.typed = input; });
      input.addEventListener('blur', () => this.endTyping());
      input.addEventListener('change', () => this.move());
    }
    byId('selected-close').addEventListener('click', () => selection.select(null));
    byId('selected-follow').addEventListener('click', () => this.toggleFollow());
    byId('selected-lock').addEventListener('click', () => this.toggleLock());
    byId('selected-delete').addEventListener('click', () => edits.remove(selection.thing));
    this.material = byId('selected-material');
    this.material.addEventListener('change', () =>
      edits.setMaterial(selection.thing.name, this.material.value));
    selection.addEventListener('changed', () => this.update());
    locks.addEventListener('changed', () => this.update());
    viewpoint.addEventListener('follow', () => this.update());
    robots.addEventListener('moved', (event) => {
      const {thing} = selection;
      if (event.detail.kind === thing?.kind && event.detail.name === thing.name) this.updatePose();
    });
  }

  get pose() {
    const {thing} = this.selection;
    return thing && this.robots.poseOf(thing.kind, thing.name);
  }

  update() {
    const {thing} = this.selection;
    byId('selected').hidden = !thing;
    if (!thing) return;
    const isModel = thing.kind === 'models';
    tell(byId('selected-name'), thing.name);
    tell(byId('selected-kind'), isModel ? (thing.movable ? 'model' : 'static model') : 'robot');
    byId('selected-pose').hidden = !this.pose;
    for (const input of Object.values(this.inputs)) input.disabled = !this.locks.moves(thing);
    byId('selected-delete').hidden = !isModel;
    this.updateLock(thing);
    this.updateSize(thing);
    byId('selected-material-field').hidden = !isModel;
    if (isModel) this.updateMaterial(thing.name);
    const isFollowed = this.viewpoint.followed?.name === thing.name;
    byId('selected-follow').setAttribute('aria-pressed', isFollowed);
    tell(byId('selected-follow'), isFollowed ? 'Stop following' : 'Follow');
    this.updatePose();
  }

  updateSize(thing) {
    const shape = thing.kind === 'models' ? this.edits.shapeOf(thing.name) : null;
    byId('selected-size').hidden = !shape;
    this.sizes.forEach((input, axis) => {
      input.disabled = this.locks.isLocked(thing);
      if (shape) input.value = shape.size[axis].toFixed(2);
    });
  }

  resize(axis) {
    const {name} = this.selection.thing;
    const input = this.sizes[axis];
    const {valueMissing, badInput, rangeUnderflow, rangeOverflow} = input.validity;
    if (valueMissing || badInput || rangeUnderflow || rangeOverflow) {
      this.notices.tell(`A size is a number from ${input.min} to ${input.max}, in metres.`);
      this.updateSize(this.selection.thing);
      return;
    }
    this.edits.resize(name, sizeWith(this.edits.shapeOf(name), axis, input.valueAsNumber));
  }

  updateLock(thing) {
    const isLocked = this.locks.isLocked(thing);
    byId('selected-lock').hidden = thing.kind !== 'models';
    tell(byId('selected-lock'), isLocked ? 'Unlock' : 'Lock');
    byId('selected-lock').title = isLocked
      ? 'It belongs to the world: unlock it to move, change or delete it' : 'Keep it as it is';
    this.material.disabled = isLocked;
  }

  updateMaterial(name) {
    const now = [...new Set(this.edits.materialsOf(name))];
    this.material.replaceChildren(
      ...(now.length === 1 ? [] : [make('option', {value: '', disabled: true}, 'several')]),
      ...this.world.materialNames().map((each) => make('option', {value: each}, each)));
    this.material.value = now.length === 1 ? now[0] : '';
  }

  updatePose() {
    const pose = this.pose;
    if (!pose) return;
    const values = [...pose.xyz, yawOf(pose) * 180 / Math.PI];
    FIELDS.forEach((name, i) => {
      const input = this.inputs[name];
      if (this.typed !== input) input.value = values[i].toFixed(i < 3 ? 3 : 1);
    });
  }

  /** From now on the fields show again where the thing is. */
  endTyping() {
    this.typed = null;
    this.updatePose();
  }

  move() {
    const {thing} = this.selection;
    const before = this.robots.poseNow(thing.kind, thing.name);
    const [x, y, z, yaw_deg] = FIELDS.map((name) => this.inputs[name].valueAsNumber);
    this.endTyping();
    if ([x, y, z, yaw_deg].some(Number.isNaN)) {
      this.notices.tell('A place is three numbers in metres, and a yaw is one in degrees.');
      return;
    }
    const euler = new Euler().setFromQuaternion(new Quaternion(...before.q), 'ZYX');
    euler.z = yaw_deg * Math.PI / 180;
    this.mover.move(thing, {xyz: [x, y, z], q: new Quaternion().setFromEuler(euler).toArray()});
    this.undo.moved(thing, before);
  }

  toggleLock() {
    const {thing} = this.selection;
    if (this.locks.isLocked(thing)) this.locks.unlock([thing.name]);
    else this.locks.lock([thing.name]);
  }

  toggleFollow() {
    const {thing} = this.selection;
    if (!thing) return;
    const isFollowed = this.viewpoint.followed?.name === thing.name;
    this.viewpoint.follow(isFollowed ? null : thing.name,
      () => this.robots.positionOf(thing.kind, thing.name));
  }
}
