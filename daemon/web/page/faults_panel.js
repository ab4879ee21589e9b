// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Injected faults: common ones by their names, a form that starts any fault, those pending or active, and their log.
import {byId, make, tell} from './elements.js';
import {FaultBar} from './fault_bar.js';
import {FAULT_EXAMPLES} from './fault_examples.js';
import {FAULT_FIELDS} from './fault_fields.js';
import {faultInput} from './fault_inputs.js';
import {FAULT_PRESETS} from './fault_presets.js';
import {at} from './server.js';

const MOST_LINES = 200;
const BETWEEN_MS = 1000;
// Log entries of one fault that follow each other faster than this are one line with a count.
const REPEATS_S = 2;
// Of a UST-10LX.
const USUAL_FRONT = 540;

export class FaultsPanel {
  constructor({server, settings, status, connection, notices, scenario}) {
    Object.assign(this, {server, settings, status, notices, scenario});
    this.kinds = [];
    this.inputs = new Map();
    this.lines = new Map();
    this.bar = new FaultBar(byId('fault-bar'), server);
    this.kind = byId('fault-kind');
    this.sensor = byId('fault-sensor');
    this.fields = byId('fault-members');
    this.kind.addEventListener('change', () => this.showMembers());
    this.sensor.addEventListener('change', () => settings.set('sensor', this.sensor.value));
    byId('fault-form').addEventListener('submit', (event) => this.start(event));
    byId('fault-presets').append(...FAULT_PRESETS.map((preset) => this.presetButton(preset)));
    byId('fault-unit').addEventListener('change', () => this.tellUntil());
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
    this.inputs = new Map(kind.members.map((member) =>
      [member, faultInput(member, FAULT_FIELDS[kind.kind][member], examples[member])]));
    this.fields.replaceChildren(...[...this.inputs.values()].map(({element}) => element));
    byId('fault-unit').value = 's';
    byId('fault-for').value = kind.momentary ? '' : '5';
    this.tellUntil();
  }

  /** Until a boot takes no number. */
  tellUntil() {
    const length = byId('fault-for');
    length.disabled = byId('fault-unit').value === 'RB';
    length.step = byId('fault-unit').value === 'scans' ? 1 : 'any';
  }

  presetButton(preset) {
    const click = () => this.startPreset(preset);
    return make('button', {type: 'button', title: preset.about, on: {click}}, preset.name);
  }

  request() {
    const body = {kind: this.kind.value};
    for (const [member, input] of this.inputs) {
      const value = input.value();
      if (value !== undefined) body[member] = value;
    }
    const unit = byId('fault-unit').value;
    const length = Number(byId('fault-for').value);
    if (unit === 'RB') body.until = 'RB';
    else if (length > 0) body.for = {[unit]: length};
    const later_s = Number(byId('fault-at').value);
    if (later_s > 0) body.at = {s: later_s};
    return body;
  }

  async start(event) {
    event.preventDefault();
    const trouble = byId('fault-trouble');
    trouble.hidden = true;
    try {
      const answer = await this.post(this.sensor.value, this.request());
      const when = Number(byId('fault-at').value) > 0 ? 'scheduled' : 'started';
      this.notices.tell([`Fault ${answer.id} ${when}.`, ...(answer.notes || [])].join(' '));
    } catch (error) {
      trouble.textContent = error.message;
      trouble.hidden = false;
    }
    await this.refresh();
  }

  post(sensor, body) {
    return this.server.post(at('/sensors/', sensor, '/faults'), body);
  }

  async startPreset({name, about, faults}) {
    const sensor = this.sensor.value;
    const hasTty = Boolean(this.status.sensor(sensor)?.pty);
    try {
      for (const {tty, ...fault} of faults(await this.front(sensor))) {
        if (hasTty || !tty) await this.post(sensor, fault);
      }
      this.notices.tell(`${name}: ${about}.`);
    } catch (error) {
      this.notices.trouble(`${name}: ${error.message}`);
    }
    await this.refresh();
  }

  /** The step in the middle of the latest scan. */
  async front(sensor) {
    const truth = await this.server.get(at('/sensors/', sensor, '/truth')).catch(() => null);
    return truth?.steps?.[Math.floor(truth.steps.length / 2)] ?? USUAL_FRONT;
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
    this.bar.refresh(sensor, this.status.latest?.time_s ?? 0);
    const list = await this.server.get(at('/sensors/', sensor, '/faults')).catch(() => null);
    if (list?.some((fault) => fault.scenario_step !== null)) this.scenario.isThere = true;
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
      make('div', {class: 'small dim'}, wordsOf(rest)));
  }

  log({sensor, id, kind, what, scan, time_s}) {
    const key = `${sensor} ${id} ${['begins', 'ends'].includes(what) ? what : ''}`;
    const last = this.lines.get(key);
    if (last?.element.isConnected && time_s >= last.time_s && time_s - last.time_s < REPEATS_S) {
      last.count += 1;
      last.time_s = time_s;
      tell(last.counter, ` × ${last.count}, to ${time_s.toFixed(2)} s, scan ${scan} `);
      return;
    }
    const list = byId('fault-log');
    const counter = make('span', {class: 'count'});
    const element = make('li', {}, make('span', {class: 'dim'}, `${time_s.toFixed(2)} s, scan ${scan} `),
      make('strong', {}, kind), ` ${what}`, counter, make('span', {class: 'dim'}, ` ${sensor}`));
    this.lines.set(key, {element, counter, count: 1, time_s});
    list.prepend(element);
    if (list.children.length > MOST_LINES) list.lastChild.remove();
  }
}

/** {how: 'silent', steps: [500, 580], for: {s: 3}} as "how: silent, steps 500–580, for 3 s". */
function wordsOf(fault) {
  return Object.entries(fault).map(([name, value]) => memberWords(name, value)).join(', ') || 'no parameters';
}

const TIMES = ['for', 'every', 'jitter', 'until'];

function memberWords(name, value) {
  if (name === 'at' && value?.s !== undefined) return `begins after ${value.s} s`;
  if (name === 'steps' && Array.isArray(value)) return `steps ${value.join('–')}`;
  if (name === 'reads' || TIMES.includes(name)) return `${name} ${textOf(value)}`;
  return value === true ? name : `${name}: ${textOf(value)}`;
}

function textOf(value) {
  if (Array.isArray(value)) return value.map(textOf).join(' ');
  if (value === null || typeof value !== 'object') return String(value);
  return Object.entries(value).map(([unit, part]) => ['s', 'scans'].includes(unit)
    ? `${part} ${unit}` : `${unit} ${textOf(part)}`).join(' ');
}
