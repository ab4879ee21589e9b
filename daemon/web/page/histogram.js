// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The latency of scans, as bars on a logarithmic axis.
import {make, makeSvg} from './elements.js';

const WIDTH = 260;
const HEIGHT = 56;
const MOST_TICKS = 5;

/** Bars of the counts between one limit in ms and the next; the last has what is beyond all. */
export function histogram({le_ms: limits, counts}) {
  const used = counts.map((count, i) => ({count, i})).filter(({count}) => count > 0);
  if (!used.length) return make('p', {class: 'dim'}, 'No scan was sent yet.');
  const first = Math.max(used[0].i - 1, 0);
  const last = Math.min(used[used.length - 1].i + 1, counts.length - 1);
  const shown = counts.slice(first, last + 1);
  const most = Math.max(...shown);
  const width = WIDTH / shown.length;
  const bars = shown.map((count, k) => bar(count, most, k * width, width, range(limits, first + k)));
  return make('figure', {class: 'histogram'},
    makeSvg('svg', {viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: 'img', preserveAspectRatio: 'none',
      'aria-label': 'Latency of scans'}, ...bars),
    make('figcaption', {}, ...ticksOf(limits, first, last)));
}

/** Round numbers of the axis, where they are: each limit is twice the one before it, and each bar as wide. */
function ticksOf(limits, first, last) {
  const place = (ms) => Math.log2(ms / limits[0]) + 1 - first;
  const isSeen = (ms) => place(ms) >= 0.3 && place(ms) <= last - first + 0.7;
  const powers = [0.01, 0.1, 1, 10, 100];
  const tight = powers.flatMap((ms) => [ms, 2 * ms, 5 * ms]).filter(isSeen);
  const ticks = tight.length > MOST_TICKS ? powers.filter(isSeen) : tight;
  return ticks.map((ms) => {
    const tick = make('span', {class: 'tick'}, text(ms));
    tick.style.left = `${100 * place(ms) / (last - first + 1)}%`;
    return tick;
  });
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
