// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The tabs beside the view: arrows go from one to the next, and only the chosen panel is shown and at work.

export class Tabs {
  constructor(list, settings) {
    this.tabs = [...list.querySelectorAll('[role=tab]')];
    this.settings = settings;
    for (const tab of this.tabs) {
      tab.addEventListener('click', () => settings.set('panel', nameOf(tab)));
    }
    list.addEventListener('keydown', (event) => this.step(event));
    settings.watch('panel', () => this.show());
    this.show();
  }

  get names() {
    return this.tabs.map(nameOf);
  }

  show() {
    const wanted = this.names.includes(this.settings.get('panel'))
      ? this.settings.get('panel') : this.names[0];
    for (const tab of this.tabs) {
      const isWanted = nameOf(tab) === wanted;
      tab.setAttribute('aria-selected', isWanted);
      tab.tabIndex = isWanted ? 0 : -1;
      document.getElementById(tab.getAttribute('aria-controls')).hidden = !isWanted;
    }
  }

  step(event) {
    const by = {ArrowRight: 1, ArrowLeft: -1}[event.key];
    if (!by) return;
    event.preventDefault();
    event.stopPropagation();
    const now = this.tabs.findIndex((tab) => tab.getAttribute('aria-selected') === 'true');
    const next = this.tabs[(now + by + this.tabs.length) % this.tabs.length];
    this.settings.set('panel', nameOf(next));
    next.focus();
  }
}

function nameOf(tab) {
  return tab.getAttribute('aria-controls').replace('panel-', '');
}
