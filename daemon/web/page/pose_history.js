// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where robots and movable models were in the last minute.
import {KEPT_S} from './recorder.js';

export class PoseHistory {
  constructor(robots) {
    this.robots = robots;
    this.kept = new Map();
    robots.addEventListener('moved', (event) => this.take(event.detail, Date.now() / 1000));
  }

  take({kind, name}, now_s) {
    if (this.robots.isFrozen) return;
    const key = `${kind}:${name}`;
    if (!this.kept.has(key)) this.kept.set(key, []);
    const poses = this.kept.get(key);
    poses.push({kind, name, now_s, pose: this.robots.poses[kind].get(name)});
    // The one before tells where it was at the beginning of the minute.
    while (poses.length > 1 && poses[1].now_s < now_s - KEPT_S) poses.shift();
  }

  /** [{kind, name, pose}, ...] of all that is known of a time. */
  at(time_s) {
    return [...this.kept.values()].map((poses) =>
      poses.reduce((found, each) => each.now_s <= time_s ? each : found, poses[0]));
  }
}
