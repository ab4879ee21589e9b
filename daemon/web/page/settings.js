// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the user chose: named values that others watch.

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
