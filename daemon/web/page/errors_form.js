// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The accuracy and the noise of a scanner, in its card. A change applies at once, and the scanner's clients go on; the
// daemon's answer is what is shown.
import {make} from './elements.js';
import {at} from './server.js';

const ACCURACIES = ['ideal', 'sensor', 'material'];

export class ErrorsForm {
  constructor(sensor, {server, notices}) {
    Object.assign(this, {sensor, server, notices});
    this.accuracy = this.list('accuracy', ACCURACIES);
    this.bias = this.list('bias', ['unit', 'none']);
    this.noise = make('input', {type: 'number', min: 0, max: 100, step: 'any',
      on: {change: () => this.send({noise: Number(this.noise.value)})}});
    this.interference = make('input', {type: 'checkbox',
      on: {change: () => this.send({interference: this.interference.checked})}});
    this.element = make('details', {class: 'errors', hidden: true},
      make('summary', {}, 'Accuracy and noise'),
      this.field('Accuracy', this.accuracy, 'ideal: no errors; sensor: by the range; material: by the returned light'),
      this.field('Noise ×', this.noise, 'noise scale factor relative to the model'),
      this.field('Bias', this.bias, 'range bias: that of this unit, or none'),
      make('label', {class: 'check', title: 'Disturbance by scanners that face this one'},
        this.interference, make('span', {}, 'Interference')));
  }

  list(key, words) {
    const list = make('select', {}, ...words.map((word) => make('option', {value: word}, word)));
    list.addEventListener('change', () => this.send({[key]: list.value}));
    return list;
  }

  field(label, input, title) {
    return make('label', {class: 'field', title}, make('span', {}, label), input);
  }

  async send(change) {
    this.sent = change;
    try {
      this.show(await this.server.request('PATCH', at('/sensors/', this.sensor), change)
        .then((answer) => answer.json()));
    } catch (error) {
      this.notices.trouble(`${this.sensor}: ${error.message}`);
      this.show(this.known);
    }
  }

  /** Null of a camera or a ranger. */
  update(errors) {
    this.element.hidden = !errors;
    if (errors) this.show(errors);
  }

  show(errors) {
    this.known = errors;
    if (!this.isWritten(this.accuracy, 'accuracy')) this.accuracy.value = errors.accuracy;
    if (!this.isWritten(this.noise, 'noise')) this.noise.value = errors.noise;
    if (!this.isWritten(this.bias, 'bias')) this.bias.value = typeof errors.bias === 'string' ? errors.bias : '';
    this.interference.checked = errors.interference;
  }

  /** Whether somebody writes in this input just now, and has not sent it: then no answer of the daemon may undo it. */
  isWritten(input, key) {
    return input === document.activeElement && String(this.sent?.[key]) !== input.value;
  }
}
