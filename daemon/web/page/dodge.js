// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Legend and scale step aside where they would cover a robot: each goes to the first of its places that is free, and
// stays until a robot comes there, or as long as the pointer is on it. All that hangs below the toolbar moves down with
// it.
import {Vector3} from './three.module.js';
import {MARK_RADIUS_M} from './robots.js';
import {byId} from './elements.js';

const PLACES = ['', 'right', 'top'];
const MARGIN_PX = 6;

export class Dodge {
  constructor({stage, viewpoint, world, robots}) {
    Object.assign(this, {stage, viewpoint, world, robots});
    this.radii_m = new Map();
    this.dodgers = [byId('legend'), byId('scale')];
    world.addEventListener('changed', () => this.radii_m.clear());
    stage.afterEach(() => this.look());
    const tools = document.querySelector('.tools');
    const bottom = () => `${tools.offsetTop + tools.offsetHeight + 8}px`;
    new ResizeObserver(() => byId('view').style.setProperty('--below-tools', bottom())).observe(tools);
  }

  look() {
    const robots = [...this.robots.poses.robots.keys()].map((name) => this.circleOf(name)).filter(Boolean);
    for (const element of this.dodgers) {
      if (!element.checkVisibility() || element.matches(':hover') || !covers(element, robots)) continue;
      const free = PLACES.find((place) => {
        element.dataset.place = place;
        return !covers(element, robots);
      });
      if (free === undefined) element.dataset.place = PLACES[0];
    }
  }

  /** Where on the page a robot is seen: {x, y, radius}, or null where it is out of sight. */
  circleOf(name) {
    const place = this.robots.positionOf('robots', name);
    const radius = this.radius_m(name) / this.viewpoint.metresPerPixelAt(place) + MARGIN_PX;
    const seen = place.project(this.stage.camera);
    if (Math.abs(seen.z) > 1) return null;
    const {left, top, width, height} = this.stage.canvas.getBoundingClientRect();
    return {x: left + (seen.x + 1) / 2 * width, y: top + (1 - seen.y) / 2 * height, radius};
  }

  /** Of its body, or else of its mark. */
  radius_m(name) {
    if (!this.radii_m.has(name)) {
      const box = this.world.boxOf((object) => object.robot === name);
      this.radii_m.set(name, box.isEmpty() ? MARK_RADIUS_M : box.getSize(new Vector3()).length() / 2);
    }
    return this.radii_m.get(name);
  }
}

function covers(element, circles) {
  const {left, right, top, bottom} = element.getBoundingClientRect();
  return circles.some(({x, y, radius}) =>
    Math.hypot(x - clamp(x, left, right), y - clamp(y, top, bottom)) < radius);
}

function clamp(value, least, most) {
  return Math.min(Math.max(value, least), most);
}
