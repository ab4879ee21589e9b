// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the colours of points mean: range, intensity, material, object, sensor or error. One paint is for the scans of
// all sensors that are shown, so that equal colours mean the same. It has a legend.
import * as colours from './colours.js';
import {objectOf, returnedMaterial, returnedRange, sentRange} from './scan_shape.js';

export const PAINTS = [
  ['auto', 'Range or sensor'], ['intensity', 'Intensity'], ['material', 'Material'], ['object', 'Object'],
  ['error', 'Range error'], ['range', 'Range'], ['sensor', 'Sensor'],
];
const PLAIN = [0.2, 0.75, 1];
const NONE = [0.6, 0.6, 0.6];
// Enough of all values to find the usual ones.
const MOST_VALUES = 20_000;

/** All of these scans' values, or evenly some of them, by size. */
function sorted(scans, value) {
  const beams = scans.reduce((sum, scan) => sum + scan.beams, 0);
  const every = Math.ceil(beams / MOST_VALUES);
  const found = [];
  for (const scan of scans) {
    for (let i = 0; i < scan.beams; i += every) {
      const one = value(scan, i);
      if (Number.isFinite(one)) found.push(one);
    }
  }
  return Float64Array.from(found).sort();
}

/** What lies between both ends, without the outermost twentieths. */
function usual(values) {
  if (!values.length) return [0, 1];
  const at = (share) => values[Math.round(share * (values.length - 1))];
  const [low, high] = [at(0.05), at(0.95)];
  return high > low ? [low, high] : [low - 0.5, high + 0.5];
}

function byRange(scans) {
  const [low, high] = usual(sorted(scans, sentRange));
  return {
    colourOf: (scan, i, range_m = sentRange(scan, i)) => colours.viridis((range_m - low) / (high - low)),
    legend: {title: 'Range', scale: colours.viridis, low: `${low.toFixed(2)} m`, high: `${high.toFixed(2)} m`},
  };
}

function byIntensity(scans) {
  const title = 'Intensity';
  const telling = scans.filter(({arrays}) => arrays.intensity?.length);
  if (!telling.length) {
    return {colourOf: () => PLAIN, legend: {title, names: [{name: 'no sensor sends it', colour: PLAIN}]}};
  }
  const value = (scan, i) => Math.log(Math.max(scan.arrays.intensity[i], 1));
  const [low, high] = usual(sorted(telling, (scan, i) => sentRange(scan, i) > 0 ? value(scan, i) : NaN));
  return {
    colourOf: (scan, i) => scan.arrays.intensity?.length
      ? colours.viridis((value(scan, i) - low) / (high - low)) : PLAIN,
    legend: {title, scale: colours.viridis, low: Math.exp(low).toFixed(0), high: Math.exp(high).toFixed(0)},
  };
}

/** A colour for each name that points have, and for those that have none, such as of fog. */
function byName(title, scans, nameOf, {lookOf, inOrder, textOf}) {
  const found = new Set();
  for (const scan of scans) {
    for (let i = 0; i < scan.beams; ++i) {
      if (sentRange(scan, i) > 0) found.add(nameOf(scan, i));
    }
  }
  const looks = new Map([[null, {colour: NONE, shape: 0}]]);
  const look = (name) => {
    if (!looks.has(name)) looks.set(name, lookOf(name));
    return looks.get(name);
  };
  const named = inOrder([...found].filter((name) => name !== null));
  const names = named.map((name) => ({name: textOf(name), ...look(name)}));
  if (found.has(null)) names.push({name: 'none', ...look(null)});
  return {
    colourOf: (scan, i) => look(nameOf(scan, i)).colour,
    shapeOf: (scan, i) => look(nameOf(scan, i)).shape,
    legend: {title, names},
  };
}

function byMaterial(scans, {materialLooks}) {
  return byName('Material', scans, returnedMaterial, {
    lookOf: (name) => materialLooks.of(name), inOrder: (names) => materialLooks.inOrder(names), textOf: (name) => name,
  });
}

function byObject(scans, {nameOfObject}) {
  return byName('Object', scans, objectOf, {
    lookOf: (id) => ({colour: colours.ofNumber(id), shape: 0}), inOrder: (ids) => ids, textOf: nameOfObject,
  });
}

function bySensor(scans, {colourOfSensor}) {
  const colourOf = new Map(scans.map(({sensor}) => [sensor, colourOfSensor(sensor)]));
  const names = [...colourOf].map(([name, colour]) => ({name, colour}));
  return {colourOf: (scan) => colourOf.get(scan.sensor), legend: {title: 'Sensor', names, ofSensors: true}};
}

function byError(scans) {
  const error = (scan, i) => sentRange(scan, i) - returnedRange(scan, i);
  const sizes = sorted(scans, (scan, i) => Math.abs(error(scan, i)));
  const most = Math.max(3 * (sizes[Math.floor(sizes.length / 2)] || 0), 0.01);
  const mm = Math.round(1000 * most);
  return {
    colourOf: (scan, i) => Number.isFinite(error(scan, i)) ? colours.ofError(error(scan, i) / most) : PLAIN,
    legend: {title: 'Error, sent − returned', scale: (share) => colours.ofError(2 * share - 1),
      low: `−${mm} mm`, high: `+${mm} mm`},
  };
}

const MAKERS = {
  range: byRange, intensity: byIntensity, material: byMaterial, object: byObject, sensor: bySensor, error: byError,
};

/**
 * {colourOf(scan, i, range_m), shapeOf(scan, i), legend: {title, and scale, low, high, or names: [{name, colour,
 * shape}]}}. words: {nameOfObject(id), colourOfSensor(name), materialLooks}
 */
export function paintOf(name, scans, words) {
  const wanted = name === 'auto' ? (scans.length > 1 ? 'sensor' : 'range') : name;
  return {shapeOf: () => 0, ...MAKERS[wanted](scans, words)};
}
