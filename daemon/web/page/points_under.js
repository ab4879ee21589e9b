// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Which points of scans are drawn under the pointer, as far as nothing stands before them.
import {Matrix4, Vector3} from './three.module.js';

const REACH_PX = 5;
// A point lies on what was hit, give or take the noise.
const BEHIND_M = 0.1;

/** nearest_m: how far away the face is that the pointer meets. */
export function isOnPoint(stage, event, nearest_m = Infinity) {
  const {width, height} = stage.canvas.getBoundingClientRect();
  const pointer = stage.place(event);
  const reach = {x: 2 * REACH_PX / width, y: 2 * REACH_PX / height};
  const farthest_m = nearest_m + BEHIND_M;
  return [...geometriesOf(stage.scene)].some(([geometry, object]) => someVertex(geometry, object, (place) => {
    if (place.distanceTo(eyeOf(stage.camera, place)) > farthest_m) return false;
    const seen = place.project(stage.camera);
    return Math.abs(seen.z) <= 1 && Math.abs(seen.x - pointer.x) <= reach.x && Math.abs(seen.y - pointer.y) <= reach.y;
  }));
}

/** Several passes draw the same points. */
function geometriesOf(scene) {
  const found = new Map();
  scene.traverseVisible((object) => {
    if (object.isPoints) found.set(object.geometry, object);
  });
  return found;
}

function someVertex({attributes, drawRange}, {matrixWorld}, fits) {
  const places = attributes.position?.array || [];
  const place = new Vector3();
  const end = Math.min(3 * (drawRange.start + drawRange.count), places.length);
  for (let i = 3 * drawRange.start; i < end; i += 3) {
    if (fits(place.set(places[i], places[i + 1], places[i + 2]).applyMatrix4(matrixWorld))) return true;
  }
  return false;
}

const inverse = new Matrix4();
const eye = new Vector3();

/** Where the line of sight through a place begins: on a plan, straight above it. */
function eyeOf(camera, place) {
  if (!camera.isOrthographicCamera) return camera.position;
  eye.copy(place).applyMatrix4(inverse.getInverse(camera.matrixWorld));
  return eye.setZ(0).applyMatrix4(camera.matrixWorld);
}
