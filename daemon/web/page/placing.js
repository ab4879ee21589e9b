// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where new things stand: under the pointer, on the floor or on what lies there, and else in the middle of the view. A
// button leaves the thing at the pointer until one clicks where it goes.
import {byId} from './elements.js';

// What is steeper is a wall: things stand at its foot.
const LEAST_UP = 0.9;

export class Placing {
  constructor({stage, selection, viewpoint}) {
    Object.assign(this, {stage, selection, viewpoint});
    this.pointer = null;
    this.waiting = null;
    const {canvas} = stage;
    canvas.addEventListener('pointermove', (event) => { this.pointer = event; });
    canvas.addEventListener('pointerleave', () => { this.pointer = null; });
    // Before the hands and the view take it.
    canvas.parentElement.addEventListener('pointerdown', (event) => this.press(event), {capture: true});
    window.addEventListener('keydown', (event) => event.key === 'Escape' && this.end(), {capture: true});
  }

  /** [x, y, z] for a key that was pressed. */
  place() {
    return this.pointer ? this.placeUnder(this.pointer) : this.middle();
  }

  middle() {
    const {x, y} = this.viewpoint.target;
    return [round(x), round(y), 0];
  }

  placeUnder(event) {
    const hit = this.selection.under(event);
    if (hit) return [round(hit.point.x), round(hit.point.y), hit.up > LEAST_UP ? round(hit.point.z) : 0];
    const ground = this.selection.onHeight(event, 0);
    return ground ? [round(ground.x), round(ground.y), 0] : this.middle();
  }

  /** act(place) once somebody has clicked on the view; at once for those who work without a pointer. */
  wait(event, act) {
    if (event.detail === 0) {
      act(this.middle());
      return;
    }
    this.waiting = act;
    this.stage.canvas.classList.add('placing');
    byId('placing').hidden = false;
  }

  press(event) {
    if (!this.waiting || event.target !== this.stage.canvas || event.button !== 0) return;
    event.preventDefault();
    event.stopPropagation();
    const act = this.waiting;
    this.end();
    act(this.placeUnder(event));
  }

  end() {
    this.waiting = null;
    this.stage.canvas.classList.remove('placing');
    byId('placing').hidden = true;
  }
}

function round(value) {
  return Math.round(value * 100) / 100;
}
