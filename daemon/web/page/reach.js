// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How far the beams of a scan go: to what they met, or as far as the scanner sees. Nothing is drawn beyond the world.

const FARTHEST_M = 30;
// Of a beam that leaves the world at once, or begins outside of it, some is seen nevertheless.
const STUB_M = 0.5;

/** True of a beam that met something within the reach of its scanner. */
export function isHit(scan, i) {
  const hit_m = hitOf(scan, i);
  return hit_m > 0 && hit_m < farthestOf(scan);
}

/** To what beam i met, or else to where it would end. */
export function reachOf(scan, shape, i, world) {
  return isHit(scan, i) ? hitOf(scan, i) : endOf(scan, shape, i, world);
}

/** Where beam i ends if nothing holds it up: at the range of the scanner, or where the world does. */
export function endOf(scan, {origins, directions}, i, world) {
  const farthest_m = farthestOf(scan);
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

function farthestOf(scan) {
  return scan.max_range_m || FARTHEST_M;
}

function hitOf(scan, i) {
  return scan.arrays.true_m?.[i] ?? NaN;
}
