// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the user chose: named values that others watch.
import {PAINTS} from './paints.js';

export const DEFAULTS = {
  theme: 'auto',
  paint: 'range',
  rays: true,
  points: true,
  echoes: true,
  truth: false,
  through: true,
  trail_s: 0,
  colours: 'material',
  grid: true,
  cut_m: 0,
  keep_s: 10,
  panel: 'sensors',
  sensor: '',
};

/** What of its kind a setting may not be all of: a link can ask for anything. */
const FITS = {
  paint: (value) => PAINTS.some(([name]) => name === value),
  colours: (value) => ['material', 'model'].includes(value),
  trail_s: (value) => value >= 0 && value <= 15,
  cut_m: (value) => value >= 0 && value <= 1000,
  keep_s: (value) => value >= 5 && value <= 60,
};

export function fits(name, value) {
  return !Object.hasOwn(FITS, name) || FITS[name](value);
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
