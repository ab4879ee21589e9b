// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a scan says of one of its beams, in words: what was sent, what was true, and why.
import {firstEcho, objectOf, sentRange} from './scan_shape.js';

const CAUSES = {
  measured: 'measured',
  nothing: 'nothing came back',
  too_dark: 'too little light came back',
  too_bright: 'too much light came back',
  edge: 'two surfaces in one beam',
  interference: 'light of another scanner',
  lost: 'the scanner failed to measure',
};

export function metres(range_m) {
  return Number.isFinite(range_m) ? `${range_m.toFixed(3)} m` : 'nothing';
}

export function degrees(angle_rad) {
  return `${(angle_rad * 180 / Math.PI).toFixed(2)}°`.replace('-', '−');
}

/** With its sign, in mm, or null where there is no such difference. */
export function errorOf(scan, i) {
  const error_m = sentRange(scan, i) - scan.arrays.true_m[i];
  if (!Number.isFinite(error_m)) return null;
  const mm = Math.round(1000 * error_m);
  return `${mm < 0 ? '−' : '+'}${Math.abs(mm)} mm`;
}

/** A range, or the code that stands for none. */
export function sentWords(scan, i) {
  const range_m = sentRange(scan, i);
  if (Number.isFinite(range_m)) return metres(range_m);
  return scan.arrays.sent_mm ? `no range, code ${scan.arrays.sent_mm[i]}` : 'nothing';
}

/** Why the beam has a range or none, as the sensor measured it. */
export function causeWords(scan, i) {
  if (!scan.arrays.cause) return null;
  const cause = scan.causes[scan.arrays.cause[i]];
  const isKept = cause === 'measured' && !Number.isFinite(sentRange(scan, i));
  return isKept ? 'measured, but out of bounds' : CAUSES[cause] || cause;
}

/** The faults that changed the reading of a beam, or null. */
function faultWords(scan, i) {
  const step = scan.first_step + i;
  const isChanged = ({steps}) => !steps.length || steps.some(([first, last]) => first <= step && step <= last);
  return scan.faults?.filter(isChanged).map(({kind, what}) => `${kind}: ${what}`).join('; ') || null;
}

/** From ahead, counter-clockwise; null of a sensor that is no scanner. */
export function angleOf(scan, i) {
  return scan.kind === 'scan' ? scan.first_angle_rad + i * scan.step_rad : null;
}

/** What the beam is called: a step of a scanner, a pixel of a camera, a beam of a ranger. */
export function nameOfBeam(scan, i) {
  if (scan.kind === 'scan') return `step ${scan.first_step + i}`;
  if (scan.kind === 'picture') return `pixel ${i % scan.columns}, ${Math.floor(i / scan.columns)}`;
  return `beam ${i}`;
}

function echoWords(scan, i) {
  const {echo_end: ends, echo_mm: mm, echo_intensity: intensity} = scan.arrays;
  if (!ends) return null;
  const echoes = [];
  for (let e = firstEcho(scan, i); e < ends[i]; ++e) {
    echoes.push(`${(mm[e] / 1000).toFixed(3)} m` + (intensity.length ? ` (${intensity[e]})` : ''));
  }
  return echoes.join(', ') || 'none';
}

/** Of what the middle of the beam met. The light may have come from what stands behind it. */
function materialWords(scan, i) {
  const index = scan.arrays.material?.[i] ?? -1;
  return index < 0 ? null : scan.materials[index];
}

function objectWords(scan, i, nameOf) {
  const id = objectOf(scan, i);
  return id === null ? null : nameOf(id);
}

/** [[label, text], ...]; nameOf(id) is the name of an object. age_s: since the page got the scan. */
export function factsOf(scan, i, nameOf, age_s) {
  const angle_rad = angleOf(scan, i);
  const error = errorOf(scan, i);
  const facts = [
    ['Angle', angle_rad === null ? null : degrees(angle_rad)],
    ['Sent', sentWords(scan, i)],
    ['True', metres(scan.arrays.true_m[i]) + (error ? `, error ${error}` : '')],
    ['Intensity', scan.arrays.intensity?.length ? String(scan.arrays.intensity[i]) : null],
    ['Echoes', echoWords(scan, i)],
    ['Fault', faultWords(scan, i)],
    ['Cause', causeWords(scan, i)],
    ['Material', materialWords(scan, i)],
    ['Object', objectWords(scan, i, nameOf)],
    ['Age', `${age_s.toFixed(2)} s, scan ${scan.scan}`],
  ];
  return facts.filter(([, text]) => text !== null);
}
