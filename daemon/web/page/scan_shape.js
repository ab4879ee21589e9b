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
    scan.fov_deg].join();
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
function pictureDirections({columns, rows, fov_deg: [width, height]}) {
  const right = Math.tan(width * Math.PI / 360);
  const up = Math.tan(height * Math.PI / 360);
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
  const poseOfBeam = scan.arrays.pose_of_beam;
  for (let i = 0; i < beams; ++i) {
    const which = poseOfBeam ? poseOfBeam[i] : Math.floor(i * frames.length / beams);
    rotateInto(directions, origins, i, local, frames[which]);
  }
  return {origins, directions};
}

function framesOf(scan) {
  const given = scan.arrays.origin_pose;
  if (!given?.length) return [frameOf(scan.pose.xyz, scan.pose.q)];
  const frames = [];
  for (let i = 0; i < given.length; i += 7) {
    frames.push(frameOf(given.subarray(i, i + 3), given.subarray(i + 3, i + 7)));
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

/** The range that the scanner told for a beam, in m; NaN for a code or none. */
export function sentRange(scan, i) {
  const sent = scan.arrays.sent_mm;
  if (!sent) return scan.arrays.true_m[i];
  const mm = sent[i];
  const none = sent.BYTES_PER_ELEMENT === 2 ? 0xffff : 0xffffffff;
  if (mm === none || mm < (scan.dmin_mm ?? 20) || mm > (scan.dmax_mm ?? none - 1)) return NaN;
  return mm / 1000;
}

/** Of the material of a beam: a name or null. */
export function materialOf(scan, i) {
  const index = scan.arrays.material?.[i] ?? -1;
  return index < 0 ? null : scan.materials[index];
}

export function objectOf(scan, i) {
  const index = scan.arrays.object?.[i] ?? -1;
  return index < 0 ? null : scan.objects?.[index] ?? index;
}
