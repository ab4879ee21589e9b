// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Recorded scans as files: CSV and JSON lines as scipcat writes them, and UBH, which UrgBenri reads.
import {firstEcho} from './scan_shape.js';

const CLIENT = 'the live page of scipd';

export const FILES = {
  csv: {label: 'CSV', type: 'text/csv', write: asCsv},
  jsonl: {label: 'JSON lines', type: 'application/jsonl', write: asJsonLines},
  ubh: {label: 'UBH', type: 'text/plain', write: asUbh},
};

function steps(scan, text) {
  return Array.from({length: scan.beams}, (_, i) => text(i, scan.first_step + i));
}

/** [[mm, intensity], ...] of a step. */
function echoesOf(scan, i) {
  const {echo_end: ends, echo_mm: mm, echo_intensity: intensity} = scan.arrays;
  const echoes = [];
  for (let e = firstEcho(scan, i); e < ends[i]; ++e) echoes.push([mm[e], intensity[e]]);
  return echoes;
}

function blocksOf(scan) {
  const {arrays} = scan;
  const blocks = [];
  const several = Boolean(arrays.echo_end);
  for (let echo = 0; echo < (several ? 3 : 1); ++echo) {
    const suffix = several ? echo + 1 : '';
    const of = (k) => several
      ? (one, i) => echoesOf(one, i)[echo]?.[k] ?? ''
      : (one, i) => k ? one.arrays.intensity[i] : one.arrays.sent_mm[i];
    blocks.push({name: `distance${suffix}_mm_`, value: of(0)});
    if (arrays.intensity.length) {
      blocks.push({name: `intensity${suffix}_`, value: of(1)});
    }
  }
  return blocks;
}

export function asCsv(recorded) {
  const [scan] = recorded;
  const blocks = blocksOf(scan);
  const columns = blocks.flatMap(({name}) => steps(scan, (_, step) => name + step));
  const head = [
    `# ${scan.model}, serial ${scan.serial}, firmware ${scan.firmware}, recorded by ${CLIENT}`,
    '# A row is a scan. host_time_s: when it had arrived, Unix time in seconds. stamp_ms: the ' +
      "scanner's clock at step 0, in milliseconds, 24 bits.",
    '# distance_mm_S: the nearest return of step S, in millimetres; what is not within ' +
      `${scan.dmin_mm} to ${scan.dmax_mm} is a code for no distance. intensity_S: relative, no unit.`,
    `# Step S looks to (S - ${scan.front_step}) * 360 / ${scan.steps_per_turn} degrees, ` +
      'counter-clockwise from forward.',
    `# ${['host_time_s', 'stamp_ms', ...columns].join()}`,
  ];
  const rows = recorded.map((one) => [
    one.got_s.toFixed(6), one.stamp_ms,
    ...blocks.flatMap(({value}) => steps(one, (i) => value(one, i))),
  ].join());
  return [...head, ...rows, ''].join('\n');
}

export function asJsonLines(recorded) {
  return recorded.map((scan) => {
    const step_rad = 2 * Math.PI / scan.steps_per_turn;
    const object = {
      host_time_s: scan.got_s,
      stamp_ms: scan.stamp_ms,
      model: scan.model,
      serial: scan.serial,
      first_step: scan.first_step,
      cluster: 1,
      first_angle_rad: (scan.first_step - scan.front_step) * step_rad,
      angle_increment_rad: step_rad,
      dmin_mm: scan.dmin_mm,
      dmax_mm: scan.dmax_mm,
      distances_mm: Array.from(scan.arrays.sent_mm),
    };
    if (scan.arrays.intensity.length) object.intensities = Array.from(scan.arrays.intensity);
    if (scan.arrays.echo_end) object.echoes = steps(scan, (i) => echoesOf(scan, i));
    return `${JSON.stringify(object)}\n`;
  }).join('');
}

/** The text format of UrgBenri: each key and each value has a line of its own. */
export function asUbh(recorded) {
  const [scan] = recorded;
  const several = Boolean(scan.arrays.echo_end);
  const withIntensity = scan.arrays.intensity.length > 0;
  const mode = (several ? 'N' : 'M') + (withIntensity ? 'E' : 'D');
  const head = {
    appName: 'scipd', appVersion: 'live page', model: scan.model, serialNumber: scan.serial,
    firmwareVersion: scan.firmware, captureMode: `${mode}_Capture_mode`,
    startStep: scan.first_step, endStep: scan.first_step + scan.beams - 1, grouping: 1,
    frontStep: scan.front_step, totalSteps: scan.steps_per_turn, minDistance: scan.dmin_mm,
    maxDistance: scan.dmax_mm, motorSpeed: Math.round(scan.rpm),
    scanMsec: Math.round(60_000 / scan.rpm),
  };
  const lines = Object.entries(head).flatMap(([key, value]) => [`[${key}]`, value]);
  const echo = ([mm, intensity]) => withIntensity ? `${mm}|${intensity}` : `${mm}`;
  for (const one of recorded) {
    const values = steps(one, (i) => several
      ? echoesOf(one, i).map(echo).join('&')
      : echo([one.arrays.sent_mm[i], one.arrays.intensity[i]]));
    lines.push('[timestamp]', one.stamp_ms, '[logtime]', logTime(one.got_s), '[scan]',
      values.join(';'));
  }
  return `${lines.join('\n')}\n`;
}

/** As in 2026-01-31 12:00:00.000, local time. */
function logTime(unix_s) {
  const date = new Date(unix_s * 1000);
  const local = new Date(date - date.getTimezoneOffset() * 60_000);
  return local.toISOString().replace('T', ' ').replace('Z', '');
}
