// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Changes of the world: a box, a mesh from a file, a model less, another material. All by the control API, and each can
// be taken back.
import {Vector3} from './three.module.js';
import {ask} from './ask_dialog.js';
import {meshFile, toBase64} from './mesh_file.js';
import {MARK_RADIUS_M} from './robots.js';

export const FORMATS = ['stl', 'obj', 'ply', 'dae', 'glb', 'gltf', 'off', '3ds'];
const BOX_M = 0.5;

function modelPath(name, rest = '') {
  return `/scene/models/${encodeURIComponent(name)}${rest}`;
}

export class Edits {
  constructor({server, world, robots, selection, locks, viewpoint, undo, notices}) {
    Object.assign(this, {server, world, robots, selection, locks, viewpoint, undo, notices});
    this.added = new Map();
    this.asked = new Set();
    world.addEventListener('loaded', () => this.forget());
  }

  /** Another world is there. */
  forget() {
    this.added.clear();
    this.asked.clear();
    this.undo.forget();
  }

  /** A name that no model has. */
  freeName(wish) {
    const taken = new Set(this.world.objects.map(({object}) => object.model));
    for (const name of this.added.keys()) taken.add(name);
    if (!taken.has(wish)) return wish;
    for (let number = 2; ; ++number) {
      if (!taken.has(`${wish} ${number}`)) return `${wish} ${number}`;
    }
  }

  /** On the ground, in the middle of the view. */
  place() {
    const {x, y} = this.viewpoint.target;
    return [round(x), round(y), 0];
  }

  addBox() {
    return this.undo.inTurn(() => this.bringBox());
  }

  async bringBox() {
    const name = this.freeName('box');
    const half_m = BOX_M / 2;
    const sdf = `<model name='box'><link name='body'><visual name='box'>` +
      `<pose>0 0 ${half_m} 0 0 0</pose><geometry><box><size>${BOX_M} ${BOX_M} ${BOX_M}</size></box>` +
      `</geometry></visual></link></model>`;
    await this.add({name, sdf, static: false, pose: {xyz: this.place()}});
  }

  /** A file that was dropped or chosen; scale is 0.001 where its unit is a millimetre. */
  addMesh(file, choices) {
    return this.undo.inTurn(() => this.bringMesh(file, choices));
  }

  async bringMesh(file, {scale, material}) {
    const format = file.name.split('.').pop().toLowerCase();
    if (!FORMATS.includes(format)) {
      this.notices.trouble(`${file.name} is no mesh that scipd reads: ${FORMATS.join(', ')}.`);
      return;
    }
    const stem = file.name.slice(0, -format.length - 1).replace(/::/g, ' ') || 'mesh';
    const request = {
      name: this.freeName(stem.slice(0, 40)),
      mesh_data: toBase64(new Uint8Array(await file.arrayBuffer())),
      mesh_format: format,
      pose: {xyz: this.place()},
    };
    if (scale !== 1) request.scale = scale;
    if (material) request.material = material;
    await this.add(request);
  }

  async add(request) {
    const {era} = this.undo;
    try {
      await this.bring(request);
      this.undo.did(`added ${request.name}`, () => this.takeAway(request.name), era);
      this.selection.select({kind: 'models', name: request.name, movable: true});
    } catch (error) {
      this.notices.trouble(`${request.name} cannot be added: ${error.message}`);
    }
  }

  async bring(request) {
    const {era} = this.undo;
    const answer = await this.server.post('/scene/models', request);
    if (era === this.undo.era) this.added.set(request.name, request);
    this.locks.unlock([request.name]);
    for (const warning of answer.warnings || []) this.notices.tell(warning);
    // The page is told of the new scene, but whoever selects the model next wants it now.
    await this.world.load();
  }

  async takeAway(name) {
    await this.server.remove(modelPath(name));
    this.added.delete(name);
    await this.world.load();
  }

  /** What brings a model back: as it was added, or else as the faces that were seen of it. */
  recipe(name) {
    const pose = this.robots.poseOf('models', name) || {xyz: [0, 0, 0], q: [0, 0, 0, 1]};
    const added = this.added.get(name);
    if (added) return {...added, pose: {xyz: pose.xyz, q: pose.q}};
    const parts = this.partsOf(name);
    const movable = parts.some(({object}) => object.movable);
    return {name, ...meshFile(parts, this.world, movable ? pose : null), static: !movable};
  }

