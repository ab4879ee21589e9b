// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Robots outside of a world that was just loaded: a message with a button that brings them to a free place in it.
import {Raycaster, Vector3} from './three.module.js';

// Robots may start beside a world on purpose, such as at its door.
const MARGIN_M = 1;
const CLEAR_M = 0.6;
const HEIGHT_M = 0.3;
const GRID = 12;
// A search in a world of more triangles takes too long: robots go to its middle.
const MOST_TRIANGLES = 200_000;
const AROUND = [0, 1, 2, 3, 4, 5, 6, 7].map((k) => k * Math.PI / 4)
  .map((angle_rad) => new Vector3(Math.cos(angle_rad), Math.sin(angle_rad), 0));

export class Strays {
  constructor({world, robots, mover, undo, views, notices}) {
    Object.assign(this, {world, robots, mover, undo, views, notices});
    this.close = () => {};
    world.addEventListener('loaded', () => this.look());
  }

  look() {
    this.close();
    const box = this.world.box();
    const names = box.isEmpty() ? [] : [...this.robots.poses.robots.keys()].filter((name) => this.isOutside(name, box));
    if (!names.length) return;
    const isOne = names.length === 1;
    const text = isOne ? `${names[0]} is outside of this world.` : `Outside of this world: ${names.join(', ')}.`;
    this.close = this.notices.offer(text, isOne ? 'Bring it in' : 'Bring them in', () => this.bringIn(names));
  }

  isOutside(name, box) {
    const {x, y} = this.robots.positionOf('robots', name);
    return x < box.min.x - MARGIN_M || x > box.max.x + MARGIN_M || y < box.min.y - MARGIN_M || y > box.max.y + MARGIN_M;
  }

  bringIn(names) {
    const taken = [];
    for (const name of names) {
      const thing = {kind: 'robots', name};
      const before = this.robots.poseNow('robots', name);
      if (!before) continue;
      const place = this.freePlace(taken);
      taken.push(place);
      this.mover.move(thing, {...before, xyz: place.toArray()});
      this.undo.moved(thing, before);
    }
    this.views.all();
  }

  /** The place nearest to the middle, within walls if there are any, with room around it and a floor below. */
  freePlace(taken) {
    const box = this.world.box();
    const [middle, size] = [box.getCenter(new Vector3()), box.getSize(new Vector3())];
    const places = Array.from({length: GRID * GRID}, (_, k) => new Vector3(
      box.min.x + (k % GRID + 0.5) / GRID * size.x, box.min.y + (Math.floor(k / GRID) + 0.5) / GRID * size.y, 0));
    const away = (place) => Math.hypot(place.x - middle.x, place.y - middle.y);
    places.sort((a, b) => away(a) - away(b));
    const free = places.filter((place) => taken.every((other) => other.distanceTo(place) > 2 * CLEAR_M));
    if (this.world.triangles > MOST_TRIANGLES) return this.onFloor(free[0], box);
    const height_m = this.floor_m(box) + HEIGHT_M;
    let open = null;
    for (const place of free) {
      const around = AROUND.map((way) => this.range_m(new Vector3(place.x, place.y, height_m), way));
      if (Math.min(...around) < CLEAR_M) continue;
      if (around.every(Number.isFinite)) return this.onFloor(place, box);
      open ??= place;
    }
    return this.onFloor(open ?? free[0], box);
  }

  range_m(from, way) {
    const meshes = this.world.objects.filter(({object}) => !object.robot).map(({mesh}) => mesh);
    return new Raycaster(from, way).intersectObjects(meshes, false)[0]?.distance ?? Infinity;
  }

  /** The height of the ground, which most worlds have at 0. */
  floor_m({min, max}) {
    return min.z <= HEIGHT_M && max.z >= 0 ? 0 : min.z;
  }

  onFloor(place, box) {
    const height_m = this.floor_m(box) + HEIGHT_M;
    const down_m = this.range_m(new Vector3(place.x, place.y, height_m), new Vector3(0, 0, -1));
    return new Vector3(place.x, place.y, down_m < 2 * HEIGHT_M ? height_m - down_m : height_m - HEIGHT_M);
  }
}
