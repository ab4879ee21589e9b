// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A scenario, which is a file of many faults: opened or dropped, how far it is, and how it is stopped.
import {byId, make, tell} from './elements.js';

const BETWEEN_MS = 1000;

export class ScenarioCard {
  constructor({server, settings, notices}) {
    Object.assign(this, {server, settings, notices});
    // Who asks for a scenario where there is none is answered 404, of which browsers complain.
    this.isThere = false;
    const file = byId('scenario-file');
    byId('scenario-open').addEventListener('click', () => {
      file.value = '';
      file.click();
    });
    file.addEventListener('change', () => file.files[0] && this.run(file.files[0]));
    byId('scenario-stop').addEventListener('click', () => this.stop());
    settings.watch('panel', () => this.refresh());
    setInterval(() => this.refresh(), BETWEEN_MS);
  }

  static takes(file) {
    return /\.ya?ml$/i.test(file.name);
  }

  /** The faults of a file are told with their lines, and none of it begins then. */
  async run(file) {
    this.settings.set('panel', 'faults');
    this.tellTroubles([]);
    try {
      const {steps} = await this.server.put('/scenario', {name: file.name, yaml: await file.text()});
      this.isThere = true;
      this.notices.tell(`${file.name} started: ${steps.length} ${steps.length === 1 ? 'fault' : 'faults'}.`);
    } catch (error) {
      this.tellTroubles([`${file.name} cannot start.`, ...troublesOf(error)]);
    }
    await this.refresh();
  }

  tellTroubles(lines) {
    byId('scenario-trouble').hidden = !lines.length;
    byId('scenario-trouble').replaceChildren(...lines.map((line) => make('div', {}, line)));
  }

  async stop() {
    await this.server.remove('/scenario').catch((error) => this.notices.trouble(error.message));
    await this.refresh();
  }

  async refresh() {
    if (this.settings.get('panel') !== 'faults' || document.hidden) return;
    if (!this.isThere) return;
    const scenario = await this.server.get('/scenario').catch(() => null);
    this.isThere = scenario !== null;
    if (scenario) this.show(scenario);
  }

  show(scenario) {
    byId('scenario-stop').hidden = scenario.state !== 'running';
    const count = (state) => scenario.steps.filter((step) => step.state === state).length;
    tell(byId('scenario-state'), `${scenario.name}: ${count('waiting')} pending, ${count('active')} active, ` +
      `${count('ended')} ended`);
  }
}

function troublesOf({errors, message}) {
  return errors?.length ? errors : [message];
}
