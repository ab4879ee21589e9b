// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the user chose: named values that others watch.
import {PAINTS} from './paints.js';

export const DEFAULTS = {
  theme: 'auto',
  paint: 'auto',
  rays: true,
  behind: false,
  fans: true,
  points: true,
  echoes: true,
  truth: false,
  inspect: true,
  through: true,
  trail_s: 0,
  colours: 'material',
  grid: true,
  cut_m: 0,
  scans: 100,
  panel: 'sensors',
  sensor: '',
};

/** What one can choose of. */
export const CHOICES = {
  paint: PAINTS.map(([name]) => name),
  colours: ['material', 'model'],
  trail_s: [0, 1, 2, 5, 15],
  scans: [10, 100, 400, 1000, 4000],
};
const HIGHEST_CUT_M = 1000;

/** False of what nobody can choose: a link can ask for anything. */
export function fits(name, value) {
  if (typeof value !== typeof DEFAULTS[name]) return false;
  if (name === 'cut_m') return value >= 0 && value <= HIGHEST_CUT_M;
  return !Object.hasOwn(CHOICES, name) || CHOICES[name].includes(value);
}

export class Settings {
  constructor(values = {}) {
    this.values = {...DEFAULTS, ...values};
    this.watchers = [];
  }

  get(name) {
    return this.values[name];
  }

  set(name, value) {
    if (!Object.hasOwn(DEFAULTS, name)) throw new Error(`there is no setting ${name}`);
    if (this.values[name] === value) return;
    this.values[name] = value;
    for (const watcher of this.watchers) {
      if (watcher.name === name || watcher.name === '*') watcher.act(value, name);
    }
  }

  toggle(name) {
    this.set(name, !this.values[name]);
  }

  /** act(value, name) whenever it changes; '*' is any. */
  watch(name, act) {
    this.watchers.push({name, act});
  }
}
