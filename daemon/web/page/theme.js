// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Light or dark: as the system has it, or as the user chose.
import {byId} from './elements.js';
import {lightGround} from './surface.js';

const NEXT = {auto: 'light', light: 'dark', dark: 'auto'};
const KEY = 'scipd theme';
const LABELS = {auto: 'Theme: as the system', light: 'Theme: light', dark: 'Theme: dark'};

export class Theme {
  constructor({settings, stage, ground, world}) {
    Object.assign(this, {settings, stage, ground, world});
    this.dark = matchMedia('(prefers-color-scheme: dark)');
    this.dark.addEventListener('change', () => this.apply());
    settings.watch('theme', () => this.apply());
    byId('theme').addEventListener('click', () =>
      settings.set('theme', NEXT[settings.get('theme')]));
    const kept = localStorage.getItem(KEY);
    if (kept in NEXT && settings.get('theme') === 'auto') settings.set('theme', kept);
    this.apply();
  }

  apply() {
    const wish = this.settings.get('theme');
    localStorage.setItem(KEY, wish);
    const isDark = wish === 'dark' || (wish === 'auto' && this.dark.matches);
    document.documentElement.dataset.theme = isDark ? 'dark' : 'light';
    byId('theme').setAttribute('aria-label', LABELS[wish]);
    byId('theme').title = LABELS[wish];
    byId('theme').textContent = {auto: '◐', light: '☀', dark: '☾'}[wish];
    const style = getComputedStyle(document.documentElement);
    const colour = (name) => style.getPropertyValue(name).trim();
    this.ground.setColours(colour('--grid-fine'), colour('--grid-coarse'));
    this.world.setEdgeColour(colour('--edge'));
    lightGround(Number(colour('--ground-light')));
    this.stage.setBackground(colour('--sky'));
  }
}
