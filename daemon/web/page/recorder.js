// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The scans of the last minute that this page got, of each sensor that is shown.

export const KEPT_S = 60;
const MOST_BYTES = 200e6;

export class Recorder {
  constructor(scans) {
    this.kept = new Map();
    this.bytes = 0;
    scans.addEventListener('scan', (event) => this.take(event.detail));
    scans.addEventListener('shown', () => this.forgetAllBut(scans.shown));
  }

  take(scan) {
    if (!this.kept.has(scan.sensor)) this.kept.set(scan.sensor, []);
    const scans = this.kept.get(scan.sensor);
    scans.push(scan);
    this.bytes += sizeOf(scan);
    while (scans.length && scans[0].got_s < scan.got_s - KEPT_S) this.dropFirst(scans);
    while (this.bytes > MOST_BYTES) this.dropFirst(this.oldest());
  }

  dropFirst(scans) {
    this.bytes -= sizeOf(scans.shift());
  }

  oldest() {
    const some = [...this.kept.values()].filter((scans) => scans.length);
    return some.reduce((first, each) => each[0].got_s < first[0].got_s ? each : first);
  }

  forgetAllBut(sensors) {
    for (const [sensor, scans] of this.kept) {
      if (sensors.includes(sensor)) continue;
      while (scans.length) this.dropFirst(scans);
      this.kept.delete(sensor);
    }
  }

  get sensors() {
    return [...this.kept.keys()];
  }

  /** All that are kept, the oldest first. */
  of(sensor) {
    return this.kept.get(sensor) || [];
  }

  /** The last one that was there at a time, or the first of all. */
  at(sensor, time_s) {
    const scans = this.of(sensor);
    return scans[Math.max(after(scans, time_s) - 1, 0)] || null;
  }

  /** The one so many after the one that was there at a time. */
  beside(sensor, time_s, by) {
    const scans = this.of(sensor);
    return scans[Math.min(Math.max(after(scans, time_s) - 1 + by, 0), scans.length - 1)] || null;
  }
}

/** How many came no later than a time. */
function after(scans, time_s) {
  let [low, high] = [0, scans.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (scans[middle].got_s <= time_s) low = middle + 1;
    else high = middle;
  }
  return low;
}

function sizeOf(scan) {
  return Object.values(scan.arrays).reduce((sum, array) => sum + array.byteLength, 0);
}
