// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A scan from above, with ahead on top: what was sent as dots, what was true as a line, and a cursor on one step.
import {Chart, roundStep, tickText, ticks} from './chart.js';
import {angleOf, degrees, sentWords} from './beam_words.js';
import {sentRange} from './scan_shape.js';

const MARGIN_PX = 12;
const LEAST_M = 0.1;
const SLACK_M = 0.1;
const SHARE_KEPT = 0.7;
const KEYS = {ArrowLeft: 1, ArrowUp: 1, ArrowRight: -1, ArrowDown: -1, PageUp: 10, PageDown: -10};

/** act(i, stays): the step that the pointer or a key is on; stays when it was clicked or a key. */
export class PolarPlot {
  constructor(canvas, act) {
    this.chart = new Chart(canvas);
    this.act = act;
    this.scan = null;
    this.i = null;
    this.box = null;
    canvas.addEventListener('pointermove', (event) => this.point(event, false));
    canvas.addEventListener('pointerdown', (event) => this.point(event, true));
    canvas.addEventListener('pointerleave', () => act(null, false));
    canvas.addEventListener('keydown', (event) => this.step(event));
  }

  /** i: the step of the cursor, or null. */
  show(scan, i) {
    Object.assign(this, {scan, i});
    this.tellReader();
    if (!this.chart.begin()) return;
    this.frame();
    this.drawRings();
    this.drawTruth();
    const sent = this.places((k) => sentRange(scan, k)).filter(Boolean);
    this.chart.dots(sent, this.chart.colour('accent'), 2.5);
    this.drawRanges();
    if (i !== null) this.drawCursor(i);
  }

  tellReader() {
    const {scan, i, chart: {canvas}} = this;
    const step = scan.first_step + (i ?? Math.floor(scan.beams / 2));
    canvas.setAttribute('aria-valuemin', scan.first_step);
    canvas.setAttribute('aria-valuemax', scan.first_step + scan.beams - 1);
    canvas.setAttribute('aria-valuenow', step);
    canvas.setAttribute('aria-valuetext', i === null
      ? 'no step' : `step ${step}, ${degrees(angleOf(scan, i))}, ${sentWords(scan, i)}`);
  }

  /** The scale and the place of the scanner, so that all that was sent or met has room. */
  frame() {
    const {scan, chart: {width, height}} = this;
    const box = {left: 0, right: 0, up: 0, down: 0};
    for (let i = 0; i < scan.beams; ++i) {
      const range_m = Math.max(sentRange(scan, i) || 0, scan.arrays.true_m[i] || 0);
      const [ahead, left] = [range_m * Math.cos(angleOf(scan, i)), range_m * Math.sin(angleOf(scan, i))];
      box.left = Math.max(box.left, left);
      box.right = Math.max(box.right, -left);
      box.up = Math.max(box.up, ahead);
      box.down = Math.max(box.down, -ahead);
    }
    if (!this.holds(box)) this.box = box;
    const {left, right, up, down} = this.box;
    this.perMetre = Math.min((width - 2 * MARGIN_PX) / Math.max(left + right, LEAST_M),
      (height - 2 * MARGIN_PX) / Math.max(up + down, LEAST_M));
    this.middle = [width / 2 + (left - right) / 2 * this.perMetre, height / 2 + (up - down) / 2 * this.perMetre];
  }

  /** It stays while what is seen changes a little, so that it does not tremble. */
  holds(box) {
    return this.box && Object.keys(box).every((side) =>
      box[side] <= this.box[side] + SLACK_M && box[side] >= SHARE_KEPT * this.box[side] - SLACK_M);
  }

  place(i, range_m) {
    const angle = angleOf(this.scan, i);
    const far_px = this.perMetre * range_m;
    return [this.middle[0] - far_px * Math.sin(angle), this.middle[1] - far_px * Math.cos(angle)];
  }

  places(rangeOf) {
    return Array.from({length: this.scan.beams}, (_, i) => {
      const range_m = rangeOf(i);
      return range_m > 0 ? this.place(i, range_m) : null;
    });
  }

  drawRings() {
    const {chart, middle: [x, y]} = this;
    const {context} = chart;
    context.strokeStyle = chart.colour('line');
    for (const [range_m] of this.rings()) {
      context.beginPath();
      context.arc(x, y, range_m * this.perMetre, 0, 2 * Math.PI);
      context.stroke();
    }
    chart.line([[x - 5, y + 5], [x, y - 7], [x + 5, y + 5]], chart.colour('text'), {width: 1.5});
  }

  /** [[range_m, text], ...] of all that have a part on the canvas. */
  rings() {
    const {chart: {width, height}, middle: [x, y]} = this;
    const reach_m = Math.hypot(Math.max(x, width - x), Math.max(y, height - y)) / this.perMetre;
    const step = roundStep(Math.max(...Object.values(this.box), LEAST_M), 4);
    return ticks(step, reach_m, step).map((range_m) => [range_m, `${tickText(range_m, step)} m`]);
  }

  /** Their numbers, where there is most room. */
  drawRanges() {
    const [x, y] = this.middle;
    const isAhead = this.box.up >= this.box.down;
    for (const [range_m, text] of this.rings()) {
      const at = y + (isAhead ? -1 : 1) * range_m * this.perMetre;
      this.chart.text(text, x + 4, at, {base: isAhead ? 'top' : 'bottom', halo: 'raised'});
    }
  }

  drawTruth() {
    this.chart.line(this.places((i) => this.scan.arrays.true_m[i]), this.chart.colour('dim'));
  }

  drawCursor(i) {
    const {chart, scan} = this;
    chart.line([this.middle, this.place(i, scan.max_range_m)], chart.colour('cursor'), {width: 1.5});
    const range_m = sentRange(scan, i);
    if (range_m > 0) chart.dots([this.place(i, range_m)], chart.colour('cursor'), 8);
  }

  point(event, stays) {
    if (!this.scan || !this.middle) return;
    const angle = Math.atan2(this.middle[0] - event.offsetX, this.middle[1] - event.offsetY);
    const turns = Math.round((angle - this.scan.first_angle_rad) / this.scan.step_rad);
    const i = (turns + this.scan.steps_per_turn) % this.scan.steps_per_turn;
    this.act(i < this.scan.beams ? i : null, stays);
  }

  step(event) {
    if (!this.scan) return;
    const last = this.scan.beams - 1;
    const from = this.i ?? Math.floor(last / 2);
    const to = {Home: 0, End: last}[event.key] ?? from + KEYS[event.key];
    if (Number.isNaN(to)) return;
    event.preventDefault();
    event.stopPropagation();
    // The next key may come before this step is drawn.
    this.i = Math.min(Math.max(to, 0), last);
    this.act(this.i, true);
  }
}
