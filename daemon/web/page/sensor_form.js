// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Adds a scanner, on a robot that is there or on a new one. The daemon checks what is asked for, and its words say what
// is wrong.
import {byId, make, tell} from './elements.js';
import {usable} from './addresses.js';

const RAD = Math.PI / 180;
const MOUNT = {x: 0, y: 0, z: 0.25, yaw: 0};

export class SensorForm {
  constructor({server, status, scans, settings, notices, viewpoint}) {
    Object.assign(this, {server, status, scans, settings, notices, viewpoint});
    this.mount = numbersIn(byId('sensor-mount'), MOUNT);
    this.pose = numbersIn(byId('sensor-pose'), {x: 0, y: 0, yaw: 0});
    byId('new-sensor').addEventListener('toggle', () => this.open());
    byId('sensor-robot').addEventListener('input', () => this.update());
    byId('sensor-form').addEventListener('submit', (event) => {
      event.preventDefault();
      this.add();
    });
  }

  get robots() {
    return [...new Set(this.status.sensors.map(({name}) => name.split('/')[0]))];
  }

  async open() {
    if (!byId('new-sensor').open) return;
    byId('sensor-robots').replaceChildren(...this.robots.map((name) => make('option', {value: name})));
    const {target} = this.viewpoint;
    this.pose.x.value = target.x.toFixed(1);
    this.pose.y.value = target.y.toFixed(1);
    if (!byId('sensor-robot').value) byId('sensor-robot').value = this.robots[0] || '';
    this.update();
    if (byId('sensor-model').options.length) return;
    try {
      const models = await this.server.get('/sensors/models');
      this.models = new Map(models.map((model) => [model.name, model]));
      byId('sensor-model').append(...models.map((model) => make('option', {value: model.name}, textOf(model))));
      byId('sensor-model').addEventListener('change', () => this.tellModel());
      byId('sensor-model').value = models.find(({name}) => name.startsWith('UST-10LX@'))?.name || models[0].name;
      this.tellModel();
    } catch (error) {
      this.tellTrouble(error.message);
    }
  }

  /** A robot that is there stands where it stands. */
  get isNew() {
    const robot = byId('sensor-robot').value.trim();
    return robot !== '' && !this.robots.includes(robot);
  }

  update() {
    byId('sensor-pose').hidden = !this.isNew;
  }

  tellModel() {
    const {steps, rate_hz, links} = this.models.get(byId('sensor-model').value);
    tell(byId('sensor-facts'), `${steps} steps, ${Number(rate_hz.toFixed(1))} Hz, ${links}`);
  }

  tellTrouble(text) {
    byId('sensor-trouble').hidden = !text;
    tell(byId('sensor-trouble'), text);
  }

  get wanted() {
    const {mount, pose} = this;
    const wanted = {
      name: `${byId('sensor-robot').value.trim()}/${byId('sensor-name').value.trim()}`,
      model: byId('sensor-model').value,
      tcp: byId('sensor-tcp').value.trim() || 'none',
      pty: byId('sensor-pty').checked ? 'auto' : 'none',
      mount: {xyz: [+mount.x.value, +mount.y.value, +mount.z.value], rpy: [0, 0, mount.yaw.value * RAD]},
    };
    if (this.isNew) wanted.pose = {xyz: [+pose.x.value, +pose.y.value, 0], rpy: [0, 0, pose.yaw.value * RAD]};
    return wanted;
  }

  async add() {
    this.tellTrouble('');
    try {
      const {sensor, warnings} = await this.server.post('/sensors', this.wanted);
      await this.status.ask();
      this.scans.show(sensor.name, true);
      this.settings.set('sensor', sensor.name);
      byId('sensor-name').value = '';
      byId('new-sensor').open = false;
      const places = [sensor.tcp && usable(sensor.tcp), sensor.pty].filter(Boolean);
      this.notices.tell(places.length ? `${sensor.name} is at ${places.join(' and ')}.` : `${sensor.name} is there.`);
      for (const warning of warnings) this.notices.trouble(warning);
    } catch (error) {
      this.tellTrouble(error.message);
    }
  }
}

function textOf({name, range_m: [, most_m]}) {
  return `${name}, ${most_m} m`;
}

/** Inputs for metres, and degrees of yaw. */
function numbersIn(element, values) {
  const inputs = {};
  for (const [name, value] of Object.entries(values)) {
    inputs[name] = make('input', {type: 'number', step: 'any', value: String(value), required: true});
    element.append(make('label', {}, make('span', {}, name), inputs[name],
      make('span', {}, name === 'yaw' ? '°' : 'm')));
  }
  return inputs;
}
