// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The hits of the last seconds of one sensor; older ones are fainter.
import {PointMarks} from './marks.js';

// Those of 5 s of a UTM-30LX-EW at 40 Hz.
const MOST_POINTS = 240_000;
const BETWEEN_FADES_S = 0.1;

export class Trail {
  constructor() {
    this.marks = new PointMarks(2.5);
    this.scans = [];
    this.points = 0;
    this.length_s = 0;
    this.faded_s = 0;
  }

  /** points: x, y, z, and red, green, blue of each. */
  add(now_s, points, colours) {
    if (!this.length_s || !points.length) return;
    this.scans.push({born_s: now_s, points: Float32Array.from(points), colours: Float32Array.from(colours)});
    this.points += points.length / 3;
    if (now_s - this.faded_s >= BETWEEN_FADES_S) this.fade(now_s);
  }

  setLength(length_s) {
    this.length_s = length_s;
    if (!length_s) this.clear();
  }

  clear() {
    this.scans = [];
    this.points = 0;
    this.marks.show(0);
  }

  fade(now_s) {
    this.faded_s = now_s;
    while (this.scans.length && (this.points > MOST_POINTS ||
           now_s - this.scans[0].born_s > this.length_s)) {
      this.points -= this.scans.shift().points.length / 3;
    }
    this.marks.reserve(Math.max(this.points, Math.min(2 * this.points, MOST_POINTS)));
    let at = 0;
    for (const scan of this.scans) at = this.put(scan, at, now_s);
    this.marks.show(at);
  }

  put({born_s, points, colours}, at, now_s) {
    const opacity = 0.6 * Math.max(1 - (now_s - born_s) / this.length_s, 0);
    const tint = [0, 0, 0];
    for (let i = 0; i < points.length; i += 3, ++at) {
      this.marks.put(at, points[i], points[i + 1], points[i + 2]);
      tint[0] = colours[i];
      tint[1] = colours[i + 1];
      tint[2] = colours[i + 2];
      this.marks.tint(at, tint, opacity);
    }
    return at;
  }
}
