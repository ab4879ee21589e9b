// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Faults on purpose: a form that starts one, those that wait or act, and what they did.
import {byId, make, tell} from './elements.js';
import {FAULT_EXAMPLES} from './fault_examples.js';
import {at} from './server.js';

const MOST_LINES = 200;
const BETWEEN_MS = 1000;

export class FaultsPanel {
  constructor({server, settings, status, connection, notices}) {
    Object.assign(this, {server, settings, notices});
    this.kinds = [];
    this.kind = byId('fault-kind');
    this.sensor = byId('fault-sensor');
    this.fields = byId('fault-members');
    this.kind.addEventListener('change', () => this.showMembers());
    this.sensor.addEventListener('change', () => settings.set('sensor', this.sensor.value));
    byId('fault-form').addEventListener('submit', (event) => this.start(event));
    byId('fault-stop-all').addEventListener('click', () => this.stopAll());
    status.addEventListener('changed', () => this.offer(status.sensors));
    settings.watch('sensor', (name) => {
      this.sensor.value = name;
      this.refresh();
    });
    settings.watch('panel', () => this.refresh());
    connection.addEventListener('text', (event) => event.detail.faults?.forEach((fault) => this.log(fault)));
    connection.addEventListener('open', () => this.loadKinds());
    setInterval(() => this.refresh(), BETWEEN_MS);
  }

  get isSeen() {
    return this.settings.get('panel') === 'faults' && !document.hidden;
  }

  async loadKinds() {
    this.kinds = await this.server.get('/faults/kinds').catch(() => []);
    const layers = new Map();
    for (const kind of this.kinds) {
      if (!layers.has(kind.layer)) layers.set(kind.layer, make('optgroup', {label: kind.layer}));
      layers.get(kind.layer).append(make('option', {value: kind.kind}, kind.kind));
    }
    const chosen = this.kind.value;
    this.kind.replaceChildren(...layers.values());
    if (chosen) this.kind.value = chosen;
    this.showMembers();
  }

  offer(sensors) {
    const names = sensors.filter(({tcp, pty}) => tcp || pty).map(({name}) => name);
    if (names.join('\n') !== this.offered) {
      this.offered = names.join('\n');
      this.sensor.replaceChildren(...names.map((name) => make('option', {value: name}, name)));
    }
    this.sensor.value = this.settings.get('sensor');
  }

  showMembers() {
    const kind = this.kinds.find((each) => each.kind === this.kind.value);
    if (!kind) return;
    tell(byId('fault-summary'), `${kind.summary}${kind.momentary ? ' (momentary)' : ''}`);
    const examples = FAULT_EXAMPLES[kind.kind] || {};
    this.fields.replaceChildren(...kind.members.map((member) => make('label', {class: 'field'},
      make('span', {}, member),
      make('input', {name: member, autocomplete: 'off', spellcheck: 'false',
        value: member in examples ? textOf(examples[member]) : '',
        placeholder: 'default'}))));
    byId('fault-for').value = kind.momentary ? '' : '5';
  }

  request() {
    const body = {kind: this.kind.value};
    for (const input of this.fields.querySelectorAll('input')) {
      if (input.value.trim()) body[input.name] = valueOf(input.value.trim());
    }
    const length = Number(byId('fault-for').value);
    if (length > 0) body.for = {[byId('fault-unit').value]: length};
    const later_s = Number(byId('fault-at').value);
    if (later_s > 0) body.at = {s: later_s};
    return body;
  }

  async start(event) {
    event.preventDefault();
    const trouble = byId('fault-trouble');
    trouble.hidden = true;
    try {
      const answer = await this.server.post(at('/sensors/', this.sensor.value, '/faults'), this.request());
      this.notices.tell([`Fault ${answer.id} is asked for.`, ...(answer.notes || [])].join(' '));
    } catch (error) {
      trouble.textContent = error.message;
      trouble.hidden = false;
    }
    await this.refresh();
  }

  async stop(id) {
    await this.server.remove(at('/sensors/', this.settings.get('sensor'), `/faults/${id}`))
      .catch((error) => this.notices.trouble(error.message));
    await this.refresh();
  }

  async stopAll() {
    await this.server.remove(at('/sensors/', this.settings.get('sensor'), '/faults'))
      .catch((error) => this.notices.trouble(error.message));
    await this.refresh();
  }

  async refresh() {
    const sensor = this.settings.get('sensor');
    if (!this.isSeen || !sensor) return;
    const list = await this.server.get(at('/sensors/', sensor, '/faults')).catch(() => null);
    const key = sensor + JSON.stringify(list);
    if (list === null || key === this.drawn) return;
    this.drawn = key;
    byId('faults-none').hidden = list.length > 0;
    byId('fault-stop-all').hidden = list.length === 0;
    byId('faults').replaceChildren(...[...list].reverse().map((fault) => this.row(fault)));
  }

  row({id, kind, state, hits, fault}) {
    const {kind: _, ...rest} = fault;
    return make('li', {class: 'card'},
      make('div', {class: 'row'}, make('strong', {}, kind),
        make('span', {class: `chip ${state === 'active' ? 'bad' : ''}`}, state),
        make('span', {class: 'dim'}, hits === 1 ? 'acted once' : `acted ${hits} times`),
        make('button', {'aria-label': `Stop fault ${id}, ${kind}`, on: {click: () => this.stop(id)}},
          state === 'ended' ? 'Forget' : 'Stop')),
      make('code', {class: 'small'}, JSON.stringify(rest)));
  }

  log(fault) {
    const list = byId('fault-log');
    list.prepend(make('li', {},
      make('span', {class: 'dim'}, `${fault.time_s.toFixed(2)} s, scan ${fault.scan} `),
      make('strong', {}, fault.kind), ` ${fault.what} `,
      make('span', {class: 'dim'}, fault.sensor)));
    if (list.children.length > MOST_LINES) list.lastChild.remove();
  }
}

/** Lists, objects and numbers as JSON has them; all else is a word. */
function valueOf(text) {
  try {
    return JSON.parse(text);
  } catch {
    return text;
  }
}

function textOf(value) {
  return typeof value === 'string' ? value : JSON.stringify(value);
}
