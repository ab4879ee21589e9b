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
    this.sentTo_s = 0;
    this.waiting = new Map();
    this.busy = new Map();
  }

  path(thing) {
    return thing.kind === 'robots'
      ? at('/robots/', thing.name, '/pose')
      : `/scene/models/${encodeURIComponent(thing.name)}/pose`;
  }

  move(thing, pose) {
    this.robots.place(thing.kind, thing.name, pose);
    const key = keyOf(thing);
    this.waiting.set(key, {thing, pose});
    if (!this.busy.has(key)) this.busy.set(key, this.sendAll(key));
  }

  /** Of what is undone, which may be gone by now: it moves once the daemon has taken it. */
  async moveBack(thing, pose) {
    await this.busy.get(keyOf(thing));
    await this.put(thing, pose);
    this.robots.place(thing.kind, thing.name, pose);
  }

  async sendAll(key) {
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
    if (this.uptime_s > uptime_s) this.ledTo_s = this.sentTo_s = 0;
    this.uptime_s = uptime_s;
    return Math.max(time_s, this.ledTo_s);
  }

  /**
   * The same pose, later: time goes on. Where several can move, a stamp takes effect when the next one comes, so there
   * is one more, which others may still have as well.
   */
  async goOn(thing, pose, by_s) {
    const t = this.stampAt(this.time_s + by_s);
    const say = (stamp) => this.server.put(this.path(thing), {xyz: pose.xyz, q: pose.q, t: stamp});
    await say(t);
    if (this.robots.movers > 1) await say(this.stampAt(t));
    this.ledTo_s = t;
  }

  /** This one, or as soon after all that were sent as can be: a pose must be later than the one before it. */
  stampAt(t) {
    this.sentTo_s = Math.max(t, this.sentTo_s + SOON_S);
    return this.sentTo_s;
  }

  async put(thing, pose) {
    const body = {xyz: pose.xyz, q: pose.q};
    // There a pose is what makes time go on.
    if (this.status.latest?.clock === 'poses') body.t = this.stampAt(this.time_s + SOON_S);
    await this.server.put(this.path(thing), body);
  }

  async send(thing, pose) {
    try {
      await this.put(thing, pose);
    } catch (error) {
      this.waiting.delete(keyOf(thing));
      this.notices.trouble(`${thing.name} cannot be moved: ${error.message}`);
      await this.bringBack(thing);
    }
  }

  /** To where the daemon has it, if it still does. */
  async bringBack(thing) {
    try {
      const {xyz, q} = await this.server.get(this.path(thing));
      this.robots.place(thing.kind, thing.name, {xyz, q});
    } catch (error) {
      if (error.status === 404) this.robots.leave(thing.kind, thing.name);
    }
  }
}

function keyOf({kind, name}) {
  return `${kind}:${name}`;
}
