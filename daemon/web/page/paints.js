// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the colours of points mean: range, intensity, material, object or error. Each paint looks at a scan and gives a
// colour for each beam, and a legend.
import * as colours from './colours.js';
import {materialOf, objectOf, sentRange} from './scan_shape.js';

export const PAINTS = [
  ['range', 'Range'], ['intensity', 'Intensity'], ['material', 'Material'], ['object', 'Object'],
  ['error', 'Error, sent − true'],
];
const PLAIN = [0.2, 0.75, 1];

/** The share of values that lie between both ends, without the outermost twentieths. */
function usual(values) {
  const sorted = Float64Array.from(values).sort();
  if (!sorted.length) return [0, 1];
  const at = (share) => sorted[Math.round(share * (sorted.length - 1))];
  const [low, high] = [at(0.05), at(0.95)];
  return high > low ? [low, high] : [low - 0.5, high + 0.5];
}

function each(scan, value) {
  const found = [];
  for (let i = 0; i < scan.beams; ++i) {
    const one = value(i);
    if (Number.isFinite(one)) found.push(one);
  }
  return found;
}

function byRange(scan) {
  const [low, high] = usual(each(scan, (i) => sentRange(scan, i)));
  return {
    colourOf: (i, range_m = sentRange(scan, i)) => colours.viridis((range_m - low) / (high - low)),
    legend: {scale: colours.viridis, low: `${low.toFixed(2)} m`, high: `${high.toFixed(2)} m`},
  };
}

function byIntensity(scan) {
  const intensity = scan.arrays.intensity;
  if (!intensity?.length) return {colourOf: () => PLAIN, legend: {note: 'this sensor tells no intensity'}};
  const value = (i) => Math.log(Math.max(intensity[i], 1));
  const [low, high] = usual(each(scan, (i) => Number.isFinite(sentRange(scan, i)) ? value(i) : NaN));
  return {
    colourOf: (i) => colours.viridis((value(i) - low) / (high - low)),
    legend: {scale: colours.viridis, low: Math.exp(low).toFixed(0), high: Math.exp(high).toFixed(0)},
  };
}

function byName(scan, nameOf, colourOf, shownAs = String) {
  const seen = new Map();
  for (let i = 0; i < scan.beams; ++i) {
    const name = nameOf(i);
    if (name !== null && !seen.has(name)) seen.set(name, colourOf(name));
  }
  return {
    colourOf: (i) => seen.get(nameOf(i)) || PLAIN,
    legend: {names: [...seen].map(([name, colour]) => ({name: shownAs(name), colour}))},
  };
}

function byError(scan) {
  const truth = scan.arrays.true_m;
  const error = (i) => sentRange(scan, i) - truth[i];
  const sizes = each(scan, (i) => Math.abs(error(i))).sort((a, b) => a - b);
  const most = Math.max(3 * (sizes[Math.floor(sizes.length / 2)] || 0), 0.01);
  const mm = Math.round(1000 * most);
  return {
    colourOf: (i) => Number.isFinite(error(i)) ? colours.ofError(error(i) / most) : PLAIN,
    legend: {scale: (share) => colours.ofError(2 * share - 1), low: `−${mm} mm`, high: `+${mm} mm`},
  };
}

/** nameOfObject(id) is what a legend calls an object. */
export function paintOf(name, scan, nameOfObject) {
  if (name === 'intensity') return byIntensity(scan);
  if (name === 'material') return byName(scan, (i) => materialOf(scan, i), colours.ofMaterial);
  if (name === 'object') return byName(scan, (i) => objectOf(scan, i), colours.ofNumber, nameOfObject);
  if (name === 'error' && scan.arrays.sent_mm) return byError(scan);
  return byRange(scan);
}
