// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where a sensor is: a small case that points ahead, the frustum of a camera, and a warning sign while a fault acts.
import {
  BufferGeometry, Color, ConeBufferGeometry, CylinderBufferGeometry, Float32BufferAttribute, Group,
  LineBasicMaterial, LineSegments, Mesh,
} from './three.module.js';
import {makeSurface} from './surface.js';
import {makeWarningSign} from './warning_sign.js';
import {matrixOf} from './pose.js';

const FRUSTUM_M = 0.6;

export class SensorMark {
  constructor(colour) {
    this.surface = makeSurface(colour);
    this.group = new Group();
    this.group.matrixAutoUpdate = false;
    // Cylinders and cones of three.js stand along y.
    const body = new Mesh(new CylinderBufferGeometry(0.03, 0.03, 0.06, 24), this.surface);
    body.rotation.x = Math.PI / 2;
    const tip = new Mesh(new ConeBufferGeometry(0.02, 0.06, 16), this.surface);
    tip.rotation.z = -Math.PI / 2;
    tip.position.x = 0.055;
    this.frustum = new LineSegments(new BufferGeometry(), new LineBasicMaterial({color: new Color(...colour)}));
    this.frustum.visible = false;
    this.frustum.frustumCulled = false;
    this.sign = makeWarningSign();
    this.sign.visible = false;
    this.group.add(body, tip, this.frustum, this.sign);
    this.fov = null;
  }

  take(scan) {
    this.group.matrix.copy(matrixOf(scan.pose));
    this.group.matrixWorldNeedsUpdate = true;
    if (scan.kind === 'picture') this.open(scan.fov_rad);
  }

  /** Whether a fault acts on it. True if that is news. */
  warn(isFaulty) {
    const isNews = this.sign.visible !== isFaulty;
    this.sign.visible = isFaulty;
    return isNews;
  }

  open(fov_rad) {
    if (String(fov_rad) === this.fov) return;
    this.fov = String(fov_rad);
    const [y, z] = fov_rad.map((angle) => FRUSTUM_M * Math.tan(angle / 2));
    const corners = [[y, z], [-y, z], [-y, -z], [y, -z]].map(([a, b]) => [FRUSTUM_M, a, b]);
    const points = corners.flatMap((corner, i) =>
      [0, 0, 0, ...corner, ...corner, ...corners[(i + 1) % 4]]);
    this.frustum.geometry.setAttribute('position', new Float32BufferAttribute(points, 3));
    this.frustum.visible = true;
  }

  dispose() {
    this.surface.dispose();
    this.sign.material.map.dispose();
    this.sign.material.dispose();
    // All sprites of three.js have one geometry.
    this.group.traverse((part) => { if (part !== this.sign) part.geometry?.dispose(); });
  }
}
