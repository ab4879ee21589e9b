// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What GET /status says, once a second, and the rates that follow from two answers.

const BETWEEN_MS = 1000;
const NO_RATES = {poses: null, time: null, scans: new Map(), sent: new Map()};

/** Tells changed (with .latest and .rates), and lost (detail: why). */
export class Status extends EventTarget {
  constructor(server) {
    super();
    this.server = server;
    this.latest = null;
    this.rates = NO_RATES;
  }

  begin() {
    this.ask();
  }

  async ask() {
    try {
      const asked_ms = performance.now();
      this.take(await this.server.get('/status'), asked_ms);
    } catch (error) {
      this.dispatchEvent(new CustomEvent('lost', {detail: error.message}));
    }
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.ask(), BETWEEN_MS);
  }

  take(status, asked_ms) {
    // Of a daemon that began anew there is nothing to compare with.
    const before = this.latest && this.latest.uptime_s <= status.uptime_s ? this.latest : null;
    const past_s = (asked_ms - this.asked_ms) / 1000;
    this.rates = before ? ratesBetween(before, status, past_s) : NO_RATES;
    this.latest = status;
    this.asked_ms = asked_ms;
    this.dispatchEvent(new Event('changed'));
  }

  get sensors() {
    return this.latest?.sensors || [];
  }

  sensor(name) {
    return this.sensors.find((sensor) => sensor.name === name) || null;
  }
}

/** scans: that were cast, for drivers and for pages; sent: that drivers took. */
function ratesBetween(before, now, past_s) {
  const rates = (count) => {
    const old = new Map(before.sensors.map((sensor) => [sensor.name, count(sensor)]));
    return new Map(now.sensors.map((sensor) => [sensor.name, (count(sensor) - old.get(sensor.name)) / past_s])
      .filter(([, rate]) => rate >= 0));
  };
  return {
    poses: (now.poses.accepted - before.poses.accepted) / past_s,
    // Seconds of the daemon in a second.
    time: (now.time_s - before.time_s) / past_s,
    scans: rates(({casts}) => Object.values(casts).reduce((sum, each) => sum + each, 0)),
    sent: rates(({scans}) => scans),
  };
}
