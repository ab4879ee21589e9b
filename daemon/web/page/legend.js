// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the colours of the points mean now.
import {byId, make, tell} from './elements.js';
import {SHAPES} from './material_looks.js';
import {css, gradient} from './colours.js';

const BETWEEN_MS = 250;
const MOST_NAMES = 18;

export class Legend {
  constructor({scans, settings}) {
    Object.assign(this, {scans, settings});
    this.bar = make('div', {class: 'bar-of-colours'});
    this.low = make('span');
    this.high = make('span');
    this.scale = make('div', {}, this.bar, make('div', {class: 'row ends'}, this.low, this.high));
    this.names = make('ul');
    byId('legend-body').append(this.scale, this.names);
    setInterval(() => this.update(), BETWEEN_MS);
  }

  update() {
    const {legend} = this.scans;
    byId('legend').hidden = !legend || !this.settings.get('points');
    if (!legend) return;
    tell(byId('legend-title'), legend.title);
    this.scale.hidden = !legend.scale;
    this.names.hidden = Boolean(legend.scale);
    if (legend.scale) this.updateScale(legend);
    else this.updateNames(legend);
  }

  updateScale({scale, low, high}) {
    const background = gradient(scale);
    if (this.background !== background) this.bar.style.background = this.background = background;
    tell(this.low, low);
    tell(this.high, high);
  }

  updateNames({names, most = MOST_NAMES}) {
    const key = JSON.stringify(names);
    if (key === this.named) return;
    this.named = key;
    const rows = names.slice(0, most).map(({name, colour, shape = 0}) => {
      const swatch = make('span', {class: `swatch ${SHAPES[shape]}`});
      swatch.style.background = css(colour);
      return make('li', {}, swatch, make('span', {}, String(name)));
    });
    if (names.length > most) rows.push(make('li', {class: 'dim'}, `and ${names.length - most} more`));
    this.names.replaceChildren(...rows);
  }
}
