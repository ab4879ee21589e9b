// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Configurations of many scanners in the rescue maze.
import {writeFileSync} from 'node:fs';
import path from 'node:path';
import {scene} from './daemon.js';

const PLACES = [[1, 1], [4.2, 9], [13.8, 3], [7, 5], [10, 12], [2, 13], [6, 2], [9, 9], [12, 7], [3, 5]];
const YAWS = {front: 0, left: 2.1, right: -2.1};

/** What they are called. */
export function namesOf(robots) {
  return Array.from({length: robots}, (_, i) => Object.keys(YAWS).map((name) => `robot${i}/${name}`)).flat();
}

/** Options of a scipd with three scanners on each of so many robots. */
export function fleet(folder, robots) {
  const wanted = PLACES.slice(0, robots).map(([x, y], i) => [`robot${i}`, {
    pose: {xyz: [x, y, 0]},
    sensors: Object.fromEntries(Object.entries(YAWS).map(([name, yaw]) => [name, {
      model: 'UST-10LX', mount: {xyz: [0.1, 0, 0.25], rpy: [0, 0, yaw]}, tcp: '127.0.0.1:0', accuracy: 'sensor'}])),
  }]);
  const file = path.join(folder, 'fleet.yaml');
  writeFileSync(file, `scene: ${scene('rescue_maze.sdf')}
http: {listen: "127.0.0.1:0"}
robots: ${JSON.stringify(Object.fromEntries(wanted))}
`);
  return ['--config', file];
}
