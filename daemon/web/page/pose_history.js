// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where robots and movable models were in the last minute.
import {KEPT_S} from './recorder.js';

export class PoseHistory {
  constructor(robots) {
    this.robots = robots;
    this.kept = new Map();
    this.isBegun = false;
    robots.addEventListener('moved', (event) => this.take(event.detail, Date.now() / 1000));
    robots.addEventListener('gone', (event) => this.take(event.detail, Date.now() / 1000));
    robots.addEventListener('known', () => { this.isBegun = true; });
  }

  /** No pose: it is gone. What the page found at first was there before. */
  take({kind, name}, now_s) {
    if (this.robots.isFrozen) return;
    const key = `${kind}:${name}`;
    if (!this.kept.has(key)) this.kept.set(key, {kind, name, poses: []});
    const {poses} = this.kept.get(key);
    poses.push({since_s: this.isBegun ? now_s : -Infinity, pose: this.robots.poses[kind].get(name)});
    // The one before tells where it was at the beginning of the minute.
    while (poses.length > 1 && poses[1].since_s < now_s - KEPT_S) poses.shift();
  }

  /** {robots, models}: a pose by each name that was there at a time. */
  at(time_s) {
    const found = {robots: new Map(), models: new Map()};
    for (const {kind, name, poses} of this.kept.values()) {
      const last = poses.filter(({since_s}) => since_s <= time_s).pop();
      if (last?.pose) found[kind].set(name, last.pose);
    }
    return found;
  }
}