  /** A model that was made of something else since it was added comes back so. */
  async bringBack(recipe, materials) {
    await this.bring(recipe);
    const now = this.materialsOf(recipe.name);
    if (now.length === materials.length && now.join('\n') !== materials.join('\n')) {
      await this.putMaterials(recipe.name, {materials});
    }
  }

  async remove(thing) {
    if (thing?.kind !== 'models') return;
    if (this.locks.isLocked(thing)) {
      this.notices.tell(`${thing.name} belongs to the world and is locked. Unlock it in its card to delete it.`);
      return;
    }
    await this.undo.inTurn(() => this.removeModel(thing));
  }

  async removeModel({name}) {
    const {era} = this.undo;
    const recipe = this.recipe(name);
    const materials = this.materialsOf(name);
    const comesBack = sizeOf(recipe) <= this.world.limits.http_body_bytes;
    if (!await (comesBack ? this.askIfLarge(name) : this.askForGood(recipe))) return;
    try {
      await this.takeAway(name);
    } catch (error) {
      this.notices.trouble(`${name} cannot be deleted: ${error.message}`);
      return;
    }
    this.selection.select(null);
    if (comesBack) this.undo.did(`deleted ${name}`, () => this.bringBack(recipe, materials), era);
    this.notices.tell(`${name} is gone.${comesBack ? ' Ctrl+Z brings it back.' : ''}`);
  }

  /** Before a model goes that no request can bring back. */
  askForGood(recipe) {
    return ask(`Delete ${recipe.name} for good?`,
      `It cannot be brought back: its faces take ${megabytes(sizeOf(recipe))}, and http_body_bytes under limits in ` +
      `the configuration allows ${megabytes(this.world.limits.http_body_bytes)}.`, 'Delete it');
  }

  /** Once of each model of the world that is larger than a robot. */
  async askIfLarge(name) {
    if (this.added.has(name) || this.asked.has(name)) return true;
    const size = sizeAround(this.world.boxOf((object) => within(object.model, name)));
    if (Math.max(...size) <= this.robotSize_m()) return true;
    const goes = await ask(`Delete ${name}?`,
      `It is larger than the robot: ${size.map((each_m) => each_m.toFixed(1)).join(' × ')} m.`, 'Delete it');
    if (goes) this.asked.add(name);
    return goes;
  }

  /** Of the largest one; a robot without a body is as large as its mark. */
  robotSize_m() {
    const bodies = [...this.robots.poses.robots.keys()].map((name) =>
      Math.max(...sizeAround(this.world.boxOf((object) => object.robot === name))));
    return Math.max(...bodies, 2 * MARK_RADIUS_M);
  }

  partsOf(name) {
    return this.world.objects.filter(({object}) => within(object.model, name));
  }

  /** One for each of its objects. */
  materialsOf(name) {
    return this.partsOf(name).map(({object}) => object.material);
  }

  setMaterial(name, material) {
    return this.undo.inTurn(() => this.makeOf(name, material));
  }

  async putMaterials(name, wanted) {
    await this.server.put(modelPath(name, '/material'), wanted);
    await this.world.load();
  }

  async makeOf(name, material) {
    const {era} = this.undo;
    const materials = this.materialsOf(name);
    try {
      await this.putMaterials(name, {material});
      this.undo.did(`made ${name} of ${material}`, () => this.putMaterials(name, {materials}), era);
    } catch (error) {
      this.notices.trouble(`${name} cannot be made of ${material}: ${error.message}`);
    }
  }
}

/** A model, or one that lies in it. */
function within(model, name) {
  return model === name || Boolean(model?.startsWith(`${name}::`));
}

/** Along x, y and z; of nothing, nothing. */
function sizeAround(box) {
  return box.isEmpty() ? [0, 0, 0] : box.getSize(new Vector3()).toArray();
}

/** Of a request, in bytes. */
function sizeOf(request) {
  return new Blob([JSON.stringify(request)]).size;
}

function megabytes(bytes) {
  return `${(bytes / 1e6).toFixed(1)} MB`;
}

function round(value) {
  return Math.round(value * 100) / 100;
}
