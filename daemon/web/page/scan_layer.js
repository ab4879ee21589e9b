// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What is drawn of the latest scan of one sensor: rays if it is the chosen one, else the fan that it looks over; what
// was sent as points, further echoes, the truth beside it, and a trail.
import {Group} from './three.module.js';
import {Fan} from './fan.js';
import {LineMarks, PointMarks} from './marks.js';
import {Trail} from './trail.js';
import {Reach} from './reach.js';
import {firstEcho, sentRange, shapeOf} from './scan_shape.js';

const GREEN = [0.10, 0.72, 0.25];
const RED = [0.90, 0.16, 0.14];
const TRUE_COLOUR = [1, 1, 1];
// Near the scanner they lie side by side.
const NEAR_OPACITY = 0.08;
const FAR_OPACITY = 0.32;
// More of them are one green plain, in which nobody sees a ray.
const MOST_RAYS = 280;
const CHOSEN_PX = 4.5;
const OTHERS_PX = 3;

export class ScanLayer {
  constructor(settings, colour) {
    this.settings = settings;
    this.group = new Group();
    this.fan = new Fan(colour);
    this.rays = new LineMarks();
    this.hits = new PointMarks(CHOSEN_PX, {rim_px: 2});
    this.truths = new PointMarks(2, {order: 4});
    this.echoes = new PointMarks(4, {rim_px: 2});
    this.trail = new Trail();
    this.scan = null;
    this.isChosen = false;
    this.spacing_m = 0;
    this.world = null;
    this.group.add(this.fan.group);
    for (const marks of this.marks()) this.group.add(marks.group);
  }

  /** The chosen one is drawn with rays, as no more than one can be without hiding all the rest. */
  choose(isChosen) {
    this.isChosen = isChosen;
    this.hits.setSize(isChosen ? CHOSEN_PX : OTHERS_PX);
    this.hits.setRim(isChosen);
  }

  /** Points of others than the chosen one are left out where they would lie closer together than a pixel. */
  space(pixel_m) {
    this.spacing_m = pixel_m;
  }

  /** The box around the world, beyond which nothing is drawn. */
  bound(world) {
    this.world = world;
  }

  marks() {
    return [this.trail.marks, this.rays, this.truths, this.echoes, this.hits];
  }

  take(scan) {
    this.scan = scan;
    this.shape = shapeOf(scan);
  }

  /** The scan that it took is another one than before. */
  drawNew(paint) {
    this.redraw(paint);
    this.trail.setLength(this.settings.get('trail_s'));
    this.trail.add(this.scan.time_s, this.hits, this.hitsCount);
  }

  /** With other settings, or another scan. */
  redraw(paint) {
    if (!this.scan) return;
    this.paint = paint;
    this.drawHits();
    this.drawTruths();
    this.drawEchoes();
    const reach = new Reach(this.scan, this.shape, this.world);
    this.drawRays(reach);
    this.drawFan(reach);
    for (const marks of this.marks()) marks.setThrough(this.settings.get('through'));
  }

  drawHits() {
    const {scan, hits, paint} = this;
    hits.reserve(scan.beams);
    let count = 0;
    for (let i = 0; i < scan.beams; ++i) {
      const range_m = sentRange(scan, i);
      if (!(range_m > 0)) continue;
      hits.putAlong(count, this.shape, i, range_m);
      if (!this.isChosen && count && hits.distance_m(count) < this.spacing_m) continue;
      hits.setShape(count, paint.shapeOf(scan, i));
      hits.tint(count++, paint.colourOf(scan, i), 1);
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
          this.echoes.tint(count++, this.paint.colourOf(this.scan, i, echoes[e] / 1000), 0.75);
        }
      }
    }
    this.echoes.show(count);
  }

  drawRays(reach) {
    const {beams} = this.scan;
    const [isWanted, goesOn] = [this.isChosen && this.settings.get('rays'), this.settings.get('behind')];
    const every = Math.ceil(beams / MOST_RAYS);
    this.rays.reserve(4 * Math.ceil(beams / every));
    let at = 0;
    for (let i = 0; isWanted && i < beams; i += every) {
      const reach_m = reach.of(i);
      at = this.line(at, i, 0, reach_m, GREEN, NEAR_OPACITY, FAR_OPACITY);
      if (goesOn && reach.isHit(i)) at = this.line(at, i, reach_m, reach.end(i), RED, FAR_OPACITY, 0);
    }
    this.rays.show(at);
  }

  /** A picture has a frustum instead, and a cone its few rays. */
  drawFan(reach) {
    const isWanted = this.scan.kind === 'scan' && !this.isChosen && this.settings.get('fans');
    if (isWanted) this.fan.show(this.shape, (i) => reach.of(i));
    else this.fan.hide();
  }

  line(at, i, from_m, to_m, colour, opacityFrom, opacityTo) {
    this.rays.putAlong(at, this.shape, i, from_m);
    this.rays.tint(at++, colour, opacityFrom);
    this.rays.putAlong(at, this.shape, i, to_m);
    this.rays.tint(at++, colour, opacityTo);
    return at;
  }

  dispose() {
    this.fan.dispose();
    for (const marks of this.marks()) marks.dispose();
  }
}
