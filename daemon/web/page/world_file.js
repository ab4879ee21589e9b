// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Another world in the place of this one, by the name of its file on the machine of the daemon.
import {ask} from './ask_dialog.js';
import {byId} from './elements.js';

export class WorldFile {
  constructor({server, world, undo, notices}) {
    Object.assign(this, {server, world, undo, notices});
    byId('world-form').addEventListener('submit', (event) => {
      event.preventDefault();
      this.load(byId('world-file').value.trim());
    });
  }

  async load(file) {
    const why = 'Your changes to this world will be lost.';
    if (this.undo.next && !await ask(`Load ${file}?`, why, 'Load')) return;
    const button = byId('world-form').querySelector('button');
    button.disabled = true;
    try {
      const {warnings} = await this.server.put('/scene', {file});
      await this.world.load();
      this.notices.tell(warnings.length ? `${file} is loaded; see its warnings below.` : `${file} is loaded.`);
    } catch (error) {
      this.notices.trouble(`${file} cannot be loaded: ${error.message}`);
    }
    button.disabled = false;
  }
}
