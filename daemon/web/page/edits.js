// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Changes of the world: a box, a cylinder, a mesh from a file, another size, a model less, another material. All by the
// control API, and each can be taken back.
import {Matrix4, Vector3} from './three.module.js';
import {ask} from './ask_dialog.js';
import {meshFile, toBase64} from './mesh_file.js';
import {matrixOf, movedTo} from './pose.js';
import {MARK_RADIUS_M} from './robots.js';
import {growth, newShape, sdfOf} from './shapes.js';

export const FORMATS = ['stl', 'obj', 'ply', 'dae', 'glb', 'gltf', 'off', '3ds'];

function modelPath(name, rest = '') {
  return `/scene/models/${encodeURIComponent(name)}${rest}`;
}

export class Edits {
  constructor({server, world, robots, selection, locks, placing, undo, notices, status}) {
    Object.assign(this, {server, world, robots, selection, locks, placing, undo, notices, status});
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

  /** A box or a cylinder, where the pointer is. */
  addShape(kind, place = this.placing.place()) {
    return this.undo.inTurn(() => this.bringShape(newShape(kind), place));
  }

  async bringShape(shape, xyz) {
    await this.add({name: this.freeName(shape.kind), sdf: sdfOf(shape), shape, static: false, pose: {xyz}});
  }

  /** A file that was dropped or chosen; scale is 0.001 where its unit is a millimetre. */
  addMesh(file, choices) {
    return this.undo.inTurn(() => this.bringMesh(file, choices));
  }

  async bringMesh(file, {scale, material, place}) {
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
      pose: {xyz: place ?? this.placing.middle()},
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
    const {shape, ...posted} = request;
    const answer = await this.server.post('/scene/models', posted);
    const {replace, ...kept} = request;
    if (era === this.undo.era) this.added.set(request.name, kept);
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

  /** What shapes.js calls so, of what was added here; kind is mesh where it came from a file. Null of all else. */
  shapeOf(name) {
    const added = this.added.get(name);
    if (!added) return null;
    if (added.shape) return added.shape;
    const box = this.localBox(name);
    return {kind: 'mesh', size: sizeAround(box), middle: box.getCenter(new Vector3()).toArray()};
  }

  /** In the frame of the model. */
  localBox(name) {
    const pose = this.robots.poseOf('models', name) ?? {xyz: [0, 0, 0], q: [0, 0, 0, 1]};
    return this.world.boxOf(({model}) => within(model, name), new Matrix4().getInverse(matrixOf(pose)));
  }

  /** shift: by how much its origin moves, in its own frame. */
  resize(name, size, shift = [0, 0, 0]) {
    return this.undo.inTurn(() => this.bringSize(name, size, shift));
  }

  async bringSize(name, size, shift) {
    const {era} = this.undo;
    const [before, materials, shape] = [this.recipe(name), this.materialsOf(name), this.shapeOf(name)];
    const xyz = new Vector3(...shift).applyMatrix4(matrixOf(before.pose)).toArray();
    const after = {...before, ...inSize(before, shape, size), pose: movedTo(before.pose, xyz)};
    try {
      await this.bringBack({...after, replace: true}, materials);
      this.undo.did(`resized ${name}`, () => this.bringBack({...before, replace: true}, materials), era);
    } catch (error) {
      this.notices.trouble(`${name} cannot be resized: ${error.message}`);
    }
  }

  async remove(thing) {
    if (thing?.kind !== 'models') {
      this.notices.tell(thing ? this.whyRobotStays(thing) : 'Nothing is selected. Select a model to delete it.');
      return;
    }
    if (this.locks.isLocked(thing)) {
      this.notices.tell(`${thing.name} belongs to the world and is locked. Unlock it in its card to delete it.`);
      return;
    }
    await this.undo.inTurn(() => this.removeModel(thing));
  }

  whyRobotStays({name}) {
    const others = this.status.sensors.some((sensor) => !sensor.name.startsWith(`${name}/`));
    return others
      ? `${name} is a robot, which is removed with its last sensor. Remove its sensors in the panel Sensors.`
      : `${name} is the only robot, and scipd needs one.`;
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
      `the configuration allows ${megabytes(this.world.limits.http_body_bytes)}.`, 'Delete');
  }

  /** Once of each model of the world that is larger than a robot. */
  async askIfLarge(name) {
    if (this.added.has(name) || this.asked.has(name)) return true;
    const size = sizeAround(this.world.boxOf((object) => within(object.model, name)));
    if (Math.max(...size) <= this.robotSize_m()) return true;
    const goes = await ask(`Delete ${name}?`,
      `It is larger than the robot: ${size.map((each_m) => each_m.toFixed(1)).join(' × ')} m.`, 'Delete');
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

/** What a request needs to have another size. */
function inSize(request, shape, size) {
  if (shape.kind === 'mesh') return {scale: (request.scale ?? 1) * growth(shape.size, size)};
  const resized = {...shape, size};
  return {shape: resized, sdf: sdfOf(resized)};
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
