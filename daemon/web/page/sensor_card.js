// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The state of one sensor, and the check box that shows its scans. Among many sensors it is a row until it is chosen.
import {ErrorsForm} from './errors_form.js';
import {reach, usable} from './addresses.js';
import {css} from './colours.js';
import {histogram} from './histogram.js';
import {ask} from './ask_dialog.js';
import {at} from './server.js';
import {make, tell} from './elements.js';
import {pictureOf} from './picture.js';

const STATE_KINDS = {streaming: 'good', measuring: 'good', error: 'bad', booting: 'busy'};

export class SensorCard {
  constructor(name, panel) {
    const {server, notices, settings, scans, status} = panel;
    Object.assign(this, {name, server, notices, settings, scans, status});
    this.errors = new ErrorsForm(name, panel);
    this.box = make('input', {type: 'checkbox', 'aria-label': `Show the scans of ${name}`});
    this.box.addEventListener('change', () => scans.show(name, this.box.checked));
    this.title = make('button', {class: 'name', title: 'Select it for the other panels',
      on: {click: () => settings.set('sensor', name)}}, name);
    this.swatch = make('span', {class: 'swatch circle'});
    this.state = make('span', {class: 'chip'});
    this.faults = make('span', {class: 'row faults'});
    this.brief = make('p', {class: 'brief dim small'});
    this.model = make('span', {class: 'dim'});
    this.facts = make('dl', {class: 'facts'});
    this.values = new Map();
    this.warning = make('p', {class: 'warning', hidden: true});
    this.latency = make('div');
    this.picture = make('canvas', {class: 'picture', hidden: true});
    this.away = make('button', {class: 'danger', on: {click: () => this.remove()}}, 'Remove sensor…');
    this.element = make('section', {class: 'card sensor'},
      make('div', {class: 'row'}, this.box, this.swatch, this.title, this.faults, this.state),
      this.brief, make('div', {class: 'whole'},
        this.model, this.warning, this.facts, this.errors.element, this.picture, this.latency,
        this.away));
  }

  async remove() {
    const why = 'Its clients are disconnected. A robot is removed with its last sensor. This cannot be undone.';
    if (!await ask(`Remove ${this.name}?`, why, 'Remove')) return;
    try {
      await this.server.remove(at('/sensors/', this.name));
      await this.status.ask();
    } catch (error) {
      this.notices.trouble(`${this.name}: ${error.message}`);
    }
  }

  update(sensor) {
    this.box.checked = this.scans.isShown(this.name);
    this.element.classList.toggle('chosen', this.settings.get('sensor') === this.name);
    this.title.setAttribute('aria-pressed', this.settings.get('sensor') === this.name);
    this.swatch.style.background = css(this.scans.colourOf(this.name));
    tell(this.state, sensor.state);
    this.state.className = `chip ${STATE_KINDS[sensor.state] || ''}`;
    this.updateFaults([...new Set(sensor.faults)]);
    tell(this.brief, this.briefOf(sensor));
    tell(this.model, `${sensor.model}, by ${sensor.backend}`);
    this.warning.hidden = !sensor.warning;
    tell(this.warning, sensor.warning || '');
    for (const [label, value, title] of this.factsOf(sensor)) this.fact(label, value, title);
    this.errors.update(sensor.errors);
    this.away.disabled = this.status.sensors.length === 1;
    this.away.title = this.away.disabled ? 'The last sensor cannot be removed' : '';
    this.updateLatency(sensor);
    this.updatePicture();
  }

  /** A scanner that something is done to is in no state that one could rely on. */
  updateFaults(kinds) {
    this.state.hidden = kinds.length > 0;
    this.element.classList.toggle('faulty', kinds.length > 0);
    if (kinds.join() === this.acting) return;
    this.acting = kinds.join();
    this.faults.replaceChildren(...kinds.map((kind) =>
      make('span', {class: 'chip bad', title: `Fault ${kind} is active`}, kind)));
  }

  get sentRate() {
    return hertz(this.status.rates.sent.get(this.name));
  }

  briefOf({clients, waiting, lost, lateness_ms: {p99}}) {
    const sent = clients ? `${this.sentRate} to ${clients === 1 ? 'a client' : `${clients} clients`}` : 'no client';
    return [sent, ...waiting.length ? [`${waiting.length} waiting`] : [], ...p99 === null ? [] : [`${ms(p99)} late`],
      `${lost} lost`].join(' · ');
  }

  factsOf(sensor) {
    const {p50, p99, max} = sensor.lateness_ms;
    return [
      ['Clients', clientsOf(sensor), 'a scanner serves one TCP client at a time; the next ones wait'],
      ['Rate', sensor.clients ? this.sentRate : '–', 'scans per second to drivers'],
      ['Lost', sensor.lost, 'scans that a driver missed'],
      ['Cast', hertz(this.status.rates.scans.get(this.name)), 'scans cast per second, for drivers and pages'],
      ['TCP', sensor.tcp ? usable(sensor.tcp) : 'none', sensor.tcp && reach(sensor.tcp)],
      ['tty', sensor.pty || 'none'],
      ['Latency', `median ${ms(p50)}, 99th pct ${ms(p99)}, max ${ms(max)}`, 'delay of scans after their due time'],
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

  /** Hidden while there is no client, since no scan leaves then. */
  updateLatency({clients, lateness_histogram: lateness}) {
    this.latency.hidden = this.values.get('Latency').parentElement.hidden = clients === 0;
    const key = JSON.stringify(lateness);
    if (!lateness || key === this.drawn) return;
    this.drawn = key;
    this.latency.replaceChildren(histogram(lateness));
  }

  updatePicture() {
    const scan = this.scans.scanOf(this.name);
    this.picture.hidden = scan?.kind !== 'picture';
    if (!this.picture.hidden) pictureOf(scan, this.picture);
  }
}

/** The client that waits next is named: scipd has accepted its connection, and it gets no answer. */
function clientsOf({clients, waiting: [next, ...others]}) {
  if (!next) return clients;
  const more = others.length ? ` and ${others.length} more` : '';
  return `${clients} connected, ${others.length + 1} waiting: ${next}${more}`;
}

function ms(value) {
  return value === null ? '–' : `${value.toFixed(value < 1 ? 2 : 1)} ms`;
}

function hertz(rate) {
  return rate === undefined ? '–' : `${rate.toFixed(1)} Hz`;
}
