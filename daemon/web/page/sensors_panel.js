// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What is drawn of scans, and the sensors: which of them one sees, and how each is doing. Where there are many, all but
// the chosen one are rows.
import {boundCheckbox, boundSelect, byId, make, tell} from './elements.js';
import {SensorCard} from './sensor_card.js';
import {CHOICES} from './settings.js';
import {PAINTS} from './paints.js';

// More of them are rows.
const MOST_CARDS = 4;

export class SensorsPanel {
  constructor({server, settings, status, scans, notices}) {
    Object.assign(this, {server, settings, status, scans, notices});
    this.cards = new Map();
    this.all = make('input', {type: 'checkbox', on: {change: () => scans.showAll(this.found, this.all.checked)}});
    this.search = make('input', {type: 'search', placeholder: 'Search',
      'aria-label': 'Search for names, models, states and faults',
      autocomplete: 'off', on: {input: () => this.update()}});
    this.counted = make('span', {class: 'dim'});
    byId('drawing').append(...this.choices());
    byId('sensors').before(make('div', {class: 'row sensor-tools'},
      make('label', {class: 'check', title: 'Show or hide the scans of all listed sensors'},
        this.all, make('span', {}, 'All')),
      this.counted, this.search));
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
        boundCheckbox(settings, 'rays', 'Rays', 'Of the selected sensor, green up to the hit (R)'),
        boundCheckbox(settings, 'behind', 'Continue rays (red)', 'From the hit to the maximum range, in red'),
        boundCheckbox(settings, 'fans', 'Fields of view', 'Of the other scanners (U)'),
        boundCheckbox(settings, 'points', 'Points', 'Ranges that the scanner sent (P)'),
        boundCheckbox(settings, 'truth', 'Ground truth', 'White: the true hit of each beam (V)'),
        boundCheckbox(settings, 'echoes', 'All echoes', 'Second and third echoes (E)'),
        boundCheckbox(settings, 'through', 'Through walls', 'Hidden points and rays show faintly (X)')),
    ];
  }

  get names() {
    return this.status.sensors.map(({name}) => name);
  }

  /** Names of those that the search leaves. */
  get found() {
    const sought = this.search.value.trim().toLowerCase();
    const wordsOf = ({name, model, state, faults}) => [name, model, state, ...faults].join(' ').toLowerCase();
    return this.status.sensors.filter((sensor) => wordsOf(sensor).includes(sought)).map(({name}) => name);
  }

  update() {
    const {names, found} = this;
    if (names.join('\n') !== [...this.cards.keys()].join('\n')) this.build(names);
    byId('sensors').classList.toggle('many', names.length > MOST_CARDS);
    this.search.hidden = names.length <= MOST_CARDS;
    for (const sensor of this.status.sensors) {
      const card = this.cards.get(sensor.name);
      card.element.hidden = !found.includes(sensor.name);
      card.update(sensor);
    }
    this.updateTools(found);
  }

  updateTools(found) {
    const shown = found.filter((name) => this.scans.isShown(name)).length;
    this.all.checked = shown > 0 && shown === found.length;
    this.all.indeterminate = shown > 0 && shown < found.length;
    const faulty = this.status.sensors.filter(({faults}) => faults.length).length;
    tell(this.counted, `${shown} of ${found.length}${faulty ? `, ${faulty} with faults` : ''}`);
  }

  build(names) {
    this.cards = new Map(names.map((name) => [name, new SensorCard(name, this)]));
    byId('sensors').replaceChildren(...[...this.cards.values()].map((card) => card.element));
  }
}
