// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What may be changed by hand: models of the world are locked until somebody unlocks them, so that no click and no key
// takes the world apart. Robots are free, and so is what was added here.

/** Tells changed. A thing is one of the selection's. */
export class Locks extends EventTarget {
  constructor(world) {
    super();
    this.open = new Set();
    world.addEventListener('loaded', () => {
      this.open.clear();
      this.tell();
    });
  }

  isLocked(thing) {
    return thing?.kind === 'models' && !this.open.has(thing.name);
  }

  /** Whether hands may move it. */
  moves(thing) {
    return Boolean(thing?.movable) && !this.isLocked(thing);
  }

  unlock(names) {
    for (const name of names) this.open.add(name);
    this.tell();
  }

  lock(names) {
    for (const name of names) this.open.delete(name);
    this.tell();
  }

  tell() {
    this.dispatchEvent(new Event('changed'));
  }
}
