// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The scans of the last seconds that this page got, of each sensor that is shown.

const MOST_BYTES = 200e6;

export class Recorder {
  constructor(scans, settings) {
    this.settings = settings;
    this.kept = new Map();
    this.bytes = 0;
    scans.addEventListener('scan', (event) => this.take(event.detail, Date.now() / 1000));
    scans.addEventListener('shown', () => this.forgetAllBut(scans.shown));
  }

  take(scan, host_time_s) {
    if (scan.kind !== 'scan') return;
    if (!this.kept.has(scan.sensor)) this.kept.set(scan.sensor, []);
    const scans = this.kept.get(scan.sensor);
    scans.push({scan, host_time_s});
    this.bytes += sizeOf(scan);
    const oldest_s = host_time_s - this.settings.get('keep_s');
    while (scans.length && scans[0].host_time_s < oldest_s) this.dropFirst(scans);
    while (this.bytes > MOST_BYTES) this.dropFirst(this.longest());
  }

  dropFirst(scans) {
    this.bytes -= sizeOf(scans.shift().scan);
  }

  longest() {
    return [...this.kept.values()].reduce((most, each) => each.length > most.length ? each : most);
  }

  forgetAllBut(sensors) {
    for (const [sensor, scans] of this.kept) {
      if (sensors.includes(sensor)) continue;
      while (scans.length) this.dropFirst(scans);
      this.kept.delete(sensor);
    }
  }

  of(sensor) {
    return this.kept.get(sensor) || [];
  }

  /** {scans, missed}: how many of the scanner's scans this page did not get in the meantime. */
  countsOf(sensor) {
    const scans = this.of(sensor);
    if (!scans.length) return {scans: 0, missed: 0};
    const span = scans[scans.length - 1].scan.scan - scans[0].scan.scan + 1;
    return {scans: scans.length, missed: Math.max(span - scans.length, 0)};
  }
}

function sizeOf(scan) {
  return Object.values(scan.arrays).reduce((sum, array) => sum + array.byteLength, 0);
}
