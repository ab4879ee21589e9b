// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What is selected: a robot, a model, or nothing; and what lies under the pointer.
import {Raycaster, Vector2, Plane, Vector3} from './three.module.js';
import {highestSeen_m} from './surface.js';

/** Tells changed. A thing is {kind: 'robots' or 'models', name, movable}. */
export class Selection extends EventTarget {
  constructor(stage, world, robots) {
    super();
    this.stage = stage;
    this.world = world;
    this.robots = robots;
    this.thing = null;
    this.wanted = null;
    this.caster = new Raycaster();
    world.addEventListener('changed', () => this.refresh());
    robots.addEventListener('known', () => this.refresh());
  }

  select(thing) {
    this.wanted = null;
    if (same(thing, this.thing)) return;
    this.thing = thing;
    this.light();
    this.dispatchEvent(new Event('changed'));
  }

  /** As soon as it is there. */
  selectLater(thing) {
    this.wanted = thing;
    this.refresh();
  }

  /** It may be gone, or have come in another shape. */
  refresh() {
    const sought = this.wanted || this.thing;
    if (sought) {
      this.thing = this.things().find((each) => same(each, sought)) || null;
      if (this.thing) this.wanted = null;
      this.light();
    }
    this.dispatchEvent(new Event('changed'));
  }

  light() {
    const thing = this.thing;
    this.world.light((object) => thing !== null && nameOf(object, thing.kind) === thing.name);
    for (const [name, mark] of this.robots.marks) {
      const glow = thing?.kind === 'robots' && thing.name === name ? 0.35 : 0;
      mark.traverse((part) => {
        if (part.material) part.material.uniforms.glow.value = glow;
      });
    }
    this.stage.invalidate();
  }

  /** All that one can select: robots, then models that can be moved, then those that stand still. */
  things() {
    const models = new Map();
    for (const {object} of this.world.objects) {
      if (object.robot || !object.model || models.has(object.model)) continue;
      models.set(object.model, {kind: 'models', name: object.model, movable: Boolean(object.movable)});
    }
    const robots = [...this.robots.poses.robots.keys()].map(
      (name) => ({kind: 'robots', name, movable: true}));
    const inOrder = [...models.values()].sort(
      (a, b) => b.movable - a.movable || a.name.localeCompare(b.name));
    return [...robots, ...inOrder];
  }

  step(by) {
    const things = this.things().filter((thing) => thing.movable);
    if (!things.length) return;
    const now = things.findIndex((each) => same(each, this.thing));
    const next = now < 0 ? (by > 0 ? 0 : things.length - 1) : (now + by + things.length) % things.length;
    this.select(things[next]);
  }

  aim(event) {
    const {x, y} = this.stage.place(event);
    this.caster.setFromCamera(new Vector2(x, y), this.stage.camera);
  }

  /** {thing, point, distance_m, up} of what is seen under the pointer, or null; up is 1 of a floor and 0 of a wall. */
  under(event) {
    this.aim(event);
    const marks = [...this.robots.marks.values()].filter((mark) => mark.visible);
    const meshes = this.world.objects.map(({mesh}) => mesh);
    const hits = this.caster.intersectObjects(meshes, false).concat(
      this.caster.intersectObjects(marks, true));
    hits.sort((a, b) => a.distance - b.distance);
    const hit = hits.find(({point}) => point.z <= highestSeen_m());
    if (!hit) return null;
    return {thing: thingOf(hit.object), point: hit.point, distance_m: hit.distance, up: uprightness(hit)};
  }

  /** Where the pointer's line meets a height, or null. */
  onHeight(event, height_m) {
    this.aim(event);
    const plane = new Plane(new Vector3(0, 0, 1), -height_m);
    return this.caster.ray.intersectPlane(plane, new Vector3());
  }
}

export function same(a, b) {
  return a?.kind === b?.kind && a?.name === b?.name;
}

/** Of the face that was hit, whichever side of it. */
function uprightness({face, object}) {
  return face ? Math.abs(face.normal.clone().transformDirection(object.matrixWorld).z) : 0;
}

function nameOf(object, kind) {
  if (kind === 'robots') return object.robot;
  return object.robot ? null : object.model;
}

function thingOf(part) {
  const object = part.userData.object;
  if (object?.robot) return {kind: 'robots', name: object.robot, movable: true};
  if (object?.model) {
    return {kind: 'models', name: object.model, movable: Boolean(object.movable)};
  }
  for (let each = part; each; each = each.parent) {
    if (each.userData.robot) return {kind: 'robots', name: each.userData.robot, movable: true};
  }
  return null;
}
