// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The chosen scanner in numbers: from above, step by step, and chosen steps over time.
import {boundCheckbox, byId, tell} from './elements.js';
import {Pace} from './pace.js';
import {PolarPlot} from './polar_plot.js';
import {KEPT_S} from './recorder.js';
import {sentRange} from './scan_shape.js';
import {StepsTable} from './steps_table.js';
import {TimePlot} from './time_plot.js';
import {WatchedSteps, pointsOf} from './watched_steps.js';

const BETWEEN_MS = 100;
const BETWEEN_CURVES_MS = 300;

export class InspectPanel {
  constructor({stage, scans, settings, inspection, recorder, past}) {
    Object.assign(this, {scans, settings, inspection, recorder, past});
    this.pace = new Pace(BETWEEN_MS, () => this.draw());
    this.curvesPace = new Pace(BETWEEN_CURVES_MS, () => this.drawCurves());
    this.polar = new PolarPlot(byId('polar'), (i, stays) => this.look(i, stays));
    this.table = new StepsTable(byId('steps'), (i) => this.look(i, true));
    this.watched = new WatchedSteps(byId('watched'), () => this.ask());
    const seek = (time_s) => past.seek(time_s);
    this.ranges = new TimePlot(byId('ranges-over-time'), {span_s: KEPT_S, least: 0.02}, seek);
    this.intensities = new TimePlot(byId('intensities-over-time'), {span_s: KEPT_S, least: 20}, seek);
    byId('inspect-on').append(boundCheckbox(settings, 'inspect', 'Read what the pointer is on', 'In the view (I)'));
    this.field = byId('inspect-step');
    this.field.addEventListener('change', () => this.lookAtStep(this.field.valueAsNumber));
    byId('watch').addEventListener('click', () => this.watch());
    stage.afterEach(() => this.ask());
    for (const source of [inspection, past]) source.addEventListener('changed', () => this.ask());
    for (const name of ['panel', 'sensor', 'theme']) settings.watch(name, () => this.ask());
    scans.addEventListener('shown', () => this.ask());
  }

  get sensor() {
    return this.settings.get('sensor');
  }

  get scan() {
    const scan = this.scans.scanOf(this.sensor);
    return scan?.kind === 'scan' ? scan : null;
  }

  /** The beam of the cursor, if the scan has it. */
  get cursor() {
    const i = this.inspection.beamOf(this.sensor);
    return i !== null && i < this.scan?.beams ? i : null;
  }

  look(i, stays) {
    const target = i === null ? null : {kind: 'beam', sensor: this.sensor, i};
    if (stays) this.inspection.pin(target);
    else this.inspection.hover(target);
  }

  lookAtStep(step) {
    const {scan} = this;
    const i = step - scan?.first_step;
    if (i >= 0 && i < scan.beams) this.look(i, true);
  }

  watch() {
    const {scan, cursor} = this;
    if (scan) this.watched.add(scan.first_step + (cursor ?? Math.floor(scan.beams / 2)));
  }

  ask() {
    if (this.settings.get('panel') === 'inspect') this.pace.ask();
  }

  draw() {
    const {scan, cursor} = this;
    byId('inspect-none').hidden = Boolean(scan);
    byId('inspect-scan').hidden = !scan;
    if (!scan) return;
    tell(byId('inspect-sensor'), `${scan.sensor}, scan ${scan.scan}`);
    this.updateField(scan, cursor);
    this.polar.show(scan, cursor);
    this.table.show(scan, cursor ?? Math.floor(scan.beams / 2), cursor !== null);
    this.curvesPace.ask();
  }

  updateField(scan, cursor) {
    this.field.min = scan.first_step;
    this.field.max = scan.first_step + scan.beams - 1;
    if (document.activeElement === this.field) return;
    this.field.value = cursor === null ? '' : String(scan.first_step + cursor);
  }

  drawCurves() {
    const {scan, cursor} = this;
    if (!scan) return;
    const kept = this.recorder.of(this.sensor);
    const newest_s = kept[kept.length - 1]?.got_s ?? 0;
    const looksAt_s = this.past.isPaused ? this.past.looksAt_s : null;
    const steps = this.watched.steps.map(({step, colour}) => ({step, colour}));
    const looked = cursor === null ? null : scan.first_step + cursor;
    if (looked !== null && !steps.some(({step}) => step === looked)) steps.push({step: looked, colour: 'cursor'});
    byId('over-time-none').hidden = steps.length > 0;
    const curves = (valueOf, dash) => steps.map(({step, colour}) =>
      ({colour: this.colour(colour), dash, points: pointsOf(kept, step, valueOf)}));
    this.ranges.show([
      ...curves((one, i) => one.arrays.true_m[i], [3, 3]), ...curves(sentRange)], newest_s, looksAt_s);
    this.intensities.show(curves((one, i) => one.arrays.intensity[i]), newest_s, looksAt_s);
    this.watched.tell(kept);
  }

  colour(name) {
    return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
  }
}
