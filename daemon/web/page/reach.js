// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How far the beams of a scan go: to what they met, or as far as the scanner sees. Nothing is drawn beyond the world.
import {sentRange} from './scan_shape.js';

const FARTHEST_M = 30;
// Of a beam that leaves the world at once, or begins outside of it, some is seen nevertheless.
const STUB_M = 0.5;

export class Reach {
  /** world: the box around it. */
  constructor(scan, shape, world) {
    Object.assign(this, {scan, shape, world});
    this.farthest_m = scan.max_range_m || FARTHEST_M;
    // A recording that is played has met nothing here; then what was sent is all that one knows.
    this.knowsTruth = scan.arrays.true_m?.some((range_m) => range_m > 0);
  }

  /** True of a beam that met something within the reach of its scanner. */
  isHit(i) {
    const hit_m = this.hit_m(i);
    return hit_m > 0 && hit_m < this.farthest_m;
  }

  hit_m(i) {
    return this.knowsTruth ? this.scan.arrays.true_m[i] : sentRange(this.scan, i);
  }

  /** To what beam i met, or else to where it would end. */
  of(i) {
    return this.isHit(i) ? this.hit_m(i) : this.end(i);
  }

  /** Where beam i ends if nothing holds it up: at the range of the scanner, or where the world does. */
  end(i) {
    const {shape: {origins, directions}, world, farthest_m} = this;
    if (!world || world.isEmpty()) return farthest_m;
    let leaves_m = farthest_m;
    for (const [k, axis] of ['x', 'y', 'z'].entries()) {
      const along = directions[3 * i + k];
      if (along === 0) continue;
      const side = along > 0 ? world.max[axis] : world.min[axis];
      leaves_m = Math.min(leaves_m, (side - origins[3 * i + k]) / along);
    }
    return Math.min(Math.max(leaves_m, STUB_M), farthest_m);
  }
}
