// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How points of each material look, so that one can tell them apart: by its number in the world's list, as
// `scipcat plot` has it.
import {distinct, distinctCount} from './colours.js';

export const SHAPES = ['circle', 'square', 'triangle'];

export class MaterialLooks {
  constructor(world) {
    this.world = world;
    this.numbers = new Map();
    world.addEventListener('changed', () => this.numbers.clear());
  }

  /** Scans of another moment may have some that the world's list has not: they follow. */
  numberOf(name) {
    if (!this.numbers.size) this.world.materials.forEach((each) => this.add(each.name));
    this.add(name);
    return this.numbers.get(name);
  }

  add(name) {
    if (!this.numbers.has(name)) this.numbers.set(name, this.numbers.size);
  }

  /** {colour, shape}, a number of SHAPES. */
  of(name) {
    const number = this.numberOf(name);
    return {colour: distinct(number), shape: Math.floor(number / distinctCount) % SHAPES.length};
  }

  inOrder(names) {
    return [...names].sort((a, b) => this.numberOf(a) - this.numberOf(b));
  }
}
