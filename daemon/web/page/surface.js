// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How faces look: flat, lit from the south-west, whichever way they point. Needs no normals, so a mesh of a million
// triangles goes to the graphics card as it came.
import {Color, DoubleSide, ShaderMaterial} from './three.module.js';

const VERTEX = `
  varying vec3 place;
  void main() {
    vec4 world = modelMatrix * vec4(position, 1.0);
    place = world.xyz;
    gl_Position = projectionMatrix * viewMatrix * world;
  }`;

const FRAGMENT = `
  uniform vec3 colour;
  uniform float opacity;
  uniform float glow;
  uniform float cut_m;
  uniform float brightness;
  varying vec3 place;
  void main() {
    if (place.z > cut_m) discard;
    vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
    if (dot(normal, cameraPosition - place) < 0.0) normal = -normal;
    float sun = max(dot(normal, normalize(vec3(-0.45, -0.6, 0.9))), 0.0);
    float light = 0.55 + 0.18 * normal.z + 0.32 * sun;
    gl_FragColor = vec4(brightness * colour * light + glow * vec3(0.7, 0.4, 0.05), opacity);
  }`;

// Shared: each changes all faces at once.
const cut = {value: 1e9};
const FULL = {value: 1};
const groundLight = {value: 1};

/** The brightness of all ground, which in a dark theme must not outshine what stands on it. */
export function lightGround(share) {
  groundLight.value = share;
}

export function cutAbove(height_m) {
  cut.value = height_m > 0 ? height_m : 1e9;
}

/** What is higher is not drawn. */
export function highestSeen_m() {
  return cut.value;
}

export function makeSurface(colour, opacity = 1, isGround = false) {
  return new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: {
      colour: {value: new Color(...colour)},
      opacity: {value: opacity},
      glow: {value: 0},
      cut_m: cut,
      brightness: isGround ? groundLight : FULL,
    },
    extensions: {derivatives: true},
    side: DoubleSide,
    transparent: opacity < 1,
    depthWrite: opacity >= 1,
    // Lines on a face win over it.
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
  });
}
