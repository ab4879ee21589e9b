// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The grid on the ground, the axes of W, and the bar that tells how long a metre is.
import {
  BufferGeometry, Color, Float32BufferAttribute, Group, LineBasicMaterial, LineSegments,
} from './three.module.js';
import {byId, tell} from './elements.js';

// Just above the ground, which the worlds have at 0.
const HEIGHT_M = 0.004;
const BAR_PX = 110;
const STEPS_M = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500];

export class Ground {
  constructor(stage, viewpoint) {
    this.stage = stage;
    this.viewpoint = viewpoint;
    this.fine = lines({transparent: true, opacity: 0.5, depthWrite: false});
    this.coarse = lines({transparent: true, opacity: 0.9, depthWrite: false});
    this.axes = axes();
    this.group = new Group();
    this.group.add(this.fine, this.coarse);
    stage.scene.add(this.group, this.axes);
    stage.afterEach(() => this.showScale());
  }

  /** Lines under a box, a metre apart, or more in a world that is large. */
  cover(box) {
    const largest = Math.max(box.max.x - box.min.x, box.max.y - box.min.y);
    const step = STEPS_M.find((each) => each >= 1 && largest / each <= 60) || 500;
    const from = [Math.floor(box.min.x / step) - 1, Math.floor(box.min.y / step) - 1];
    const to = [Math.ceil(box.max.x / step) + 1, Math.ceil(box.max.y / step) + 1];
    setLines(this.fine, grid(from, to, step, (at) => at % 5 !== 0));
    setLines(this.coarse, grid(from, to, step, (at) => at % 5 === 0));
    this.step_m = step;
    this.stage.invalidate();
  }

  setVisible(on) {
    this.group.visible = on;
    this.axes.visible = on;
    this.stage.invalidate();
  }

  setColours(fine, coarse) {
    this.fine.material.color = new Color(fine);
    this.coarse.material.color = new Color(coarse);
  }

  showScale() {
    const perPixel = this.viewpoint.metresPerPixel;
    const length_m = STEPS_M.find((each) => each / perPixel >= BAR_PX / 2) || 500;
    byId('scale-bar').style.width = `${Math.round(length_m / perPixel)}px`;
    tell(byId('scale-text'), length_m < 1 ? `${Math.round(100 * length_m)} cm` : `${length_m} m`);
  }
}

function lines(options) {
  const made = new LineSegments(new BufferGeometry(), new LineBasicMaterial(options));
  made.frustumCulled = false;
  return made;
}

function setLines(object, positions) {
  object.geometry.dispose();
  object.geometry = new BufferGeometry();
  object.geometry.setAttribute('position', new Float32BufferAttribute(positions, 3));
}

function grid(from, to, step, wanted) {
  const positions = [];
  for (let x = from[0]; x <= to[0]; ++x) {
    if (!wanted(x)) continue;
    positions.push(x * step, from[1] * step, HEIGHT_M, x * step, to[1] * step, HEIGHT_M);
  }
  for (let y = from[1]; y <= to[1]; ++y) {
    if (!wanted(y)) continue;
    positions.push(from[0] * step, y * step, HEIGHT_M, to[0] * step, y * step, HEIGHT_M);
  }
  return positions;
}

/** A metre of x in red, y in green, z in blue, from the origin of W. */
function axes() {
  const h = 2 * HEIGHT_M;
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new Float32BufferAttribute(
    [0, 0, h, 1, 0, h, 0, 0, h, 0, 1, h, 0, 0, h, 0, 0, 1], 3));
  geometry.setAttribute('color', new Float32BufferAttribute(
    [0.9, 0.2, 0.2, 0.9, 0.2, 0.2, 0.2, 0.7, 0.2, 0.2, 0.7, 0.2, 0.25, 0.45, 1, 0.25, 0.45, 1], 3));
  return new LineSegments(geometry, new LineBasicMaterial({vertexColors: 2}));
}
