// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// All objects of the world, with the meshes that the daemon casts at, where they are now.
import {
  Box3, BufferAttribute, BufferGeometry, Group, LineBasicMaterial, LineSegments, Matrix4, Mesh,
  Vector3,
} from './three.module.js';
import {edgesOf} from './edges.js';
import {makeSurface} from './surface.js';
import {matrixOf} from './pose.js';
import {readMesh} from './mesh_message.js';
import * as colours from './colours.js';

const FLAT_M = 0.05;
// Minimum width of a flat face that counts as ground, m.
const GROUND_M = 4;
const STILL = 'still';

/** Tells changed when other objects are there, and loaded when they are those of a world that was loaded anew. */
export class World extends EventTarget {
  constructor(server, stage, settings) {
    super();
    this.server = server;
    this.stage = stage;
    this.settings = settings;
    this.group = new Group();
    this.bodies = new Map();
    this.objects = [];
    this.materials = [];
    this.geometries = new Map();
    this.edgeLines = new LineBasicMaterial({transparent: true, opacity: 0.35, depthWrite: false});
    this.version = null;
    this.loaded = null;
    this.limits = {};
    this.loading = Promise.resolve();
    stage.scene.add(this.group);
    settings.watch('colours', () => this.recolour());
  }

  /** Takes the present list, and brings the meshes that are not here yet. Calls happen one after the other. */
  load() {
    const begin = () => this.loadNow();
    this.loading = this.loading.then(begin, begin);
    return this.loading;
  }

  async loadNow(tries = 3) {
    const list = await this.server.get('/scene/objects');
    if (list.version === this.version) return;
    try {
      await this.bringMeshes(list.objects);
    } catch (error) {
      // Another scene may be there since the list was made, without some of its meshes.
      if (error.status !== 404 || tries === 0) throw error;
      await this.loadNow(tries - 1);
      return;
    }
    const isAnother = this.loaded !== null && list.loaded !== this.loaded;
    this.version = list.version;
    this.loaded = list.loaded;
    this.limits = list.limits;
    this.materials = list.materials;
    this.replace(list);
    this.dispatchEvent(new Event('changed'));
    if (isAnother) this.dispatchEvent(new Event('loaded'));
  }

  /** The daemon may have begun anew with another world of the same version. */
  forget() {
    this.version = null;
  }

  async bringMeshes(objects) {
    const wanted = new Set(objects.map((object) => object.mesh));
    for (const hash of this.geometries.keys()) {
      if (!wanted.has(hash)) this.drop(hash);
    }
    const missing = [...wanted].filter((hash) => !this.geometries.has(hash));
    await Promise.all(missing.map((hash) => this.bringMesh(hash)));
  }

  async bringMesh(hash) {
    const mesh = readMesh(await this.server.bytes(`/scene/meshes/${encodeURIComponent(hash)}`));
    const faces = new BufferGeometry();
    faces.setAttribute('position', new BufferAttribute(mesh.positions, 3));
    faces.setIndex(new BufferAttribute(mesh.indices, 1));
    faces.computeBoundingBox();
    faces.computeBoundingSphere();
    const points = edgesOf(mesh);
    const edges = points && new BufferGeometry().setAttribute(
      'position', new BufferAttribute(points, 3));
    this.geometries.set(hash, {faces, edges, mesh});
  }

  drop(hash) {
    const {faces, edges} = this.geometries.get(hash);
    faces.dispose();
    edges?.dispose();
    this.geometries.delete(hash);
  }

  replace(list) {
    this.clear();
    for (const object of list.objects) this.add(object);
    this.stage.invalidate();
  }

  clear() {
    for (const {surface} of this.objects) surface.dispose();
    this.group.remove(...this.group.children);
    this.objects = [];
    this.bodies.clear();
  }

