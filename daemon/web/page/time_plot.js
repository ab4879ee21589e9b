// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Curves over the last minute, with a line at the time that one looks at.
import {Chart, roundStep, tickText, ticks} from './chart.js';

const LEFT_PX = 52;
const RIGHT_PX = 8;
const TOP_PX = 8;
const BOTTOM_PX = 20;

/** seek(at_s): a place on the time axis that was clicked. */
export class TimePlot {
  constructor(canvas, {span_s, least}, seek) {
    Object.assign(this, {span_s, least});
    this.chart = new Chart(canvas);
    canvas.addEventListener('pointerdown', (event) => {
      const share = (event.offsetX - LEFT_PX) / (this.chart.width - LEFT_PX - RIGHT_PX);
      if (share >= 0 && share <= 1 && this.end_s) seek(this.end_s + (share - 1) * this.span_s);
    });
  }

  /** curves: [{colour, dash, points: [[time_s, value or NaN], ...]}]; the axis ends at end_s. */
  show(curves, end_s, looksAt_s) {
    this.end_s = end_s;
    if (!this.chart.begin()) return;
    const [low, high] = this.bounds(curves);
    const {chart} = this;
    const [right, bottom] = [chart.width - RIGHT_PX, chart.height - BOTTOM_PX];
    const x = (time_s) => right - (end_s - time_s) / this.span_s * (right - LEFT_PX);
    const y = (value) => bottom - (value - low) / (high - low) * (bottom - TOP_PX);
    this.drawAxes(low, high, x, y);
    for (const {colour, dash, points} of curves) {
      const places = points.map(([time_s, value]) => Number.isFinite(value) ? [x(time_s), y(value)] : null);
      chart.line(places, colour, {width: 1.25, dash});
    }
    if (looksAt_s) chart.line([[x(looksAt_s), TOP_PX], [x(looksAt_s), bottom]], chart.colour('text'), {width: 1.5});
  }

  /** Of all values, and never so close that rounding fills the plot. */
  bounds(curves) {
    let [low, high] = [Infinity, -Infinity];
    for (const {points} of curves) {
      for (const [, value] of points) {
        if (!Number.isFinite(value)) continue;
        low = Math.min(low, value);
        high = Math.max(high, value);
      }
    }
    if (low > high) return [0, this.least];
    const pad = Math.max(0.08 * (high - low), (this.least - (high - low)) / 2, 0);
    return [low - pad, high + pad];
  }

  drawAxes(low, high, x, y) {
    const {chart, end_s} = this;
    const step = roundStep(high - low, 4);
    for (const value of ticks(low, high, step)) {
      chart.line([[LEFT_PX, y(value)], [chart.width - RIGHT_PX, y(value)]], chart.colour('line'));
      chart.text(tickText(value, step), LEFT_PX - 5, y(value), {align: 'right', base: 'middle'});
    }
    const every_s = roundStep(this.span_s, 4);
    for (const ago_s of ticks(-this.span_s, 0, every_s)) {
      const isLast = ago_s === 0;
      chart.text(isLast ? '0 s' : tickText(ago_s, every_s), x(end_s + ago_s), chart.height - 5,
        {align: isLast ? 'right' : 'center'});
    }
  }
}
