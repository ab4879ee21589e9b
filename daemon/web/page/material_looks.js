// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How points of each material look, so that one can tell them apart: the colours and shapes of `scipcat plot`, which
// begins with the material of the most points. What a material has it keeps until another world comes.
import {distinct, distinctCount} from './colours.js';

export const SHAPES = ['circle', 'square', 'triangle'];

export class MaterialLooks {
  constructor() {
    this.looks = new Map();
  }

  forget() {
    this.looks.clear();
  }

  /** pointsOf: how many points each material has. */
  meet(pointsOf) {
    const others = [...pointsOf.keys()].filter((name) => !this.looks.has(name));
    others.sort((a, b) => pointsOf.get(b) - pointsOf.get(a) || (a < b ? -1 : 1));
    for (const name of others) {
      const number = this.looks.size;
      this.looks.set(name, {
        colour: distinct(number),
        shape: Math.floor(number / distinctCount) % SHAPES.length,
      });
    }
  }

  /** In the order in which they came. */
  get names() {
    return [...this.looks.keys()];
  }

  /** {colour, shape}, a number of SHAPES. */
  of(name) {
    return this.looks.get(name);
  }
}
