// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Time under clock: poses, where it goes on by the stamps of poses and stands still without them: the page sends the
// pose that the first robot has, with a later stamp. What other programs send goes on beside it.
import {byId, tell} from './elements.js';

const BETWEEN_MS = 40;
// A tab that was asleep does not make up for it.
const LONGEST_S = 0.5;

export class Clock {
  constructor({status, robots, mover, notices}) {
    Object.assign(this, {status, robots, mover, notices});
    this.plays = false;
    byId('clock-play').addEventListener('click', () => this.toggle());
    byId('clock-step').addEventListener('click', () => this.step());
    status.addEventListener('changed', () => this.update());
    robots.addEventListener('known', () => this.update());
  }

  /** Once the pose is known that goes on. */
  get isSteered() {
    return this.status.latest?.clock === 'poses' && this.robots.poses.robots.size > 0;
  }

  toggle() {
    if (this.plays) this.pause();
    else if (this.isSteered) this.play();
  }

  pause() {
    this.plays = false;
    this.update();
  }

  async play() {
    this.plays = true;
    this.update();
    let before_ms = performance.now();
    while (this.plays && this.isSteered) {
      await new Promise((done) => setTimeout(done, BETWEEN_MS));
      const now_ms = performance.now();
      const past_s = Math.min((now_ms - before_ms) / 1000, LONGEST_S);
      before_ms = now_ms;
      if (this.plays) await this.goOn(past_s * Number(byId('clock-factor').value));
    }
    this.pause();
  }

  async step() {
    if (!this.isSteered) return;
    this.pause();
    await this.goOn(Number(byId('clock-step-ms').value) / 1000);
    await this.status.ask();
  }

  async goOn(by_s) {
    const [name] = this.robots.poses.robots.keys();
    const thing = {kind: 'robots', name};
    try {
      await this.mover.goOn(thing, this.robots.poseOf('robots', name), by_s);
    } catch (error) {
      this.pause();
      this.notices.trouble(`Time cannot go on by poses of ${name}: ${error.message}`);
    }
  }

  update() {
    byId('clock').hidden = !this.isSteered;
    byId('clock-play').setAttribute('aria-pressed', this.plays);
    tell(byId('clock-play'), this.plays ? 'Pause' : 'Play');
    tell(byId('clock-rate'), inWords(this.status.rates.time));
  }
}

/** Seconds of the daemon in a second; null of the first answer. */
function inWords(rate) {
  if (rate === null) return '';
  return rate > 0 ? `${rate.toFixed(2)} ×` : 'paused: time waits for poses';
}
