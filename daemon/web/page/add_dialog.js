// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Asks what a mesh file does not say: its unit and its material. Files come by drop or by a button, and stand where
// they were dropped.
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
  }

  choose() {
    this.input.value = '';
    this.input.click();
  }

  /** place: where it will stand; without it, in the middle of the view. */
  ask(file, place = null) {
    if (!file) return;
    Object.assign(this, {file, place});
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
      place: this.place,
    });
  }
}