  add(object) {
    const {faces, edges} = this.geometries.get(object.mesh);
    const surface = makeSurface(this.colourOf(object), colours.opacityOf(object.material), isGround(faces, object));
    const mesh = new Mesh(faces, surface);
    mesh.matrixAutoUpdate = false;
    const inModel = matrixOf(object.in_model);
    const body = this.bodyOf(object, inModel);
    mesh.matrix.copy(body.movable ? inModel : matrixOf(object.pose));
    mesh.matrix.scale(new Vector3(...object.scale));
    mesh.userData = {object};
    if (edges) mesh.add(new LineSegments(edges, this.edgeLines));
    body.group.add(mesh);
    this.objects.push({object, mesh, surface});
  }

  /** What moves as one: a robot, a model, or all that stands still. */
  bodyOf(object, inModel) {
    const key = keyOf(object);
    if (!this.bodies.has(key)) {
      const group = new Group();
      group.matrixAutoUpdate = false;
      this.group.add(group);
      const body = {group, movable: key !== STILL, matrix: new Matrix4()};
      const intoModel = new Matrix4().getInverse(inModel);
      if (body.movable) this.place(body, matrixOf(object.pose).multiply(intoModel));
      this.bodies.set(key, body);
    }
    return this.bodies.get(key);
  }

  place(body, matrix) {
    body.matrix.copy(matrix);
    body.group.matrix.copy(matrix);
    body.group.matrixWorldNeedsUpdate = true;
  }

  /** kind is robots or models. */
  move(kind, name, pose) {
    const body = this.bodies.get(kind === 'robots' ? `robot:${name}` : `model:${name}`);
    if (!body) return;
    this.place(body, matrixOf(pose));
    this.stage.invalidate();
  }

  colourOf(object) {
    return this.settings.get('colours') === 'model'
      ? colours.ofName(object.model) : colours.ofMaterial(object.material);
  }

  recolour() {
    for (const {object, surface} of this.objects) {
      surface.uniforms.colour.value.setRGB(...this.colourOf(object));
    }
    this.stage.invalidate();
  }

  /** wanted(object) tells which objects glow. */
  light(wanted) {
    for (const {object, surface} of this.objects) {
      surface.uniforms.glow.value = wanted(object) ? 0.35 : 0;
    }
    this.stage.invalidate();
  }

  /** Of the object that scans call by this number. */
  nameOf(id) {
    return this.objects.find(({object}) => object.id === id)?.object.name || `object ${id}`;
  }

  /** Those that the world has, and those that scipd knows. */
  materialNames() {
    const own = this.materials.map(({name}) => name);
    return [...new Set([...own, ...colours.LIBRARY_NAMES])].sort();
  }

  setEdgeColour(colour) {
    this.edgeLines.color.set(colour);
  }

  /** Around all that stands up; floors may go on and on, so they count only where there is nothing else. */
  box() {
    const boxes = this.boxes(() => true);
    const standing = boxes.filter((box) => box.max.z - box.min.z > FLAT_M);
    return around(standing.length ? standing : boxes);
  }

  /** Around all of it, floors as well. */
  extent() {
    return around(this.boxes(() => true));
  }

  /** Around all objects that wanted(object) tells of, in W or in the frame that a matrix leads into. */
  boxOf(wanted, into = new Matrix4()) {
    return around(this.boxes(wanted, into));
  }

  boxes(wanted, into = new Matrix4()) {
    this.group.updateMatrixWorld();
    return this.objects.filter(({object}) => wanted(object)).map(({object, mesh}) =>
      this.geometries.get(object.mesh).faces.boundingBox.clone().applyMatrix4(
        new Matrix4().multiplyMatrices(into, mesh.matrixWorld)));
  }

  get triangles() {
    return this.objects.reduce(
      (sum, {object}) => sum + this.geometries.get(object.mesh).mesh.indices.length / 3, 0);
  }
}

function isGround({boundingBox}, {pose, scale}) {
  const {min, max} = boundingBox.clone().applyMatrix4(matrixOf(pose).scale(new Vector3(...scale)));
  return max.z - min.z <= FLAT_M && Math.min(max.x - min.x, max.y - min.y) >= GROUND_M;
}

function around(boxes) {
  return boxes.reduce((all, box) => all.union(box), new Box3());
}

function keyOf(object) {
  if (object.robot) return `robot:${object.robot}`;
  return object.movable ? `model:${object.model}` : STILL;
}
