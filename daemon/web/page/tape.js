// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A measuring tape between two places. One drags it, or clicks at one place and then at the other. Its ends take to
// points of scans, then to faces, then to the ground.
import {CURSOR_COLOUR} from './inspect_card.js';
import {LineMarks, PointMarks} from './marks.js';
import {byId, tell} from './elements.js';
import {freePlace} from './free_place.js';

const SLACK_PX = 4;
const ABOVE_PX = 10;
// The label leaves these places of the tape free.
const SHARES = [0, 0.25, 0.5, 0.75, 1];
const CLEAR_PX = 8;

export class Tape {
  constructor({stage, viewpoint, pointed, inspection}) {
    Object.assign(this, {stage, viewpoint, pointed, inspection});
    this.isOn = false;
    this.label = byId('tape');
    this.line = new LineMarks();
    this.ends = new PointMarks(8, {rim_px: 3, order: 6});
    this.line.reserve(2);
    this.ends.reserve(2);
    stage.scene.add(this.line.group, this.ends.group);
    this.clear();
    byId('view-measure').addEventListener('click', () => this.toggle());
    // Before the other hands, which then hear nothing of it: to look around, there are the right button and the keys.
    const hands = {pointerdown: 'press', pointermove: 'move', pointerup: 'release'};
    for (const [event, act] of Object.entries(hands)) {
      byId('view').addEventListener(event, (one) => this.take(one, act), {capture: true});
    }
    stage.beforeEach(() => this.draw());
    stage.afterEach(() => this.placeLabel());
  }

  toggle() {
    this.set(!this.isOn);
  }

  set(on) {
    this.isOn = on;
    this.clear();
    this.inspection.hover(null);
    byId('view-measure').setAttribute('aria-pressed', on);
    this.stage.canvas.classList.toggle('measuring', on);
    this.stage.invalidate();
  }

  clear() {
    this.from = this.to = this.pressed = this.began = null;
    this.isDone = false;
  }

  take(event, act) {
    if (!this.isOn || event.target !== this.stage.canvas || !event.isPrimary) return;
    if (act === 'press' && event.button !== 0) return;
    if (act !== 'press' && event.buttons & ~1) return;
    event.stopPropagation();
    this[act](event);
    this.stage.invalidate();
  }

  press(event) {
    this.pressed = event;
    this.viewpoint.controls.enabled = false;
    this.stage.canvas.setPointerCapture(event.pointerId);
    if (this.from && !this.isDone) return;
    this.from = this.pointed.placeAt(event);
    this.to = null;
    this.isDone = false;
    this.began = event;
  }

  move(event) {
    if (this.from && !this.isDone) this.to = this.pointed.placeAt(event);
  }

  release(event) {
    const {pressed, began} = this;
    this.pressed = null;
    this.viewpoint.controls.enabled = true;
    if (!pressed || !this.from) return;
    // Where it began and nothing was dragged, its other end is still to come.
    const dragged_px = Math.hypot(event.clientX - pressed.clientX, event.clientY - pressed.clientY);
    if (pressed === began && dragged_px <= SLACK_PX) return;
    this.to = this.pointed.placeAt(event);
    this.isDone = Boolean(this.to);
  }

  draw() {
    const ends = this.from ? [this.from, this.to].filter(Boolean) : [];
    ends.forEach((end, k) => {
      for (const marks of [this.line, this.ends]) {
        marks.put(k, end.x, end.y, end.z);
        marks.tint(k, CURSOR_COLOUR, 1);
      }
    });
    this.ends.show(ends.length);
    this.line.show(ends.length === 2 ? 2 : 0);
  }

  placeLabel() {
    const both = this.from && this.to;
    const at = both && this.pointed.project(this.from.clone().lerp(this.to, 0.5));
    this.label.hidden = !at;
    if (!at) return;
    tell(this.label, wordsOf(this.from, this.to));
    const {offsetWidth: width, offsetHeight: height} = this.label;
    const {clientWidth: right, clientHeight: bottom} = this.stage.canvas;
    const wanted = {left: at.x - width / 2, top: at.y - height - ABOVE_PX};
    const {left, top} = freePlace(wanted, {width, height}, {left: 0, top: 0, right, bottom}, this.boxes());
    this.label.style.left = `${left}px`;
    this.label.style.top = `${top}px`;
  }

  /** Along the tape, on the view. */
  boxes() {
    return SHARES.map((share) => this.pointed.project(this.from.clone().lerp(this.to, share))).filter(Boolean)
      .map(({x, y}) => ({left: x - CLEAR_PX, right: x + CLEAR_PX, top: y - CLEAR_PX, bottom: y + CLEAR_PX}));
  }
}

function wordsOf(from, to) {
  const [dx, dy, dz] = to.clone().sub(from).toArray();
  const number = (value) => value.toFixed(3).replace('-', '−');
  const bearing = (Math.atan2(dy, dx) * 180 / Math.PI).toFixed(1).replace('-', '−');
  return `${from.distanceTo(to).toFixed(3)} m\n` +
    `x ${number(dx)}, y ${number(dy)}, z ${number(dz)} m\n${bearing}° from x`;
}
