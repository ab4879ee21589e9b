// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Saves the world and the configuration as they are now: one tar with world.sdf, the meshes that it names, and
// scipd.yaml, which gives what is seen.
import {byId} from './elements.js';
import {stlOf} from './stl_file.js';
import {tarOf} from './tar_file.js';

export class WorldSaver {
  constructor({server, world, status, notices}) {
    Object.assign(this, {server, world, status, notices});
    byId('save-world').addEventListener('click', () => this.save());
  }

  async save() {
    const button = byId('save-world');
    button.disabled = true;
    try {
      const folder = this.folder();
      const link = document.createElement('a');
      link.href = URL.createObjectURL(tarOf(await this.files(folder), Date.now() / 1000));
      link.download = `${folder}.tar`;
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
      this.notices.tell(`Saved: tar xf ${folder}.tar; scipd --config ${folder}/scipd.yaml`);
    } catch (error) {
      this.notices.trouble(`The world cannot be saved: ${error.message}`);
    }
    button.disabled = false;
  }

  /** As the file of the world, with signs that no shell minds. */
  folder() {
    const name = (this.status.latest?.scene ?? '').split('/').pop().replace(/\.[^.]*$/, '');
    return name.replace(/[^\w-]/g, '_').slice(0, 40) || 'world';
  }

  async files(folder) {
    const [sdf, yaml] = await Promise.all(['/scene/sdf', '/configuration'].map((path) => this.server.bytes(path)));
    const named = new TextDecoder().decode(sdf).matchAll(/meshes\/([0-9a-f]+)\.stl/g);
    const hashes = new Set([...named].map(([, hash]) => hash));
    // The page may be behind the daemon by an edit.
    await this.world.load();
    const meshes = [...hashes].map((hash) => {
      const geometry = this.world.geometries.get(hash);
      if (!geometry) throw new Error('it is being changed; save it again');
      return {name: `${folder}/meshes/${hash}.stl`, bytes: stlOf(geometry.mesh)};
    });
    return [{name: `${folder}/world.sdf`, bytes: sdf}, {name: `${folder}/scipd.yaml`, bytes: yaml}, ...meshes];
  }
}
