// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Fog, rain, snow and dust, and the accuracy of all scanners at once: the air affects those whose accuracy is material.
// Media that were made elsewhere, with a box or numbers of their own, stay as they are until they are removed.
import {byId, make, tell} from './elements.js';
import {at} from './server.js';

const VISIBILITY = {member: 'visibility_m', unit: 'm', about: 'visibility', least: 0.5, most: 100_000};
const WATER = {member: 'mm_per_hour', unit: 'mm/h', about: 'precipitation', least: 0, most: 500};
const KINDS = {
  fog: {...VISIBILITY, usual: 20},
  dust: {...VISIBILITY, usual: 30},
  rain: {...WATER, usual: 20},
  snow: {...WATER, usual: 2},
};

export class AirCard {
  constructor({server, status, settings, notices}) {
    Object.assign(this, {server, status, notices});
    this.media = [];
    byId('air-add').addEventListener('click', () => this.add());
    byId('air-accuracy').addEventListener('change', (event) => this.setAccuracy(event.target.value));
    settings.watch('panel', (panel) => panel === 'world' && this.refresh());
    if (settings.get('panel') === 'world') this.refresh();
  }

  async refresh() {
    this.show(await this.server.get('/scene/media').catch(() => this.media));
  }

  add() {
    const free = Object.keys(KINDS).find((kind) => !this.media.some((medium) => medium.name === kind));
    const kind = free ?? 'fog';
    const medium = {kind, [KINDS[kind].member]: KINDS[kind].usual};
    if (!free) medium.name = `${kind} ${this.media.length + 1}`;
    this.put([...this.media, medium]);
  }

  async put(media) {
    const before = this.media;
    // Whoever changes something else before the answer is here changes this list.
    this.show(media);
    try {
      const {notes = []} = await this.server.put('/scene/media', media);
      for (const note of notes) this.notices.tell(note);
    } catch (error) {
      this.media = before;
      this.notices.trouble(`The air is unchanged: ${error.message}`);
    }
    await this.refresh();
  }

  show(media) {
    this.media = media;
    tell(byId('air-state'), media.map(({name, kind}) => `'${name ?? kind}'`).join(', ') || 'none');
    byId('air').replaceChildren(...media.map((medium, i) => this.row(medium, i)));
  }

  row(medium, i) {
    const name = medium.name ?? medium.kind;
    const others = this.media.filter((_, k) => k !== i);
    const remove = make('button', {'aria-label': `Remove ${name}`, on: {click: () => this.put(others)}}, 'Remove');
    const known = KINDS[medium.kind];
    if (!known || medium.box) {
      return make('li', {class: 'row'}, make('span', {}, `${name}${medium.box ? ' in a box' : ''}`), remove);
    }
    const change = (changed) => this.put(this.media.map((each, k) => k === i ? changed : each));
    const kinds = make('select', {'aria-label': `Kind of ${name}`,
      on: {change: () => change({kind: kinds.value, [KINDS[kinds.value].member]: KINDS[kinds.value].usual})}},
    ...Object.keys(KINDS).map((kind) => make('option', {value: kind}, kind)));
    kinds.value = medium.kind;
    const amount = make('input', {type: 'number', min: known.least, max: known.most, step: 'any', required: true,
      'aria-label': `${name}: ${known.about}, in ${known.unit}`, title: known.about, value: medium[known.member],
      on: {change: () => change({...medium, [known.member]: amount.valueAsNumber})}});
    return make('li', {class: 'row'}, kinds, amount, make('span', {class: 'dim'}, known.unit), remove);
  }

  async setAccuracy(accuracy) {
    const scanners = this.status.sensors.filter(({errors}) => errors);
    for (const {name} of scanners) {
      await this.server.request('PATCH', at('/sensors/', name), {accuracy})
        .catch((error) => this.notices.trouble(`${name}: ${error.message}`));
    }
    byId('air-accuracy').selectedIndex = 0;
    this.notices.tell(`Accuracy of ${scanners.length === 1 ? 'the scanner' : 'all scanners'}: ${accuracy}.`);
    await this.status.ask();
  }
}
