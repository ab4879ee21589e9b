// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What is drawn of the latest scan of one sensor: rays that are green to the hit and red from it on, what was sent as
// points, further echoes, the truth beside it, and a trail.
import {Group} from './three.module.js';
import {LineMarks, PointMarks} from './marks.js';
import {Trail} from './trail.js';
import {paintOf} from './paints.js';
import {firstEcho, sentRange, shapeOf} from './scan_shape.js';

const GREEN = [0.10, 0.72, 0.25];
const RED = [0.90, 0.16, 0.14];
const TRUE_COLOUR = [1, 1, 1];
const RAY_OPACITY = 0.4;
// More of them are one green plain, in which nobody sees a ray.
const MOST_RAYS = 400;
const FARTHEST_M = 30;

export class ScanLayer {
  /** nameOf(id) is the name of an object. */
  constructor(settings, nameOf) {
    this.settings = settings;
    this.nameOf = nameOf;
    this.group = new Group();
    this.rays = new LineMarks();
    this.hits = new PointMarks(4.5, {rim_px: 2});
    this.truths = new PointMarks(2, {order: 4});
    this.echoes = new PointMarks(4, {rim_px: 2});
    this.trail = new Trail();
    this.scan = null;
    for (const marks of this.marks()) this.group.add(marks.group);
  }

  marks() {
    return [this.trail.marks, this.rays, this.truths, this.echoes, this.hits];
  }

  take(scan, now_s) {
    this.scan = scan;
    this.shape = shapeOf(scan);
    this.redraw();
    this.trail.setLength(this.settings.get('trail_s'));
    this.trail.add(now_s, this.hits, this.hitsCount);
  }

  /** With other settings, or with another scan. */
  redraw() {
    if (!this.scan) return;
    this.paint = paintOf(this.settings.get('paint'), this.scan, this.nameOf);
    this.drawHits();
    this.drawTruths();
    this.drawEchoes();
    this.drawRays();
    for (const marks of this.marks()) marks.setThrough(this.settings.get('through'));
  }

  drawHits() {
    const {scan, hits} = this;
    hits.reserve(scan.beams);
    let count = 0;
    for (let i = 0; i < scan.beams; ++i) {
      const range_m = sentRange(scan, i);
      if (!(range_m > 0)) continue;
      hits.putAlong(count, this.shape, i, range_m);
      hits.tint(count++, this.paint.colourOf(i), 1);
    }
    this.hitsCount = count;
    hits.show(this.settings.get('points') ? count : 0);
  }

  drawTruths() {
    const {scan} = this;
    this.truths.reserve(scan.beams);
    let count = 0;
    for (let i = 0; this.settings.get('truth') && i < scan.beams; ++i) {
      const range_m = scan.arrays.true_m[i];
      if (!(range_m > 0)) continue;
      this.truths.putAlong(count, this.shape, i, range_m);
      this.truths.tint(count++, TRUE_COLOUR, 0.9);
    }
    this.truths.show(count);
  }

  /** Second and third echoes, of models that tell several. */
  drawEchoes() {
    const {echo_end: ends, echo_mm: echoes} = this.scan.arrays;
    let count = 0;
    if (echoes && this.settings.get('echoes')) {
      this.echoes.reserve(echoes.length);
      for (let i = 0; i < this.scan.beams; ++i) {
        for (let e = firstEcho(this.scan, i) + 1; e < ends[i]; ++e) {
          this.echoes.putAlong(count, this.shape, i, echoes[e] / 1000);
          this.echoes.tint(count++, this.paint.colourOf(i, echoes[e] / 1000), 0.75);
        }
      }
    }
    this.echoes.show(count);
  }

  drawRays() {
    const {scan} = this;
    const farthest_m = scan.max_range_m || FARTHEST_M;
    const every = Math.ceil(scan.beams / MOST_RAYS);
    this.rays.reserve(4 * Math.ceil(scan.beams / every));
    let at = 0;
    for (let i = 0; this.settings.get('rays') && i < scan.beams; i += every) {
      const hit_m = scan.arrays.true_m[i];
      const isHit = hit_m > 0 && hit_m < farthest_m;
      at = this.line(at, i, 0, isHit ? hit_m : farthest_m, GREEN, RAY_OPACITY, RAY_OPACITY);
      if (isHit) at = this.line(at, i, hit_m, farthest_m, RED, 0.8 * RAY_OPACITY, 0);
    }
    this.rays.show(at);
  }

  line(at, i, from_m, to_m, colour, opacityFrom, opacityTo) {
    this.rays.putAlong(at, this.shape, i, from_m);
    this.rays.tint(at++, colour, opacityFrom);
    this.rays.putAlong(at, this.shape, i, to_m);
    this.rays.tint(at++, colour, opacityTo);
    return at;
  }

  dispose() {
    for (const marks of this.marks()) marks.dispose();
  }
}
