// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where one looks at first, if no link says so: at all of the world, and as soon as there is a scan, at what it shows.
// A robot that drives by itself is followed. Over as soon as the user looks elsewhere, even before the world is there.
// It begins again in another world.
import {Box3, Vector3} from './three.module.js';
import {sentRange, shapeOf} from './scan_shape.js';

// From so high that a wall hides little of what stands behind it.
const FROM = new Vector3(-3, -5, 10);
// Around a scan, so that the walls that it met are seen as well.
const MARGIN_M = 0.6;
const WALL_M = 1;

export class FirstLook {
  constructor({scans, views, viewpoint, status, stage, world}) {
    Object.assign(this, {scans, views, viewpoint, status});
    this.isOver = false;
    this.hasMoved = false;
    this.from = FROM;
    status.addEventListener('changed', () => { this.scene ??= status.latest.scene; });
    world.addEventListener('loaded', () => this.beginAgain());
    this.take = ({detail: scan}) => {
      if (scan.sensor === scans.chosen) this.frame(scan);
    };
    for (const kind of ['pointerdown', 'wheel', 'keydown', 'click']) {
      window.addEventListener(kind, ({target, key}) => {
        if (target.closest?.('dialog')) return;  // a token is no look
        this.hasMoved ||= kind !== 'click' && target === stage.canvas && key !== 'f';
        this.leave();
      }, {capture: true});
    }
  }

  /** The world is there. */
  begin() {
    const {scans, viewpoint} = this;
    if (!this.hasMoved && !viewpoint.isPlan) this.views.all();
    if (this.isOver) return;
    scans.addEventListener('scan', this.take);
    const scan = scans.newestOf(scans.chosen);
    if (scan) this.frame(scan);
  }

  /** The same world may have been loaded anew: one goes on looking where one looked. */
  async beginAgain() {
    const {viewpoint, views, status} = this;
    await status.ask();
    if (status.latest.scene === this.scene) return;
    this.scene = status.latest.scene;
    if (!viewpoint.followed?.place()) viewpoint.follow(null);
    if (viewpoint.isPlan) {
      viewpoint.fromAbove(views.box());
      return;
    }
    views.all();
    this.from = viewpoint.direction;
    this.scans.addEventListener('scan', this.take);
  }

  leave() {
    this.isOver = true;
    this.scans.removeEventListener('scan', this.take);
  }

  frame(scan) {
    this.leave();
    // Those of many scanners are wherever the world is.
    if (this.scans.shown.length > 1) return;
    this.viewpoint.fit(boxOf(scan), this.from);
    const robot = scan.sensor.split('/')[0];
    const drives = this.status.latest.poses.sources.some((source) => source.robot === robot);
    if (drives) this.views.followLater();
  }
}

/** Around the sensor and what it told. */
function boxOf(scan) {
  const {origins, directions} = shapeOf(scan);
  const box = new Box3();
  for (let i = 0; i < scan.beams; ++i) {
    const origin = new Vector3().fromArray(origins, 3 * i);
    box.expandByPoint(origin);
    const range_m = sentRange(scan, i);
    if (range_m > 0) box.expandByPoint(origin.addScaledVector(new Vector3().fromArray(directions, 3 * i), range_m));
  }
  box.expandByVector(new Vector3(MARGIN_M, MARGIN_M, 0));
  box.max.z += WALL_M;
  return box;
}
