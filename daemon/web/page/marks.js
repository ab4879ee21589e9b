// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Points and lines with a colour and an opacity each, drawn where they are in sight, and faintly where something stands
// in front of them.
import {
  BufferAttribute, BufferGeometry, DynamicDrawUsage, GreaterDepth, Group, LessEqualDepth,
  LineSegments, Points, ShaderMaterial,
} from './three.module.js';

const VERTEX = `
  attribute vec4 tint;
  attribute float shape;
  uniform float size_px;
  uniform float nearer;
  varying vec4 seen;
  varying float corners;
  void main() {
    seen = tint;
    corners = shape;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
    // A hit lies on a face, and wins over it.
    gl_Position.z -= nearer * gl_Position.w;
    gl_PointSize = size_px;
  }`;

const FRAGMENT = `
  uniform float share;
  uniform bool isPoint;
  uniform float light;
  varying vec4 seen;
  varying float corners;
  // A circle, a square or a triangle.
  bool isInside(vec2 place) {
    if (corners < 0.5) return length(place) < 0.5;
    if (corners < 1.5) return true;
    return 2.0 * abs(place.x) < place.y + 0.5;
  }
  void main() {
    if (isPoint && !isInside(gl_PointCoord - 0.5)) discard;
    gl_FragColor = vec4(seen.rgb * light, seen.a * share);
  }`;
const HIDDEN_SHARE = 0.18;

function material(options, {share = 1, depthFunc = LessEqualDepth, light = 1, wider_px = 0}) {
  return new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: {
      share: {value: share},
      size_px: {value: sharp(options.size_px + wider_px)},
      light: {value: light},
      isPoint: {value: options.isPoint},
      nearer: {value: options.nearer},
    },
    transparent: true,
    depthWrite: false,
    depthFunc,
  });
}

function sharp(size_px) {
  return size_px * Math.min(devicePixelRatio, 2);
}

class Marks {
  constructor(Kind, options) {
    this.geometry = new BufferGeometry();
    this.capacity = 0;
    this.group = new Group();
    this.hidden = this.pass(Kind, options, {share: HIDDEN_SHARE, depthFunc: GreaterDepth});
    // A dark rim, so that points are seen on faces of their own colour.
    this.rim = options.rim_px && this.pass(Kind, options, {light: 0.15, wider_px: options.rim_px});
    this.pass(Kind, options, {});
  }

  pass(Kind, options, look) {
    const object = new Kind(this.geometry, material(options, look));
    object.frustumCulled = false;
    object.userData.wider_px = look.wider_px || 0;
    object.renderOrder = options.order + 0.1 * this.group.children.length;
    this.group.add(object);
    return object;
  }

  /** Room for so many marks; what was in them is gone if there was less. */
  reserve(count) {
    if (count <= this.capacity) return;
    this.geometry.dispose();
    this.capacity = count;
    this.positions = new BufferAttribute(new Float32Array(3 * count), 3).setUsage(DynamicDrawUsage);
    this.tints = new BufferAttribute(new Uint8Array(4 * count), 4, true).setUsage(DynamicDrawUsage);
    this.geometry.setAttribute('position', this.positions);
    this.geometry.setAttribute('tint', this.tints);
    this.shapes = new BufferAttribute(new Uint8Array(count), 1).setUsage(DynamicDrawUsage);
    this.geometry.setAttribute('shape', this.shapes);
  }

  put(index, x, y, z) {
    const at = 3 * index;
    const places = this.positions.array;
    places[at] = x;
    places[at + 1] = y;
    places[at + 2] = z;
  }

  /** At a range along beam i of a shape. */
  putAlong(index, {origins, directions}, i, range_m) {
    const at = 3 * i;
    this.put(index, origins[at] + range_m * directions[at],
      origins[at + 1] + range_m * directions[at + 1], origins[at + 2] + range_m * directions[at + 2]);
  }

  /** From the mark before. */
  distance_m(index) {
    const [at, places] = [3 * index, this.positions.array];
    return Math.hypot(places[at] - places[at - 3], places[at + 1] - places[at - 2], places[at + 2] - places[at - 1]);
  }

  tint(index, colour, opacity) {
    const at = 4 * index;
    const tints = this.tints.array;
    tints[at] = 255 * colour[0];
    tints[at + 1] = 255 * colour[1];
    tints[at + 2] = 255 * colour[2];
    tints[at + 3] = 255 * opacity;
  }

  /** A number of SHAPES; all are circles until one is not. */
  setShape(index, shape) {
    if (this.shapes.array[index] === shape) return;
    this.shapes.array[index] = shape;
    this.shapes.needsUpdate = true;
  }

  show(count) {
    this.geometry.setDrawRange(0, count);
    this.group.visible = count > 0;
    if (!this.positions) return;
    this.positions.needsUpdate = true;
    this.tints.needsUpdate = true;
  }

  setSize(size_px) {
    for (const {material: each, userData} of this.group.children) {
      each.uniforms.size_px.value = sharp(size_px + userData.wider_px);
    }
  }

  setRim(on) {
    this.rim.visible = on;
  }

  setThrough(on) {
    this.hidden.visible = on;
  }

  dispose() {
    this.geometry.dispose();
    for (const {material: each} of this.group.children) each.dispose();
  }
}

export class PointMarks extends Marks {
  constructor(size_px, {rim_px = 0, order = 3} = {}) {
    super(Points, {size_px, rim_px, isPoint: true, nearer: 0.0006, order});
  }
}

export class LineMarks extends Marks {
  constructor() {
    super(LineSegments, {size_px: 1, isPoint: false, nearer: 0.0002, order: 2});
  }
}
