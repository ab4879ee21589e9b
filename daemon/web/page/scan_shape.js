// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where the beams of a scan begin and where they look, in W.
import {Quaternion, Vector3} from './three.module.js';

const derived = new Map();

/** Unit vectors in S, three numbers a beam. */
function directionsOf(scan) {
  if (scan.arrays.direction) return scan.arrays.direction;
  const key = [scan.sensor, scan.beams, scan.first_angle_rad, scan.step_rad, scan.columns, scan.rows,
    scan.fov_rad].join();
  if (!derived.has(key)) {
    if (derived.size > 64) derived.clear();
    derived.set(key, scan.kind === 'picture' ? pictureDirections(scan) : sweepDirections(scan));
  }
  return derived.get(key);
}

function sweepDirections({beams, first_angle_rad: first, step_rad: step}) {
  const directions = new Float32Array(3 * beams);
  for (let i = 0; i < beams; ++i) {
    directions[3 * i] = Math.cos(first + i * step);
    directions[3 * i + 1] = Math.sin(first + i * step);
  }
  return directions;
}

/** Of the middle of each pixel, row 0 on top and column 0 on the left. */
function pictureDirections({columns, rows, fov_rad: [width, height]}) {
  const right = Math.tan(width / 2);
  const up = Math.tan(height / 2);
  const directions = new Float32Array(3 * columns * rows);
  for (let i = 0; i < columns * rows; ++i) {
    const y = right * (1 - (2 * (i % columns) + 1) / columns);
    const z = up * (1 - (2 * Math.floor(i / columns) + 1) / rows);
    const length = Math.hypot(1, y, z);
    directions.set([1 / length, y / length, z / length], 3 * i);
  }
  return directions;
}

/** {origins, directions}: three numbers a beam, in W. A scanner that moves has several poses in a sweep. */
export function shapeOf(scan) {
  const local = directionsOf(scan);
  const beams = scan.beams;
  const origins = new Float32Array(3 * beams);
  const directions = new Float32Array(3 * beams);
  const frames = framesOf(scan);
  for (let i = 0; i < beams; ++i) {
    rotateInto(directions, origins, i, local, frames[Math.floor(i * frames.length / beams)]);
  }
  return {origins, directions};
}

/** Each for as many beams; their places are told from that of the header. */
function framesOf({pose, arrays}) {
  const given = arrays.origin_pose;
  if (!given) return [frameOf(pose.xyz, pose.q)];
  const frames = [];
  for (let i = 0; i < given.length; i += 7) {
    const xyz = pose.xyz.map((value, k) => value + given[i + k]);
    frames.push(frameOf(xyz, given.subarray(i + 3, i + 7)));
  }
  return frames;
}

function frameOf(xyz, q) {
  const turn = new Quaternion(...q).normalize();
  const axis = (x, y, z) => new Vector3(x, y, z).applyQuaternion(turn).toArray();
  return {xyz, x: axis(1, 0, 0), y: axis(0, 1, 0), z: axis(0, 0, 1)};
}

function rotateInto(directions, origins, i, local, {xyz, x, y, z}) {
  const at = 3 * i;
  for (let k = 0; k < 3; ++k) {
    directions[at + k] = local[at] * x[k] + local[at + 1] * y[k] + local[at + 2] * z[k];
    origins[at + k] = xyz[k];
  }
}

/** The range that the sensor told for a beam, in m; NaN for a code or none. A ranger tells one for all its beams. */
export function sentRange(scan, i) {
  const {sent_mm: sent, range_m: ranges} = scan.arrays;
  if (!sent) return ranges[Math.min(i, ranges.length - 1)];
  const mm = sent[i];
  return mm < scan.nearest_mm || mm > scan.dmax_mm ? NaN : mm / 1000;
}

/** How far away that is which returned the light of a beam, in m: it may stand behind glass. */
export function returnedRange(scan, i) {
  const {returned_m: returned, true_m: met} = scan.arrays;
  return (returned || met)?.[i] ?? NaN;
}

/** The material of that: a name or null. */
export function returnedMaterial(scan, i) {
  const {returned_material: returned, material: met} = scan.arrays;
  const index = (returned || met)?.[i] ?? -1;
  return index < 0 ? null : scan.materials[index];
}

/** The number of the object that a beam met, or null. */
export function objectOf(scan, i) {
  const id = scan.arrays.object?.[i] ?? -1;
  return id < 0 ? null : id;
}

/** The number of a beam's first echo; all of them stand one after the other. */
export function firstEcho(scan, i) {
  return i ? scan.arrays.echo_end[i - 1] : 0;
}
