// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Drives the selected robot or model, or the first robot, with W A S D or a gamepad: ahead and back, and turns.
import {isDialogOpen} from './elements.js';
import {turned, yawOf, movedTo} from './pose.js';

const SPEED_M_S = 0.8;
const FAST = 2.5;
const TURN_RAD_S = 1.3;
const DEAD_ZONE = 0.15;
const KEYS = new Set(['w', 'a', 's', 'd']);

export class Drive {
  constructor({stage, selection, locks, robots, mover, undo}) {
    Object.assign(this, {stage, selection, locks, robots, mover, undo});
    this.pressed = new Set();
    this.fast = false;
    this.begin = null;
    stage.beforeEach((past_s) => this.go(past_s));
    window.addEventListener('keyup', (event) => this.lift(event.key.toLowerCase()));
    window.addEventListener('blur', () => this.pressed.clear());
    window.addEventListener('gamepadconnected', () => stage.invalidate());
  }

  /** True if the key is one of those that drive. */
  press(key, fast) {
    if (!KEYS.has(key)) return false;
    this.pressed.add(key);
    this.fast = fast;
    this.stage.invalidate();
    return true;
  }

  lift(key) {
    this.pressed.delete(key);
  }

  get thing() {
    const selected = this.selection.thing;
    if (this.locks.moves(selected)) return selected;
    return this.selection.things().find((thing) => thing.kind === 'robots') || null;
  }

  /** {ahead, left} from -1 to 1. */
  wish() {
    const key = (name) => (this.pressed.has(name) && !isDialogOpen() ? 1 : 0);
    const wish = {ahead: key('w') - key('s'), left: key('a') - key('d')};
    for (const pad of navigator.getGamepads?.() || []) {
      if (!pad?.connected) continue;
      const axis = (index) => Math.abs(pad.axes[index] || 0) > DEAD_ZONE ? pad.axes[index] : 0;
      wish.ahead -= axis(1);
      wish.left -= axis(0) || axis(2);
      this.fast = this.fast || Boolean(pad.buttons[0]?.pressed);
      // There are no events of sticks, so they are looked at with each picture.
      this.stage.invalidate();
    }
    return wish;
  }

  go(past_s) {
    const {ahead, left} = this.wish();
    const thing = this.thing;
    const pose = thing && this.robots.poseOf(thing.kind, thing.name);
    if (!pose || (!ahead && !left)) {
      this.end();
      return;
    }
    if (!this.begin) {
      this.begin = {thing, pose: this.robots.poseNow(thing.kind, thing.name)};
      this.robots.hold(thing.kind, thing.name);
    }
    this.mover.move(thing, this.next(pose, ahead, left, past_s));
    this.stage.invalidate();
  }

  next(pose, ahead, left, past_s) {
    const yaw = yawOf(pose);
    const step_m = ahead * SPEED_M_S * (this.fast ? FAST : 1) * past_s;
    const [x, y, z] = pose.xyz;
    const there = [x + step_m * Math.cos(yaw), y + step_m * Math.sin(yaw), z];
    return turned(movedTo(pose, there), left * TURN_RAD_S * past_s);
  }

  end() {
    if (!this.begin) return;
    this.undo.moved(this.begin.thing, this.begin.pose);
    this.robots.release();
    this.begin = null;
  }
}
