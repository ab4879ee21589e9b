// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Acts when asked, but only so often: what is asked for too soon is done once, when it is time.

export class Pace {
  constructor(between_ms, act) {
    Object.assign(this, {between_ms, act});
    this.acted_ms = -Infinity;
    this.timer = null;
  }

  ask() {
    if (this.timer !== null) return;
    const wait_ms = this.acted_ms + this.between_ms - performance.now();
    if (wait_ms <= 0) this.now();
    else this.timer = setTimeout(() => this.now(), wait_ms);
  }

  now() {
    clearTimeout(this.timer);
    this.timer = null;
    this.acted_ms = performance.now();
    this.act();
  }
}
