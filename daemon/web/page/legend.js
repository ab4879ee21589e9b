// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The meaning of the colours of points. All sensors that are shown are listed, by robot if they are many; a click
// selects one.
import {byId, make, tell} from './elements.js';
import {SHAPES} from './material_looks.js';
import {css, gradient} from './colours.js';

const BETWEEN_MS = 250;
const MOST_NAMES = 18;
// More sensors than this are listed by robot.
const MOST_ROWS = 6;

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

  updateNames({names, ofSensors}) {
    const key = JSON.stringify([names, ofSensors && this.settings.get('sensor')]);
    if (key === this.named) return;
    this.named = key;
    this.names.replaceChildren(...(ofSensors ? this.sensorRows(names) : nameRows(names)));
  }

  sensorRows(sensors) {
    if (sensors.length <= MOST_ROWS) {
      return sensors.map((each) => make('li', {}, this.sensorButton(each, each.name)));
    }
    const robots = new Map();
    for (const each of sensors) {
      const [robot, ...rest] = each.name.split('/');
      robots.set(robot, [...robots.get(robot) || [], this.sensorButton(each, rest.join('/'))]);
    }
    return [...robots].map(([robot, buttons]) =>
      make('li', {class: 'robot'}, make('span', {class: 'dim'}, robot), ...buttons));
  }

  sensorButton({name, colour}, text) {
    const {settings} = this;
    return make('button', {class: 'entry', title: `Select ${name}`, 'data-name': name,
      'aria-pressed': String(settings.get('sensor') === name), on: {click: () => settings.set('sensor', name)}},
    swatchOf(colour), make('span', {}, text));
  }
}

function nameRows(names) {
  const rows = names.slice(0, MOST_NAMES).map(({name, colour, shape}) =>
    make('li', {'data-name': name}, swatchOf(colour, shape), make('span', {}, String(name))));
  const more = `and ${names.length - MOST_NAMES} more`;
  return names.length > MOST_NAMES ? [...rows, make('li', {class: 'dim', 'data-name': more}, more)] : rows;
}

function swatchOf(colour, shape = 0) {
  const swatch = make('span', {class: `swatch ${SHAPES[shape]}`});
  swatch.style.background = css(colour);
  return swatch;
}
