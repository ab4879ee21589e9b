// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The line on top: which world, whether the daemon is there, what time it is, and how many poses come in.
import {byId, tell} from './elements.js';

export class Header {
  constructor({status, connection}) {
    Object.assign(this, {status, connection});
    this.isBegun = false;
    connection.addEventListener('open', () => this.found());
    connection.addEventListener('lost', () => this.lost('The connection is lost.'));
    status.addEventListener('lost', (event) => this.lost(event.detail));
    status.addEventListener('changed', () => this.update());
  }

  /** From now on the page can be used. */
  begin() {
    this.isBegun = true;
    if (this.connection.isOpen) this.found();
  }

  found() {
    if (!this.isBegun) return;
    byId('state').className = 'chip good';
    tell(byId('state'), 'live');
    byId('lost').hidden = true;
  }

  lost(why) {
    if (this.connection.isOpen) return;
    byId('state').className = 'chip bad';
    tell(byId('state'), 'lost');
    byId('lost').hidden = false;
    byId('lost').title = why;
  }

  update() {
    const {scene, time_s, clock, poses} = this.status.latest;
    tell(byId('world-name'), scene.split('/').pop());
    byId('world-name').title = scene;
    tell(byId('time'), `time ${time_s.toFixed(0)} s${clock === 'poses' ? ' (lockstep)' : ''}`);
    const rate = this.status.rates.poses;
    tell(byId('poses'), rate === null ? '–' : `${rate.toFixed(0)} poses/s`);
    byId('poses').title = `${poses.accepted} poses accepted, ${poses.refused} refused` +
      (poses.last_refusal ? `; the last one: ${poses.last_refusal}` : '');
    byId('poses').classList.toggle('warning', poses.refused > 0);
  }
}
