// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The bar with which one goes through the last minute while the page stands still.
import {byId, tell} from './elements.js';

export class Timeline {
  constructor({past, scans, settings}) {
    Object.assign(this, {past, scans, settings});
    this.slider = byId('timeline-slider');
    byId('view-pause').addEventListener('click', () => past.toggle());
    byId('timeline-live').addEventListener('click', () => past.live());
    byId('timeline-back').addEventListener('click', () => past.step(-1));
    byId('timeline-on').addEventListener('click', () => past.step(1));
    this.slider.addEventListener('input', () => past.seek(past.span.to_s + this.slider.valueAsNumber));
    past.addEventListener('changed', () => this.update());
  }

  update() {
    const {past, slider} = this;
    byId('view-pause').setAttribute('aria-pressed', past.isPaused);
    byId('timeline').hidden = !past.isPaused;
    if (!past.isPaused) return;
    const {from_s, to_s} = past.span;
    slider.min = (from_s - to_s).toFixed(2);
    slider.valueAsNumber = past.looksAt_s - to_s;
    const text = `${(past.looksAt_s - to_s).toFixed(2)} s`.replace(/^-(0\.00)/, '$1').replace('-', '−');
    tell(byId('timeline-time'), text);
    slider.setAttribute('aria-valuetext', text);
  }
}
