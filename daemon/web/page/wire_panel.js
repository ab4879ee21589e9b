// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The conversation between a scanner and its clients: each request and reply as it went by, and what it means. Scans of
// a stream that follow each other are one entry that counts.
import {Connection} from './connection.js';
import {byId, make, tell} from './elements.js';

const MOST_ENTRIES = 400;
const GOOD = ['00', '99', '02', '03', '0'];

export class WirePanel {
  constructor({server, settings, status, connection}) {
    Object.assign(this, {server, settings});
    this.list = byId('wire');
    this.connection = null;
    this.paused = false;
    this.streams = new Map();
    this.buildControls();
    settings.watch('panel', () => this.listen());
    settings.watch('sensor', (name) => {
      this.choice.value = name;
      this.listen();
    });
    status.addEventListener('changed', () => this.offer(status.sensors));
    connection.addEventListener('text', (event) => event.detail.faults?.forEach((fault) => this.takeFault(fault)));
    this.listen();
  }

  buildControls() {
    this.pause = byId('wire-pause');
    this.pause.addEventListener('click', () => {
      this.paused = !this.paused;
      this.pause.setAttribute('aria-pressed', this.paused);
      tell(this.pause, this.paused ? 'Resume' : 'Pause');
    });
    byId('wire-clear').addEventListener('click', () => this.clear());
    this.filter = byId('wire-filter');
    this.filter.addEventListener('input', () => this.filterAll());
    this.collapse = byId('wire-collapse');
    this.choice = byId('wire-sensor');
    this.choice.addEventListener('change', () => this.settings.set('sensor', this.choice.value));
  }

  offer(sensors) {
    const names = sensors.filter(({tcp, pty}) => tcp || pty).map(({name}) => name);
    if (names.join('\n') !== this.offered) {
      this.offered = names.join('\n');
      this.choice.replaceChildren(...names.map((name) => make('option', {value: name}, name)));
    }
    this.choice.value = this.settings.get('sensor');
  }

  /** Only while the panel is seen: nobody listens for nothing. */
  listen() {
    const sensor = this.settings.get('panel') === 'wire' ? this.settings.get('sensor') : '';
    if (sensor === this.listened) return;
    this.listened = sensor;
    this.connection?.close();
    this.connection = null;
    if (!sensor) return;
    this.clear();
    this.connection = new Connection(this.server, `/wire?sensor=${encodeURIComponent(sensor)}`);
    this.connection.addEventListener('text', (event) => this.take(event.detail));
    this.connection.open();
  }

  clear() {
    this.list.replaceChildren();
    this.streams.clear();
    byId('wire-none').hidden = false;
  }

  take(message) {
    if (this.paused) return;
    byId('wire-none').hidden = true;
    if (message.dropped) this.add(make('li', {class: 'dim'}, `${message.dropped} messages were dropped`));
    if (this.collapse.checked && this.joins(message)) return;
    this.show(message);
  }

  /** What a fault takes away whole is on no wire, so the fault itself is told where it acts. */
  takeFault(fault) {
    if (!this.connection || this.paused || fault.sensor !== this.listened) return;
    byId('wire-none').hidden = true;
    if (this.collapse.checked && this.fault?.id === fault.id && this.fault.entry.isConnected) {
      this.fault.count += 1;
      tell(this.fault.counter, `× ${this.fault.count}`);
      return;
    }
    this.showFault(fault);
  }

  showFault({id, kind, what, time_s}) {
    const counter = make('span', {class: 'dim count'});
    const entry = make('li', {class: 'fault'},
      make('div', {class: 'row'}, make('span', {class: 'chip bad'}, `fault ${kind}`), counter),
      make('div', {class: 'means'}, what),
      make('div', {class: 'dim small'}, `${time_s.toFixed(3)} s`));
    entry.dataset.text = `fault ${kind} ${what}`.toLowerCase();
    this.add(entry);
    this.fault = {id, entry, counter, count: 1};
  }

  /** True if it goes on with a stream that is the last entry of its client. */
  joins(message) {
    const stream = this.streams.get(message.client);
    if (message.scan === null || message.scan === undefined) {
      this.streams.delete(message.client);
      return false;
    }
    if (!stream || stream.code !== codeOf(message) || !stream.entry.isConnected) return false;
    stream.count += 1;
    tell(stream.counter, `× ${stream.count}, to scan ${message.scan}`);
    return true;
  }

  show(message) {
    this.fault = null;
    const counter = make('span', {class: 'dim count'});
    const isFromClient = message.from === 'client';
    const entry = make('li', {class: isFromClient ? 'request' : 'reply'},
      make('div', {class: 'row'},
        make('span', {class: 'arrow', 'aria-label': isFromClient ? 'from the client' : 'from the scanner'},
          isFromClient ? '→' : '←'),
        make('code', {}, message.line),
        statusChip(message),
        counter),
      make('div', {class: 'means'}, message.means || ''),
      message.explains && !isGood(message.status)
        ? make('div', {class: 'explains'}, message.explains) : null,
      make('div', {class: 'dim small'},
        `${message.time_s.toFixed(3)} s, ${message.bytes} bytes, ${message.client}`));
    entry.dataset.text = `${message.line} ${message.means} ${message.explains || ''}`.toLowerCase();
    this.add(entry);
    if (message.scan !== null && message.scan !== undefined) {
      this.streams.set(message.client, {entry, counter, count: 1, code: codeOf(message)});
    }
  }

  add(entry) {
    const atEnd = this.list.scrollHeight - this.list.scrollTop - this.list.clientHeight < 40;
    entry.hidden = !this.fits(entry);
    this.list.append(entry);
    if (this.list.children.length > MOST_ENTRIES) this.list.firstChild.remove();
    if (atEnd) this.list.scrollTop = this.list.scrollHeight;
  }

  fits(entry) {
    const wish = this.filter.value.trim().toLowerCase();
    return !wish || (entry.dataset.text || '').includes(wish);
  }

  filterAll() {
    for (const entry of this.list.children) entry.hidden = !this.fits(entry);
  }
}

function codeOf(message) {
  return message.line.slice(0, 2);
}

function isGood(status) {
  return GOOD.includes(status);
}

function statusChip({status}) {
  if (status === null || status === undefined) return null;
  return make('span', {class: `chip ${isGood(status) ? 'good' : 'bad'}`}, `status ${status}`);
}
