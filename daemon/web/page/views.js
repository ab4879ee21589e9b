// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The views that one comes back to: all of the world, straight down, along with a robot.
import {Vector3} from './three.module.js';
import {boxAround} from './viewpoint.js';
import {byId} from './elements.js';

const EMPTY_WORLD_M = 5;

export class Views {
  constructor({viewpoint, world, ground, selection, robots, stage}) {
    Object.assign(this, {viewpoint, world, ground, selection, robots});
    this.all = () => viewpoint.show(this.box());
    this.top = () => this.toggleTop();
    this.follow = () => this.toggleFollow();
    byId('view-all').addEventListener('click', this.all);
    byId('view-top').addEventListener('click', this.top);
    byId('view-follow').addEventListener('click', this.follow);
    world.addEventListener('changed', () => ground.cover(this.box()));
    viewpoint.addEventListener('change', () =>
      byId('view-top').setAttribute('aria-pressed', viewpoint.isPlan));
    viewpoint.addEventListener('follow', () =>
      byId('view-follow').setAttribute('aria-pressed', Boolean(viewpoint.followed)));
    stage.beforeEach(() => viewpoint.keepUp());
  }

  box() {
    const box = this.world.box();
    return box.isEmpty() ? boxAround(new Vector3(), EMPTY_WORLD_M) : box;
  }

  toggleTop() {
    if (this.viewpoint.isPlan) this.viewpoint.leavePlan();
    else this.viewpoint.fromAbove(this.box());
  }

  restore(wanted) {
    if (wanted) this.viewpoint.restore(wanted);
    else this.all();
  }

  /** As soon as there is something to follow. */
  followLater() {
    const begin = () => {
      if (this.viewpoint.followed) return;
      this.toggleFollow();
      if (this.viewpoint.followed) this.robots.removeEventListener('known', begin);
    };
    this.robots.addEventListener('known', begin);
    begin();
  }

  toggleFollow() {
    if (this.viewpoint.followed) {
      this.viewpoint.follow(null);
      return;
    }
    const selected = this.selection.thing;
    const thing = selected?.movable
      ? selected : this.selection.things().find(({kind}) => kind === 'robots');
    if (!thing) return;
    this.viewpoint.follow(thing.name, () => this.robots.positionOf(thing.kind, thing.name));
  }
}
