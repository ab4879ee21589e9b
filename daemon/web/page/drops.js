// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Files that are dropped on the view or on the panels: scenarios begin, meshes are added where they were dropped.
import {byId} from './elements.js';
import {ScenarioCard} from './scenario_card.js';

export class Drops {
  constructor({addDialog, scenario, placing}) {
    Object.assign(this, {addDialog, scenario, placing});
    this.watch(byId('view'));
    this.watch(byId('panel-faults'));
  }

  watch(target) {
    target.addEventListener('dragover', (event) => {
      event.preventDefault();
      target.classList.add('dropping');
    });
    target.addEventListener('dragleave', () => target.classList.remove('dropping'));
    target.addEventListener('drop', (event) => {
      event.preventDefault();
      target.classList.remove('dropping');
      this.take(event.dataTransfer.files[0], event);
    });
  }

  take(file, event) {
    if (!file) return;
    if (ScenarioCard.takes(file)) this.scenario.run(file);
    else this.addDialog.ask(file, this.placing.placeUnder(event));
  }
}
