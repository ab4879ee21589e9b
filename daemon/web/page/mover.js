// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Moves robots and models by the control API: at once on the page, and at the daemon as fast as it answers. Of poses
// that come faster only the newest is sent.
import {at} from './server.js';

export class Mover {
  constructor(server, robots, status, notices) {
    this.server = server;
    this.robots = robots;
    this.status = status;
    this.notices = notices;
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

  async send(thing, pose) {
    const body = {xyz: pose.xyz, q: pose.q};
    // There a pose is what makes time go on.
    if (this.status.latest?.clock === 'poses') body.t = this.status.latest.time_s;
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
