// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Poses {xyz, q}: metres in W and a quaternion x, y, z, w.
import {Euler, Matrix4, Quaternion, Vector3} from './three.module.js';

const ONE = new Vector3(1, 1, 1);
const UP = new Vector3(0, 0, 1);

export function matrixOf(pose) {
  return new Matrix4().compose(
    new Vector3(...pose.xyz), new Quaternion(...pose.q).normalize(), ONE);
}

export function poseOf(matrix) {
  const xyz = new Vector3();
  const q = new Quaternion();
  matrix.decompose(xyz, q, new Vector3());
  return {xyz: xyz.toArray(), q: q.toArray()};
}

/** The rotation about z of roll, pitch and yaw. */
export function yawOf(pose) {
  return new Euler().setFromQuaternion(new Quaternion(...pose.q), 'ZYX').z;
}

/** The same pose, turned about the vertical through its origin. */
export function turned(pose, angle_rad) {
  const turn = new Quaternion().setFromAxisAngle(UP, angle_rad);
  return {xyz: [...pose.xyz], q: turn.multiply(new Quaternion(...pose.q)).normalize().toArray()};
}

export function movedTo(pose, xyz) {
  return {xyz: [...xyz], q: [...pose.q]};
}
