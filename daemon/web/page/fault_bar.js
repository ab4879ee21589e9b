// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A time bar of what faults did at a scanner in the last minute: a row for each kind, a band while it is active, a tick
// where it acted. From the daemon's log of faults.
import {makeSvg} from './elements.js';
import {at} from './server.js';

const SPAN_S = 60;
const WIDTH = 330;
const LABEL = 84;
const ROW = 20;

export class FaultBar {
  constructor(svg, server) {
    Object.assign(this, {svg, server});
    this.begin(null);
  }

  begin(sensor) {
    Object.assign(this, {sensor, rows: new Map(), last: 0, latest_s: 0});
  }

  async refresh(sensor, now_s) {
    if (sensor !== this.sensor) this.begin(sensor);
    const log = await this.server.get(at('/sensors/', sensor, `/faults/log?since=${this.last}`)).catch(() => null);
    if (!log || sensor !== this.sensor) return;
    // A daemon that began anew counts anew.
    if (log.last < this.last) this.begin(sensor);
    for (const entry of log.entries) {
      if (entry.n > this.last) this.take(entry);
    }
    this.draw(Math.max(now_s, this.latest_s));
  }

  take({n, id, kind, what, time_s}) {
    this.last = n;
    this.latest_s = time_s;
    if (!this.rows.has(kind)) this.rows.set(kind, {open: new Map(), bands: [], ticks: []});
    const {open, bands, ticks} = this.rows.get(kind);
    if (what === 'begins') {
      open.set(id, time_s);
    } else if (what === 'ends') {
      bands.push({from_s: open.get(id) ?? time_s, to_s: time_s});
      open.delete(id);
    } else {
      ticks.push(time_s);
    }
  }

  draw(now_s) {
    const from_s = now_s - SPAN_S;
    this.forget(from_s);
    const x = (time_s) => LABEL + (WIDTH - LABEL) * Math.max(time_s - from_s, 0) / SPAN_S;
    const rows = [...this.rows];
    this.svg.setAttribute('viewBox', `0 0 ${WIDTH} ${ROW * (rows.length + 1)}`);
    this.svg.setAttribute('aria-label', rows.length
      ? `In the last minute: ${rows.map(inWords).join('; ')}` : 'No fault acted in the last minute');
    this.svg.replaceChildren(...rows.flatMap((row, i) => drawRow(row, ROW * i, x, now_s)),
      ...axis(ROW * rows.length, x, now_s));
  }

  forget(from_s) {
    for (const [kind, row] of this.rows) {
      row.bands = row.bands.filter(({to_s}) => to_s >= from_s);
      row.ticks = row.ticks.filter((tick_s) => tick_s >= from_s);
      if (!row.open.size && !row.bands.length && !row.ticks.length) this.rows.delete(kind);
    }
  }
}

function inWords([kind, {open, ticks}]) {
  return `${kind} acted ${ticks.length === 1 ? 'once' : `${ticks.length} times`}${open.size ? ' and is active' : ''}`;
}

/** A band is seen however short it was; ticks on the same pixel are one. */
function drawRow([kind, {open, bands, ticks}], y, x, now_s) {
  const all = [...bands, ...[...open.values()].map((from_s) => ({from_s, to_s: now_s}))];
  const columns = new Set(ticks.map((tick_s) => Math.round(2 * x(tick_s)) / 2));
  return [
    makeSvg('text', {x: 0, y: y + 14}, kind),
    ...all.map(({from_s, to_s}) => makeSvg('rect', {class: 'band', x: x(from_s), y: y + 3,
      width: Math.max(x(to_s) - x(from_s), 2), height: ROW - 6, rx: 3})),
    makeSvg('path', {class: 'tick', d: [...columns].map((column) => `M${column} ${y + 5}v${ROW - 10}`).join('')}),
  ];
}

function axis(y, x, now_s) {
  const marks = [60, 45, 30, 15, 0].map((ago_s) => now_s - ago_s);
  const ticks = marks.map((each) => `M${x(each)} ${y + 1}v3`).join('');
  return [
    makeSvg('path', {class: 'axis', d: `M${LABEL} ${y + 1}H${WIDTH}${ticks}`}),
    makeSvg('text', {x: LABEL, y: y + 16}, `${SPAN_S} s ago`),
    makeSvg('text', {x: WIDTH, y: y + 16, 'text-anchor': 'end'}, `now: ${now_s.toFixed(0)} s`),
  ];
}
