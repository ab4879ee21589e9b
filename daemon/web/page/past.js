// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the page shows when it stands still: a time of the last minute. Meanwhile it asks for no scans.

/** Tells changed. Times are Unix times, as the page saw them. */
export class Past extends EventTarget {
  constructor({scans, robots, world, recorder, poseHistory, settings}) {
    super();
    Object.assign(this, {scans, robots, recorder, poseHistory, settings});
    this.time_s = null;
    this.placing = false;
    scans.addEventListener('shown', () => this.keepUp());
    robots.addEventListener('moved', () => {
      // Whoever moves a robot wants to see what it does now.
      if (this.isPaused && !this.placing) this.live();
    });
    // What was seen in another world is not to be seen in this one.
    world.addEventListener('loaded', () => {
      recorder.forgetAllBut([]);
      this.live();
    });
  }

  /** Nothing is kept of what is no longer shown. */
  keepUp() {
    if (this.isPaused && !this.span) this.live();
  }

  get isPaused() {
    return this.time_s !== null;
  }

  /** The time that one looks at. */
  get looksAt_s() {
    return this.time_s ?? Date.now() / 1000;
  }

  /** {from_s, to_s} of what is kept, or null. */
  get span() {
    const ends = this.recorder.sensors.map((sensor) => this.recorder.of(sensor)).filter(({length}) => length)
      .map((scans) => [scans[0].got_s, scans[scans.length - 1].got_s]);
    if (!ends.length) return null;
    return {from_s: Math.min(...ends.map(([from]) => from)), to_s: Math.max(...ends.map(([, to]) => to))};
  }

  toggle() {
    if (this.isPaused) this.live();
    else this.pause();
  }

  pause() {
    if (this.isPaused || !this.span) return;
    this.time_s = this.span.to_s;
    this.scans.hold(true);
    this.robots.freeze(true);
    this.seek(this.time_s);
  }

  live() {
    if (!this.isPaused) return;
    this.time_s = null;
    this.scans.hold(false);
    this.robots.freeze(false);
    this.dispatchEvent(new Event('changed'));
  }

  seek(time_s) {
    this.pause();
    if (!this.isPaused) return;
    const {from_s, to_s} = this.span;
    this.time_s = Math.min(Math.max(time_s, from_s), to_s);
    for (const sensor of this.recorder.sensors) {
      const scan = this.recorder.at(sensor, this.time_s);
      if (scan) this.scans.drawPast(scan);
    }
    this.placing = true;
    this.robots.showOnly(this.poseHistory.at(this.time_s));
    this.placing = false;
    this.dispatchEvent(new Event('changed'));
  }

  /** By so many scans of the chosen sensor, or of any. */
  step(by) {
    this.pause();
    const {recorder} = this;
    const chosen = this.settings.get('sensor');
    const sensor = recorder.of(chosen).length ? chosen : recorder.sensors[0];
    const scan = this.isPaused && recorder.beside(sensor, this.time_s, by);
    if (scan) this.seek(scan.got_s);
  }
}
