// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The link that holds what one sees: from where, what is selected and shown, and what was chosen. It stands in the
// address line, behind #, so the daemon never gets it. It has no token.
import {DEFAULTS, fits} from './settings.js';

const SETTLE_MS = 300;
// Farther out a picture in single precision shakes.
const FARTHEST_M = 1e5;
// These belong to the user, not to the view.
const OWN = new Set(['theme']);

export class Link {
  constructor({settings, viewpoint, selection, scans}) {
    Object.assign(this, {settings, viewpoint, selection, scans});
    this.wanted = parse(location.hash);
  }

  /** From now on the address follows. */
  begin() {
    const later = () => {
      clearTimeout(this.timer);
      this.timer = setTimeout(() => history.replaceState(null, '', this.hash()), SETTLE_MS);
    };
    this.settings.watch('*', later);
    this.viewpoint.addEventListener('change', later);
    this.viewpoint.addEventListener('follow', later);
    this.selection.addEventListener('changed', later);
    this.scans.addEventListener('shown', later);
    window.addEventListener('hashchange', () => location.reload());
  }

  hash() {
    const {eye, at, top} = this.viewpoint.state();
    const parts = {eye: places(eye), at: places(at)};
    if (top) parts.top = '1';
    const {thing} = this.selection;
    if (thing) parts.select = `${thing.kind}:${thing.name}`;
    if (this.viewpoint.followed) parts.follow = '1';
    parts.show = this.scans.shown.join(',');
    for (const [name, value] of Object.entries(this.settings.values)) {
      if (value !== DEFAULTS[name] && !OWN.has(name)) parts[name] = String(value);
    }
    return `#${Object.entries(parts).map(
      ([name, value]) => `${name}=${encodeURIComponent(value)}`).join('&')}`;
  }

  address() {
    return location.href.split('#')[0] + this.hash();
  }

  /** The settings that the link has, of the types that they have. */
  get settingsWanted() {
    const values = {};
    for (const [name, text] of Object.entries(this.wanted)) {
      if (!Object.hasOwn(DEFAULTS, name) || OWN.has(name)) continue;
      const value = READ[typeof DEFAULTS[name]](text);
      if (fits(name, value)) values[name] = value;
    }
    return values;
  }

  /** {eye, at, top} or null. */
  get viewWanted() {
    const [eye, at] = [this.wanted.eye, this.wanted.at].map((text) => (text || '').split(',').map(Number));
    const isPlace = (place) => place.length === 3 && place.every((value) => Math.abs(value) <= FARTHEST_M);
    const isGood = isPlace(eye) && isPlace(at) && eye.some((value, i) => value !== at[i]);
    return isGood ? {eye, at, top: this.wanted.top === '1'} : null;
  }

  get selectWanted() {
    const [kind, ...name] = (this.wanted.select || '').split(':');
    return name.length ? {kind, name: name.join(':')} : null;
  }

  get showWanted() {
    return 'show' in this.wanted ? this.wanted.show.split(',').filter(Boolean) : null;
  }
}

const READ = {
  boolean: (text) => ({true: true, false: false})[text],
  number: (text) => text.trim() === '' ? NaN : Number(text),
  string: (text) => text,
};

function places(xyz) {
  return xyz.map((value) => Number(value.toFixed(3))).join();
}

function parse(hash) {
  const parts = {};
  for (const part of hash.replace(/^#/, '').split('&')) {
    const [name, ...rest] = part.split('=');
    if (!name) continue;
    try {
      parts[name] = decodeURIComponent(rest.join('='));
    } catch {
      // Half a link is still worth its other half.
    }
  }
  return parts;
}
