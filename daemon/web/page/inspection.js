// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What one looks at closely: a beam of a sensor, or a place on an object. What the pointer is on comes and goes, and
// what was clicked stays.

/** Tells changed. A target is {kind: 'beam', sensor, i} or {kind: 'face', object, place}. */
export class Inspection extends EventTarget {
  constructor() {
    super();
    this.hovered = null;
    this.pinned = null;
  }

  get target() {
    return this.hovered || this.pinned;
  }

  hover(target) {
    if (!target && !this.hovered) return;
    this.hovered = target;
    this.dispatchEvent(new Event('changed'));
  }

  pin(target) {
    this.hovered = null;
    this.pinned = target;
    this.dispatchEvent(new Event('changed'));
  }

  /** The beam of this sensor that one looks at, or null. */
  beamOf(sensor) {
    for (const target of [this.hovered, this.pinned]) {
      if (target?.kind === 'beam' && target.sensor === sensor) return target.i;
    }
    return null;
  }
}
