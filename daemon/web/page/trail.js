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

  /** The first `count` of the hits that were drawn. */
  add(now_s, hits, count) {
    if (!this.length_s || !count) return;
    // A daemon that began anew counts from nought: what the one before saw would stay for hours.
    if (now_s < this.scans[this.scans.length - 1]?.born_s) this.clear();
    const points = hits.positions.array.slice(0, 3 * count);
    this.scans.push({born_s: now_s, count, points, tints: hits.tints.array.slice(0, 4 * count)});
    this.points += count;
    if (now_s - this.faded_s >= BETWEEN_FADES_S) this.fade(now_s);
  }

  setLength(length_s) {
    this.length_s = length_s;
    if (!length_s) this.clear();
  }

  clear() {
    this.scans = [];
    this.points = 0;
    this.faded_s = 0;
    this.marks.show(0);
  }

  fade(now_s) {
    this.faded_s = now_s;
    while (this.scans.length && (this.points > MOST_POINTS ||
           now_s - this.scans[0].born_s > this.length_s)) {
      this.points -= this.scans.shift().count;
    }
    this.marks.reserve(Math.max(this.points, Math.min(2 * this.points, MOST_POINTS)));
    let at = 0;
    for (const scan of this.scans) at = this.put(scan, at, now_s);
    this.marks.show(at);
  }

  put({born_s, count, points, tints}, at, now_s) {
    const {positions, tints: shown} = this.marks;
    positions.array.set(points, 3 * at);
    shown.array.set(tints, 4 * at);
    const opacity = 153 * Math.max(1 - (now_s - born_s) / this.length_s, 0);
    for (let i = 4 * at + 3; i < 4 * (at + count); i += 4) shown.array[i] = opacity;
    return at + count;
  }
}
