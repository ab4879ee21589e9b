// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A room that tests change by hand, and what a driver of its scanner sees ahead.
import {scene} from './daemon.js';
import {Scip} from './scip.js';

export const EYE = [0, -0.001, 9];
export const AT = [0, 0, 0];
export const FRONT = 540;

/** 6 m by 4 m; from its origin the wall ahead is 3 m away. */
export const room = (pose = '-1,0,0', accuracy = 'ideal') =>
  ['--scene', scene('square_room.sdf'), '--pose', pose, '--accuracy', accuracy];

export async function ahead(daemon) {
  const scip = await Scip.connect(daemon.port);
  const scan = await scip.scan();
  scip.close();
  return scan[FRONT] / 1000;
}
