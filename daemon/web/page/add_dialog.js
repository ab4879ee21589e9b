// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Asks what a mesh file does not say: its unit and its material. Files come by drop or by a button.
import {byId, make} from './elements.js';
import {FORMATS} from './edits.js';

export class AddDialog {
  constructor(edits, world) {
    this.edits = edits;
    this.world = world;
    this.dialog = byId('add-dialog');
    this.input = byId('mesh-file');
    this.input.accept = FORMATS.map((format) => `.${format}`).join();
    this.input.addEventListener('change', () => this.ask(this.input.files[0]));
    byId('add-form').addEventListener('submit', () => this.add());
    byId('add-cancel').addEventListener('click', () => this.dialog.close());
    this.takeDrops(byId('view'));
  }

  choose() {
    this.input.value = '';
    this.input.click();
  }

  takeDrops(view) {
    view.addEventListener('dragover', (event) => {
      event.preventDefault();
      view.classList.add('dropping');
    });
    view.addEventListener('dragleave', () => view.classList.remove('dropping'));
    view.addEventListener('drop', (event) => {
      event.preventDefault();
      view.classList.remove('dropping');
      this.ask(event.dataTransfer.files[0]);
    });
  }

  ask(file) {
    if (!file) return;
    this.file = file;
    byId('add-name').textContent = file.name;
    byId('add-material').replaceChildren(
      make('option', {value: ''}, 'as the file says'),
      ...this.world.materialNames().map((name) => make('option', {value: name}, name)));
    this.dialog.showModal();
  }

  add() {
    this.edits.addMesh(this.file, {
      scale: Number(byId('add-unit').value),
      material: byId('add-material').value,
    });
  }
}
