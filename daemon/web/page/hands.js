// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The pointer's hands: a click selects, a drag of a robot or a movable model moves it over the ground, and a drag of
// the ring around the selected thing, or with Shift, turns it, and a drag of a handle resizes what was added here.
import {isOnPoint} from './points_under.js';
import {movedTo, turned} from './pose.js';

const SLACK_PX = 4;
const MOST_TO_HOVER = 200_000;

export class Hands {
  constructor({stage, viewpoint, selection, locks, robots, mover, undo, ring, handles}) {
    Object.assign(this, {stage, viewpoint, selection, locks, robots, mover, undo, ring, handles});
    this.drag = null;
    const canvas = stage.canvas;
    canvas.addEventListener('pointerdown', (event) => this.press(event));
    canvas.addEventListener('pointermove', (event) => this.move(event));
    canvas.addEventListener('pointerup', (event) => this.release(event));
    canvas.addEventListener('pointercancel', () => this.end());
    canvas.addEventListener('contextmenu', (event) => event.preventDefault());
  }

  press(event) {
    if (event.button !== 0 || !event.isPrimary) {
      this.drag = null;
      this.viewpoint.controls.enabled = true;
      return;
    }
    if (this.handles.press(event)) {
      this.viewpoint.controls.enabled = false;
      this.stage.canvas.setPointerCapture(event.pointerId);
      return;
    }
    const ring = this.ring.under(event);
    const under = ring ? null : this.selection.under(event);
    const thing = ring ? this.selection.thing : under?.thing;
    this.drag = {thing, distance_m: under?.distance_m, x: event.clientX, y: event.clientY, begun: false};
    if (!this.locks.moves(thing)) return;
    const pose = this.robots.poseOf(thing.kind, thing.name);
    if (!pose) return;
    this.viewpoint.controls.enabled = false;
    this.stage.canvas.setPointerCapture(event.pointerId);
    const height_m = ring ? pose.xyz[2] : under.point.z;
    const turns = Boolean(ring) || event.shiftKey;
    Object.assign(this.drag, {
      pose, turns, height_m, from: this.selection.onHeight(event, height_m),
    });
  }

  move(event) {
    if (this.handles.drag) {
      this.handles.move(event);
      return;
    }
    if (!this.drag) {
      this.hover(event);
      return;
    }
    const far = Math.hypot(event.clientX - this.drag.x, event.clientY - this.drag.y) > SLACK_PX;
    if (!this.drag.begun && !far) return;
    if (!this.drag.begun) this.begin();
    if (this.drag.from) this.follow(event);
  }

  begin() {
    this.drag.begun = true;
    if (!this.drag.from) return;
    const {thing} = this.drag;
    this.drag.before = this.robots.poseNow(thing.kind, thing.name);
    this.selection.select(thing);
    this.robots.hold(thing.kind, thing.name);
    this.stage.canvas.classList.add('holding');
  }

  follow(event) {
    const {thing, pose, from, height_m, turns} = this.drag;
    const to = this.selection.onHeight(event, height_m);
    if (!to) return;
    const [x, y, z] = pose.xyz;
    if (turns) {
      const angle_rad = Math.atan2(to.y - y, to.x - x) - Math.atan2(from.y - y, from.x - x);
      this.mover.move(thing, turned(pose, angle_rad));
    } else {
      this.mover.move(thing, movedTo(pose, [x + to.x - from.x, y + to.y - from.y, z]));
    }
  }

  /** A click on a point of a scan is about the point, not about what stands behind it. */
  release(event) {
    const {drag} = this;
    const isClick = drag && !drag.begun;
    this.end();
    if (!isClick || isOnPoint(this.stage, event, drag.distance_m)) return;
    this.selection.select(drag.thing || null);
  }

  end() {
    if (this.handles.drag) this.handles.release();
    const {drag} = this;
    this.drag = null;
    this.viewpoint.controls.enabled = true;
    if (!drag?.begun || !drag.from) return;
    this.robots.release();
    this.stage.canvas.classList.remove('holding');
    this.undo.moved(drag.thing, drag.before);
  }

  /** The cursor tells what can be taken, once a picture, and not in worlds through which it takes long to look. */
  hover(event) {
    if (event.pointerType !== 'mouse' || event.buttons) return;
    if (this.selection.world.triangles > MOST_TO_HOVER) return;
    const first = !this.hovered;
    this.hovered = event;
    if (first) requestAnimationFrame(() => this.tellCursor());
  }

  tellCursor() {
    const event = this.hovered;
    this.hovered = null;
    const isHandle = Boolean(this.handles.under(event));
    const isRing = !isHandle && Boolean(this.ring.under(event));
    this.stage.canvas.classList.toggle('resizable', isHandle);
    const movable = !isRing && !isHandle && this.locks.moves(this.selection.under(event)?.thing);
    this.stage.canvas.classList.toggle('turnable', isRing);
    this.stage.canvas.classList.toggle('movable', movable);
  }
}
