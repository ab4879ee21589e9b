// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How late scans left, as bars.
import {make, makeSvg} from './elements.js';

const WIDTH = 260;
const HEIGHT = 56;

/** Bars of the counts between one limit in ms and the next; the last has what is beyond all. */
export function histogram({le_ms: limits, counts}) {
  const used = counts.map((count, i) => ({count, i})).filter(({count}) => count > 0);
  if (!used.length) return make('p', {class: 'dim'}, 'No scan has left yet.');
  const first = Math.max(used[0].i - 1, 0);
  const last = Math.min(used[used.length - 1].i + 1, counts.length - 1);
  const shown = counts.slice(first, last + 1);
  const most = Math.max(...shown);
  const width = WIDTH / shown.length;
  const bars = shown.map((count, k) => bar(count, most, k * width, width, range(limits, first + k)));
  return make('figure', {class: 'histogram'},
    makeSvg('svg', {viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: 'img', preserveAspectRatio: 'none',
      'aria-label': 'How late scans left'}, ...bars),
    make('figcaption', {},
      make('span', {}, lowOf(limits, first)), make('span', {}, 'late by'),
      make('span', {}, highOf(limits, last))));
}

function bar(count, most, x, width, title) {
  // Logarithmic, since the rare late ones are what one looks for.
  const share = count ? Math.max(Math.log1p(count) / Math.log1p(most), 0.04) : 0;
  const height = share * HEIGHT;
  const made = makeSvg('rect', {x: x + 0.5, y: HEIGHT - height, width: Math.max(width - 1, 1), height});
  made.append(makeSvg('title', {}, `${count} scans ${title}`));
  return made;
}

function text(ms) {
  return ms < 1 ? `${Math.round(1000 * ms)} µs` : `${Number(ms.toPrecision(3))} ms`;
}

function lowOf(limits, i) {
  return i > 0 ? text(limits[i - 1]) : '0';
}

function highOf(limits, i) {
  return i < limits.length ? text(limits[i]) : `more than ${text(limits[limits.length - 1])}`;
}

function range(limits, i) {
  return i < limits.length ? `${lowOf(limits, i)} to ${highOf(limits, i)} late` : `${highOf(limits, i)} late`;
}
