// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The area that a scanner looks over: from where its beams begin to where they end, filled faintly, with its outline.
// Along a straight wall it takes two beams, since thousands of slivers are what drawing without a graphics card is slow
// at.
import {
  BufferAttribute, BufferGeometry, Color, DoubleSide, DynamicDrawUsage, Group, LineBasicMaterial, LineLoop, Mesh,
  MeshBasicMaterial,
} from './three.module.js';

const FILL_OPACITY = 0.16;
const EDGE_OPACITY = 0.55;
const STRAIGHT_M = 0.004;

export class Fan {
  constructor(colour) {
    const look = {color: new Color(...colour), transparent: true, depthWrite: false};
    this.fill = new Mesh(new BufferGeometry(),
      new MeshBasicMaterial({...look, opacity: FILL_OPACITY, side: DoubleSide}));
    this.edge = new LineLoop(new BufferGeometry(), new LineBasicMaterial({...look, opacity: EDGE_OPACITY}));
    this.group = new Group();
    this.group.add(this.fill, this.edge);
    this.group.visible = false;
    for (const part of this.group.children) part.frustumCulled = false;
    this.fill.renderOrder = 1;
    this.edge.renderOrder = 1.5;
    this.beams = 0;
  }

  /** Two places a beam: where it begins, and where it ends. */
  reserve(beams) {
    if (beams === this.beams) return;
    this.dispose();
    this.beams = beams;
    this.ends = new Float32Array(3 * beams);
    this.places = new BufferAttribute(new Float32Array(6 * beams), 3).setUsage(DynamicDrawUsage);
    const faces = [];
    const outline = [0];
    for (let i = 0; i < beams; ++i) {
      if (i) faces.push(2 * i, 2 * i - 1, 2 * i + 1);
      outline.push(2 * i + 1);
    }
    this.index(this.fill, faces);
    this.index(this.edge, outline);
  }

  index(part, list) {
    part.geometry = new BufferGeometry();
    part.geometry.setAttribute('position', this.places);
    part.geometry.setIndex(new BufferAttribute(new Uint32Array(list), 1));
  }

  /** reach(i) is how far beam i goes, in m. */
  show({origins, directions}, reach) {
    this.reserve(origins.length / 3);
    const {ends} = this;
    for (let i = 0; i < this.beams; ++i) {
      const reach_m = reach(i);
      for (let k = 3 * i; k < 3 * i + 3; ++k) ends[k] = origins[k] + reach_m * directions[k];
    }
    const places = this.places.array;
    let taken = 0;
    let last = 0;
    for (let i = 0; i < this.beams; ++i) {
      const isCorner = i === 0 || i === this.beams - 1 || !isBetween(ends, last, i, i + 1);
      if (!isCorner) continue;
      places.set(origins.subarray(3 * i, 3 * i + 3), 6 * taken);
      places.set(ends.subarray(3 * i, 3 * i + 3), 6 * taken + 3);
      taken += 1;
      last = i;
    }
    this.places.needsUpdate = true;
    this.fill.geometry.setDrawRange(0, 3 * (taken - 1));
    this.edge.geometry.setDrawRange(0, taken + 1);
    this.group.visible = true;
  }

  hide() {
    this.group.visible = false;
  }

  dispose() {
    this.fill.geometry.dispose();
    this.edge.geometry.dispose();
  }
}

/** Whether point b lies on the line from a to c. */
function isBetween(points, a, b, c) {
  const arm = (from, to, k) => points[3 * to + k] - points[3 * from + k];
  const [x, y, z] = [arm(a, c, 0), arm(a, c, 1), arm(a, c, 2)];
  const [u, v, w] = [arm(a, b, 0), arm(a, b, 1), arm(a, b, 2)];
  const length = Math.hypot(x, y, z);
  return Math.hypot(y * w - z * v, z * u - x * w, x * v - y * u) <= STRAIGHT_M * length;
}
