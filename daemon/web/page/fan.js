// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The area that a scanner looks over: from where its beams begin to where they end, filled faintly, with its outline.
import {
  BufferAttribute, BufferGeometry, Color, DoubleSide, DynamicDrawUsage, Group, Line, LineBasicMaterial, Mesh,
  MeshBasicMaterial,
} from './three.module.js';

const FILL_OPACITY = 0.16;
const EDGE_OPACITY = 0.55;

export class Fan {
  constructor(colour) {
    const look = {color: new Color(...colour), transparent: true, depthWrite: false};
    this.fill = new Mesh(new BufferGeometry(),
      new MeshBasicMaterial({...look, opacity: FILL_OPACITY, side: DoubleSide}));
    this.edge = new Line(new BufferGeometry(), new LineBasicMaterial({...look, opacity: EDGE_OPACITY}));
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
    this.places = new BufferAttribute(new Float32Array(6 * beams), 3).setUsage(DynamicDrawUsage);
    const faces = [];
    const ends = [0];
    for (let i = 0; i < beams; ++i) {
      if (i) faces.push(2 * i, 2 * i - 1, 2 * i + 1);
      ends.push(2 * i + 1);
    }
    this.index(this.fill, faces);
    this.index(this.edge, [...ends, 2 * beams - 2]);
  }

  index(part, list) {
    part.geometry = new BufferGeometry();
    part.geometry.setAttribute('position', this.places);
    part.geometry.setIndex(new BufferAttribute(new Uint32Array(list), 1));
  }

  /** reach(i) is how far beam i goes, in m. */
  show({origins, directions}, reach) {
    this.reserve(origins.length / 3);
    const places = this.places.array;
    for (let i = 0; i < this.beams; ++i) {
      const reach_m = reach(i);
      for (let k = 0; k < 3; ++k) {
        places[6 * i + k] = origins[3 * i + k];
        places[6 * i + 3 + k] = origins[3 * i + k] + reach_m * directions[3 * i + k];
      }
    }
    this.places.needsUpdate = true;
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
