// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What is drawn of scans, and a card for each sensor: whether one sees its scans, and how it is doing.
import {boundCheckbox, boundSelect, byId, make, tell} from './elements.js';
import {ErrorsForm} from './errors_form.js';
import {CHOICES} from './settings.js';
import {histogram} from './histogram.js';
import {PAINTS} from './paints.js';
import {pictureOf} from './picture.js';

const STATE_KINDS = {streaming: 'good', measuring: 'good', error: 'bad', booting: 'busy'};

export class SensorsPanel {
  constructor({server, settings, status, scans, notices}) {
    Object.assign(this, {server, settings, status, scans, notices});
    this.cards = new Map();
    byId('drawing').append(...this.choices());
    status.addEventListener('changed', () => this.update());
    scans.addEventListener('shown', () => this.update());
    settings.watch('sensor', () => this.update());
  }

  choices() {
    const {settings} = this;
    return [
      boundSelect(settings, 'paint', 'Colour of points', PAINTS),
      boundSelect(settings, 'trail_s', 'Trail', CHOICES.trail_s.map((each) => [each, each ? `${each} s` : 'none'])),
      make('div', {class: 'checks'},
        boundCheckbox(settings, 'rays', 'Rays', 'Of the chosen sensor, green to what they meet (R)'),
        boundCheckbox(settings, 'behind', 'Red behind', 'Rays go on in red, as far as the scanner sees'),
        boundCheckbox(settings, 'fans', 'Fans', 'What the other scanners look over (U)'),
        boundCheckbox(settings, 'points', 'Points', 'What the scanner sent (P)'),
        boundCheckbox(settings, 'truth', 'True beside sent', 'White: where the beam really met something (V)'),
        boundCheckbox(settings, 'echoes', 'All echoes', 'Second and third echoes (E)'),
        boundCheckbox(settings, 'through', 'Through walls', 'What is hidden shows faintly (X)')),
    ];
  }

  update() {
    const names = this.status.sensors.map(({name}) => name);
    const isNew = names.join('\n') !== [...this.cards.keys()].join('\n');
    if (isNew) this.build(names);
    for (const sensor of this.status.sensors) this.cards.get(sensor.name).update(sensor);
  }

  build(names) {
    this.cards = new Map(names.map((name) => [name, new SensorCard(name, this)]));
    byId('sensors').replaceChildren(...[...this.cards.values()].map((card) => card.element));
  }
}

class SensorCard {
  constructor(name, panel) {
    const {settings, scans, status} = panel;
    Object.assign(this, {name, settings, scans, status});
    this.errors = new ErrorsForm(name, panel);
    this.box = make('input', {type: 'checkbox', 'aria-label': `Show the scans of ${name}`});
    this.box.addEventListener('change', () => scans.show(name, this.box.checked));
    this.title = make('button', {class: 'name', title: 'Choose it for the other panels',
      on: {click: () => settings.set('sensor', name)}}, name);
    this.state = make('span', {class: 'chip'});
    this.model = make('span', {class: 'dim'});
    this.facts = make('dl', {class: 'facts'});
    this.values = new Map();
    this.warning = make('p', {class: 'warning', hidden: true});
    this.late = make('div');
    this.picture = make('canvas', {class: 'picture', hidden: true});
    this.element = make('section', {class: 'card sensor'},
      make('div', {class: 'row'}, this.box, this.title, this.state),
      this.model, this.warning, this.facts, this.errors.element, this.picture, this.late);
  }

  update(sensor) {
    this.box.checked = this.scans.isShown(this.name);
    this.element.classList.toggle('chosen', this.settings.get('sensor') === this.name);
    this.title.setAttribute('aria-pressed', this.settings.get('sensor') === this.name);
    tell(this.state, sensor.state);
    this.state.className = `chip ${STATE_KINDS[sensor.state] || ''}`;
    tell(this.model, `${sensor.model}, by ${sensor.backend}`);
    this.warning.hidden = !sensor.warning;
    tell(this.warning, sensor.warning || '');
    for (const [label, value, title] of this.factsOf(sensor)) this.fact(label, value, title);
    this.errors.update(sensor.errors);
    this.updateLateness(sensor);
    this.updatePicture();
  }

  factsOf(sensor) {
    const rate = this.status.rates.scans.get(this.name);
    const ms = (value) => value === null ? '–' : `${value.toFixed(value < 1 ? 2 : 1)} ms`;
    const {p50, p99, max} = sensor.lateness_ms;
    return [
      ['Clients', sensor.clients, 'that are connected now'],
      ['Rate', rate === undefined ? '–' : `${rate.toFixed(1)} Hz`,
        'scans that are cast in a second, for drivers and for pages'],
      ['Lost', sensor.lost, 'scans that a driver did not get'],
      ['TCP', sensor.tcp || 'none'],
      ['tty', sensor.pty || 'none'],
      ['Late', `${ms(p50)}, 99 %: ${ms(p99)}, most: ${ms(max)}`, 'how long after its time a scan left'],
    ];
  }

  fact(label, value, title) {
    if (!this.values.has(label)) {
      const place = make('dd');
      this.values.set(label, place);
      this.facts.append(make('div', {title}, make('dt', {}, label), place));
    }
    tell(this.values.get(label), String(value));
  }

  updateLateness({lateness_histogram: lateness}) {
    const key = JSON.stringify(lateness);
    if (!lateness || key === this.drawn) return;
    this.drawn = key;
    this.late.replaceChildren(histogram(lateness));
  }

  updatePicture() {
    const scan = this.scans.scanOf(this.name);
    this.picture.hidden = scan?.kind !== 'picture';
    if (!this.picture.hidden) pictureOf(scan, this.picture);
  }
}
