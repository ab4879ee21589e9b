// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the pointer is on: the point or ray that is drawn closest to it, or else the face of an object.
import {Matrix4, Plane, Raycaster, Vector2, Vector3, Vector4} from './three.module.js';
import {sentRange, shapeOf} from './scan_shape.js';

const POINT_PX = 9;
const RAY_PX = 4;
// Around a sensor all of its rays meet.
const MEETING_PX = 24;
const NEAREST_W = 0.05;
const BEHIND_M = 0.05;
// Through a world of more triangles it takes long to look.
const MOST_TRIANGLES = 200_000;

export class Pointed {
  constructor({stage, scans, settings, world, robots}) {
    Object.assign(this, {stage, scans, settings, world, robots});
    this.caster = new Raycaster();
    this.shapes = new WeakMap();
  }

  /** A target of an Inspection, or null. */
  at(event) {
    const pointer = this.pixelOf(event);
    // It takes longest to look for a face.
    const front = this.settings.get('through') ? null : this.faceAt(event);
    const beam = this.pointAt(pointer, front) || this.rayAt(pointer);
    if (beam) return beam;
    const face = front || this.faceAt(event);
    return face?.object ? face : null;
  }

  /** The place in W that the pointer is on: of a point that was sent, of a face, or of the ground; or null. */
  placeAt(event) {
    const face = this.faceAt(event);
    const point = this.pointAt(this.pixelOf(event), face);
    if (point) {
      const scan = this.scans.scanOf(point.sensor);
      return this.placeAlong(scan, point.i, sentRange(scan, point.i));
    }
    return face ? face.place : this.groundAt(event);
  }

  groundAt(event) {
    this.aim(event);
    return this.caster.ray.intersectPlane(new Plane(new Vector3(0, 0, 1), 0), new Vector3());
  }

  aim(event) {
    const {x, y} = this.stage.place(event);
    this.caster.setFromCamera(new Vector2(x, y), this.stage.camera);
  }

  pixelOf(event) {
    const box = this.stage.canvas.getBoundingClientRect();
    return {x: event.clientX - box.left, y: event.clientY - box.top};
  }

  shapeOf(scan) {
    if (!this.shapes.has(scan)) this.shapes.set(scan, shapeOf(scan));
    return this.shapes.get(scan);
  }

  /** Where a beam is after so many metres, in W. */
  placeAlong(scan, i, range_m) {
    const {origins, directions} = this.shapeOf(scan);
    return new Vector3(...[0, 1, 2].map((k) => origins[3 * i + k] + range_m * directions[3 * i + k]));
  }

  /** Where a place of W is on the canvas, in pixels of the page, or null if it is behind the camera. */
  project(place) {
    const clip = new Vector4(place.x, place.y, place.z, 1).applyMatrix4(this.matrix());
    return clip.w > NEAREST_W ? this.toCanvas()(clip.x, clip.y, clip.w) : null;
  }

  matrix() {
    const {camera} = this.stage;
    camera.updateMatrixWorld();
    return new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
  }

  toCanvas() {
    const {clientWidth, clientHeight} = this.stage.canvas;
    return (x, y, w) => ({x: (x / w + 1) * clientWidth / 2, y: (1 - y / w) * clientHeight / 2});
  }

  pointAt(pointer, face) {
    if (!this.settings.get('points')) return null;
    let best = null;
    let nearest_px = POINT_PX;
    for (const sensor of this.scans.shown) {
      const scan = this.scans.scanOf(sensor);
      if (!scan) continue;
      const found = this.pointOf(scan, pointer, nearest_px, face);
      if (!found) continue;
      nearest_px = found.far_px;
      best = {kind: 'beam', sensor, i: found.i};
    }
    return best;
  }

  /** {i, far_px} of the point of a scan that is less far away and in sight, or null. */
  pointOf(scan, pointer, nearest_px, face) {
    const project = this.projector(this.shapeOf(scan));
    const seesThrough = this.settings.get('through') || !face;
    let best = null;
    for (let i = 0; i < scan.beams; ++i) {
      const range_m = sentRange(scan, i);
      const place = range_m > 0 ? project(i, range_m) : null;
      if (!place) continue;
      const far_px = Math.hypot(place.x - pointer.x, place.y - pointer.y);
      if (far_px >= (best?.far_px ?? nearest_px)) continue;
      if (!seesThrough && this.isBehind(this.placeAlong(scan, i, range_m), face)) continue;
      best = {i, far_px};
    }
    return best;
  }

  isBehind(place, {place: front}) {
    const depth_m = (there) => -there.clone().applyMatrix4(this.stage.camera.matrixWorldInverse).z;
    return depth_m(place) > depth_m(front) + BEHIND_M;
  }

  /** A project(i, range_m) along the beams of a shape, for very many. */
  projector({origins, directions}) {
    const m = this.matrix().elements;
    const toCanvas = this.toCanvas();
    return (i, range_m) => {
      const at = 3 * i;
      const x = origins[at] + range_m * directions[at];
      const y = origins[at + 1] + range_m * directions[at + 1];
      const z = origins[at + 2] + range_m * directions[at + 2];
      const w = m[3] * x + m[7] * y + m[11] * z + m[15];
      if (w <= NEAREST_W) return null;
      return toCanvas(m[0] * x + m[4] * y + m[8] * z + m[12], m[1] * x + m[5] * y + m[9] * z + m[13], w);
    };
  }

  /** Rays are read of the chosen sensor only: those of several lie over each other. */
  rayAt(pointer) {
    const sensor = this.settings.get('sensor');
    const scan = this.settings.get('rays') && this.scans.scanOf(sensor);
    if (!scan) return null;
    const project = this.projector(this.shapeOf(scan));
    let best = null;
    let nearest_px = RAY_PX;
    for (let i = 0; i < scan.beams; ++i) {
      const [from, to] = [project(i, 0), project(i, this.reachOf(scan, i))];
      if (!from || !to || Math.hypot(from.x - pointer.x, from.y - pointer.y) < MEETING_PX) continue;
      const far_px = distanceToLine(pointer, from, to);
      if (far_px >= nearest_px) continue;
      nearest_px = far_px;
      best = {kind: 'beam', sensor, i};
    }
    return best;
  }

  /** As far as a ray is drawn from its sensor to what it met. */
  reachOf(scan, i) {
    const true_m = scan.arrays.true_m[i];
    return true_m > 0 ? Math.min(true_m, scan.max_range_m) : scan.max_range_m;
  }

  /** {kind: 'face', object, place} of what stands in front; without an object, a robot's mark. */
  faceAt(event) {
    if (this.world.triangles > MOST_TRIANGLES) return null;
    this.aim(event);
    const cut_m = this.settings.get('cut_m') || Infinity;
    const marks = [...this.robots.marks.values()].filter((mark) => mark.visible);
    const hits = [
      ...this.caster.intersectObjects(this.world.objects.map(({mesh}) => mesh), false),
      ...this.caster.intersectObjects(marks, true),
    ].filter(({point}) => point.z <= cut_m).sort((a, b) => a.distance - b.distance);
    return hits.length ? faceOf(hits[0]) : null;
  }
}

function faceOf({object: part, point}) {
  return {kind: 'face', object: part.userData.object || null, place: point};
}

function distanceToLine(p, a, b) {
  const [dx, dy] = [b.x - a.x, b.y - a.y];
  const share = ((p.x - a.x) * dx + (p.y - a.y) * dy) / (dx * dx + dy * dy || 1);
  const at = Math.min(Math.max(share, 0), 1);
  return Math.hypot(a.x + at * dx - p.x, a.y + at * dy - p.y);
}
