// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Moves robots and models by the control API: at once on the page, and at the daemon as fast as it answers. Of poses
// that come faster only the newest is sent.
import {at} from './server.js';

const SOON_S = 1e-6;

export class Mover {
  constructor(server, robots, status, notices) {
    this.server = server;
    this.robots = robots;
    this.status = status;
    this.notices = notices;
    this.ledTo_s = 0;
    this.waiting = new Map();
    this.busy = new Set();
  }

  path(thing) {
    return thing.kind === 'robots'
      ? at('/robots/', thing.name, '/pose')
      : `/scene/models/${encodeURIComponent(thing.name)}/pose`;
  }

  move(thing, pose) {
    this.robots.place(thing.kind, thing.name, pose);
    const key = `${thing.kind}:${thing.name}`;
    this.waiting.set(key, {thing, pose});
    if (!this.busy.has(key)) this.sendAll(key);
  }

  async sendAll(key) {
    this.busy.add(key);
    while (this.waiting.has(key)) {
      const {thing, pose} = this.waiting.get(key);
      this.waiting.delete(key);
      await this.send(thing, pose);
    }
    this.busy.delete(key);
  }

  /** Under clock: poses, as far as it has gone on. */
  get time_s() {
    const {time_s, uptime_s} = this.status.latest;
    // A daemon that began anew has a time of its own.
    if (this.uptime_s > uptime_s) this.ledTo_s = 0;
    this.uptime_s = uptime_s;
    return Math.max(time_s, this.ledTo_s);
  }

  /**
   * The same pose, later: time goes on. Where several can move, a stamp takes effect when the next one comes, so there
   * is one more, which others may still have as well.
   */
  async goOn(thing, pose, by_s) {
    const t = this.time_s + by_s;
    const say = (stamp) => this.server.put(this.path(thing), {xyz: pose.xyz, q: pose.q, t: stamp});
    await say(t);
    if (this.robots.movers > 1) await say(t + SOON_S);
    this.ledTo_s = t;
  }

  async send(thing, pose) {
    const body = {xyz: pose.xyz, q: pose.q};
    // There a pose is what makes time go on.
    if (this.status.latest?.clock === 'poses') body.t = this.time_s;
    try {
      await this.server.put(this.path(thing), body);
    } catch (error) {
      this.waiting.delete(`${thing.kind}:${thing.name}`);
      this.notices.trouble(`${thing.name} cannot be moved: ${error.message}`);
      await this.bringBack(thing);
    }
  }

  async bringBack(thing) {
    const pose = await this.server.get(this.path(thing)).catch(() => null);
    if (pose) this.robots.place(thing.kind, thing.name, {xyz: pose.xyz, q: pose.q});
  }
}
