// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the world is made of: its models, its materials, and what scipd warned of when it read it.
import {boundCheckbox, boundSelect, byId, make, tell} from './elements.js';
import {CHOICES} from './settings.js';
import {css, ofMaterial} from './colours.js';
import {cutAbove} from './surface.js';
import {same} from './selection.js';

export class WorldPanel {
  constructor({settings, world, robots, selection, locks, status, stage, ground, edits, placing, addDialog}) {
    Object.assign(this, {settings, world, robots, selection, locks, status, stage, ground});
    byId('world-choices').append(
      boundSelect(settings, 'colours', 'Colour of objects',
        CHOICES.colours.map((each) => [each, `by ${each}`])),
      this.cutSlider(),
      make('div', {class: 'checks'}, boundCheckbox(settings, 'grid', 'Grid and axes', '(G)')));
    settings.watch('grid', (on) => ground.setVisible(on));
    for (const kind of ['box', 'cylinder']) {
      byId(`add-${kind}`).addEventListener('click', (event) =>
        placing.wait(event, (place) => edits.addShape(kind, place)));
    }
    byId('add-mesh').addEventListener('click', () => addDialog.choose());
    byId('unlock-all').addEventListener('click', () => this.unlockAll());
    world.addEventListener('changed', () => this.update());
    robots.addEventListener('known', () => this.update());
    selection.addEventListener('changed', () => this.updateThings());
    locks.addEventListener('changed', () => this.updateThings());
    status.addEventListener('changed', () => this.updateWarnings());
  }

  cutSlider() {
    this.cut = make('input', {type: 'range', min: 0, max: 5, step: 0.05, value: 0,
      'aria-label': 'Hide what is higher than'});
    this.cutText = make('output', {}, 'off');
    this.cut.addEventListener('input', () => this.settings.set('cut_m', Number(this.cut.value)));
    this.settings.watch('cut_m', () => this.applyCut());
    return make('label', {class: 'field'}, make('span', {}, 'Hide above'),
      make('span', {class: 'row'}, this.cut, this.cutText));
  }

  applyCut() {
    const height_m = this.settings.get('cut_m');
    this.cut.value = height_m;
    cutAbove(height_m);
    tell(this.cutText, height_m > 0 ? `${height_m.toFixed(2)} m` : 'off');
    this.stage.invalidate();
  }

  update() {
    const box = this.world.box();
    if (!box.isEmpty()) this.cut.max = Math.max(1, Math.ceil(box.max.z * 10) / 10);
    this.applyCut();
    this.updateThings();
    this.updateMaterials();
    const triangles = this.world.triangles.toLocaleString('en');
    tell(byId('world-size'), `${this.world.objects.length} objects, ${triangles} triangles`);
  }

  updateThings() {
    const rows = this.selection.things().map((thing) => make('li', {}, make('button', {
      class: 'thing', 'aria-pressed': same(thing, this.selection.thing),
      on: {click: () => this.selection.select(thing)},
    }, make('span', {}, thing.name), make('span', {class: 'dim'}, this.kindOf(thing)))));
    byId('things').replaceChildren(...rows);
    byId('unlock-all').hidden = !this.locked().length;
  }

  kindOf(thing) {
    if (thing.kind === 'robots') return 'robot';
    if (this.locks.isLocked(thing)) return 'locked';
    return thing.movable ? 'movable' : 'static';
  }

  locked() {
    return this.selection.things().filter((thing) => this.locks.isLocked(thing)).map(({name}) => name);
  }

  unlockAll() {
    this.locks.unlock(this.locked());
  }

  updateMaterials() {
    const counts = new Map();
    for (const {object} of this.world.objects) {
      counts.set(object.material, (counts.get(object.material) || 0) + 1);
    }
    const known = new Map(this.world.materials.map((material) => [material.name, material]));
    const rows = [...counts].sort().map(([name, count]) => {
      const swatch = make('span', {class: 'swatch'});
      swatch.style.background = css(ofMaterial(name));
      const share = known.get(name)?.reflectivity;
      return make('li', {}, swatch, make('span', {}, name),
        make('span', {class: 'dim'}, `${count} ${count === 1 ? 'object' : 'objects'}` +
          (typeof share === 'number' ? `, reflects ${Math.round(100 * share)} %` : '')));
    });
    byId('materials').replaceChildren(...rows);
  }

  updateWarnings() {
    const warnings = this.status.latest?.warnings || [];
    if (warnings.join('\n') === this.warned) return;
    this.warned = warnings.join('\n');
    byId('warnings-none').hidden = warnings.length > 0;
    byId('warnings').replaceChildren(...warnings.map((text) => make('li', {class: 'warning'}, text)));
  }
}
