// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The steps whose ranges and intensities are drawn over time: some that were chosen, and the one of the cursor.
import {make, tell} from './elements.js';
import {sentRange} from './scan_shape.js';

// Those of Okabe and Ito, which colour-blind people tell apart; light and dark as the theme is.
const COLOURS = ['watch-1', 'watch-2', 'watch-3', 'watch-4'];

/** act(): others are watched. */
export class WatchedSteps {
  constructor(list, act) {
    this.list = list;
    this.act = act;
    this.steps = [];
  }

  /** Step numbers of SCIP. */
  add(step) {
    if (this.steps.some((each) => each.step === step)) return;
    if (this.steps.length === COLOURS.length) this.steps.shift();
    const name = COLOURS.find((each) => !this.steps.some(({colour}) => colour === each));
    this.steps.push({step, colour: name});
    this.build();
  }

  remove(step) {
    this.steps = this.steps.filter((each) => each.step !== step);
    this.build();
  }

  build() {
    this.list.replaceChildren(...this.steps.map(({step, colour}) => make('li', {class: 'row'},
      make('span', {class: `swatch ${colour}`}), make('span', {}, `step ${step}`),
      make('span', {class: 'dim space'}),
      make('button', {class: 'quiet', 'aria-label': `Stop watching step ${step}`,
        on: {click: () => this.remove(step)}}, '×'))));
    this.act();
  }

  /** What all these scans say of each step. */
  tell(scans) {
    this.steps.forEach(({step}, k) =>
      tell(this.list.children[k].children[2], summaryOf(pointsOf(scans, step, sentRange))));
  }
}

/** [[time_s, value], ...] of a step of SCIP, by valueOf(scan, i). */
export function pointsOf(scans, step, valueOf) {
  return scans.map((scan) => {
    const i = step - scan.first_step;
    return [scan.got_s, i >= 0 && i < scan.beams ? valueOf(scan, i) : NaN];
  });
}

/** Mean and standard deviation of what has a range, and how many have none. */
export function summaryOf(points) {
  const ranges = points.map(([, range_m]) => range_m).filter(Number.isFinite);
  const without = points.length - ranges.length;
  const none = without ? `, ${without} without` : '';
  if (!ranges.length) return `no range in ${points.length} scans`;
  const mean = ranges.reduce((sum, each) => sum + each, 0) / ranges.length;
  const squares = ranges.reduce((sum, each) => sum + (each - mean) ** 2, 0);
  const sigma_mm = 1000 * Math.sqrt(squares / Math.max(ranges.length - 1, 1));
  return `${mean.toFixed(3)} m, σ ${sigma_mm.toFixed(1)} mm, ${ranges.length} scans${none}`;
}
