// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The hand that inspects: what the pointer rests on is read, and what is clicked stays read.

const SLACK_PX = 4;

export class InspectHand {
  constructor({stage, settings, pointed, inspection}) {
    Object.assign(this, {stage, settings, pointed, inspection});
    this.pressed = null;
    this.resting = null;
    const {canvas} = stage;
    canvas.addEventListener('pointerdown', (event) => this.press(event));
    canvas.addEventListener('pointermove', (event) => this.rest(event));
    canvas.addEventListener('pointerup', (event) => this.release(event));
    canvas.addEventListener('pointerleave', () => this.leave());
    settings.watch('inspect', () => inspection.pin(null));
  }

  press(event) {
    this.pressed = event.isPrimary && event.button === 0 ? event : null;
    this.leave();
  }

  leave() {
    this.resting = null;
    this.inspection.hover(null);
  }

  /** Once a picture at most. */
  rest(event) {
    if (!this.settings.get('inspect') || event.pointerType !== 'mouse' || event.buttons) return;
    const first = !this.resting;
    this.resting = event;
    if (first) requestAnimationFrame(() => this.read());
  }

  read() {
    const event = this.resting;
    this.resting = null;
    if (event) this.inspection.hover(this.pointed.at(event));
  }

  release(event) {
    const from = this.pressed;
    this.pressed = null;
    if (!from || !this.settings.get('inspect')) return;
    if (Math.hypot(event.clientX - from.clientX, event.clientY - from.clientY) > SLACK_PX) return;
    this.inspection.pin(this.pointed.at(event));
  }
}
