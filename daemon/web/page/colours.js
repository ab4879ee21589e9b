// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Colours that colour-blind people can read, as red, green and blue from 0 to 1.

// The same stops as those of scipcat.
const VIRIDIS = [
  [0.267, 0.005, 0.329], [0.254, 0.265, 0.530], [0.164, 0.471, 0.558],
  [0.135, 0.659, 0.518], [0.478, 0.821, 0.318], [0.993, 0.906, 0.144],
];
// Too near is blue, too far is red.
const ERRORS = [[0.10, 0.35, 0.85], [0.55, 0.72, 0.95], [0.90, 0.90, 0.90], [0.97, 0.65, 0.50],
  [0.84, 0.12, 0.12]];

// Paul Tol's "muted", as scipcat has it for materials.
const DISTINCT = [
  [0.200, 0.133, 0.533], [0.533, 0.800, 0.933], [0.067, 0.467, 0.200], [0.800, 0.400, 0.467], [0.867, 0.800, 0.467],
  [0.533, 0.133, 0.333], [0.267, 0.667, 0.600], [0.667, 0.267, 0.600], [0.600, 0.600, 0.200],
];
export const distinctCount = DISTINCT.length;

// Six of Okabe and Ito's, which all people can tell apart on light and on dark ground; their vermilion would say error.
const SCANNERS = [
  [0.902, 0.624, 0.000], [0.000, 0.447, 0.698], [0.800, 0.475, 0.655],
  [0.000, 0.620, 0.451], [0.337, 0.706, 0.914], [0.533, 0.133, 0.333],
];
// The next six are darker, the six after them lighter, and so on: thirty differ.
const SHADES = [[[0, 0, 0], 0], [[0, 0, 0], 0.4], [[1, 1, 1], 0.5], [[0, 0, 0], 0.65], [[1, 1, 1], 0.75]];

// The materials that scipd knows (scenes/materials.yaml), as people know their look.
const LIBRARY = {
  default: [0.80, 0.80, 0.78], paint: [0.72, 0.76, 0.80], white_paper: [0.93, 0.93, 0.90],
  matt_black: [0.25, 0.25, 0.27], black_foam: [0.18, 0.18, 0.20], cardboard: [0.60, 0.45, 0.32],
  wood: [0.80, 0.60, 0.36], pvc: [0.66, 0.70, 0.74], plaster: [0.88, 0.86, 0.82],
  carpet: [0.52, 0.42, 0.48], concrete: [0.64, 0.64, 0.62], brick: [0.70, 0.36, 0.27],
  asphalt: [0.36, 0.36, 0.38], sand: [0.85, 0.76, 0.55], soil: [0.45, 0.34, 0.24],
  grass: [0.42, 0.62, 0.30], leaves: [0.34, 0.56, 0.26], snow: [0.94, 0.96, 0.98],
  water: [0.25, 0.50, 0.72], skin: [0.87, 0.66, 0.54], clothing_light: [0.62, 0.68, 0.82],
  clothing_dark: [0.26, 0.30, 0.42], rubber: [0.24, 0.24, 0.24],
  car_paint_light: [0.78, 0.82, 0.86], car_paint_dark: [0.22, 0.28, 0.40],
  brushed_metal: [0.62, 0.66, 0.70], polished_metal: [0.74, 0.78, 0.84],
  glass: [0.55, 0.80, 0.90], tinted_glass: [0.35, 0.55, 0.62], acrylic: [0.62, 0.86, 0.94],
  smoke: [0.55, 0.55, 0.58], mirror: [0.70, 0.86, 0.98], reflective_tape: [0.98, 0.80, 0.20],
  traffic_sign: [0.90, 0.30, 0.22],
};
// Other names of some of them; all that is not here gets a hue by its name.
const MATERIALS = {
  ...LIBRARY,
  wall: LIBRARY.default, unknown: LIBRARY.default, metal: [0.60, 0.66, 0.72], plastic: [0.36, 0.56, 0.78],
  cloth: [0.42, 0.48, 0.66], painted_steel: [0.86, 0.72, 0.30], cast_iron: [0.40, 0.42, 0.45],
  steel: LIBRARY.brushed_metal, aluminium: LIBRARY.polished_metal, plywood: LIBRARY.wood,
};
export const LIBRARY_NAMES = Object.keys(LIBRARY);
const GREY = [0.7, 0.7, 0.7];
const CLEAR = {glass: 0.35, tinted_glass: 0.5, acrylic: 0.35, smoke: 0.3, water: 0.7};

function mix(a, b, share) {
  return a.map((each, k) => each + share * (b[k] - each));
}

function between(stops, share) {
  const place = Math.min(Math.max(share, 0), 1) * (stops.length - 1);
  const below = Math.min(Math.floor(place), stops.length - 2);
  return mix(stops[below], stops[below + 1], place - below);
}

export function viridis(share) {
  return between(VIRIDIS, share);
}

/** From -1, too near, to 1, too far. */
export function ofError(share) {
  return between(ERRORS, (share + 1) / 2);
}

export function ofMaterial(name) {
  return MATERIALS[name] || mix(ofName(name), GREY, 0.6);
}

export function opacityOf(material) {
  return CLEAR[material] || 1;
}

/** So many differ; then they begin again. */
export function distinct(number) {
  return DISTINCT[number % DISTINCT.length];
}

/** Of the scanner that has this number in the configuration, from 0. */
export function ofScanner(number) {
  const [towards, share] = SHADES[Math.floor(number / SCANNERS.length) % SHADES.length];
  return mix(SCANNERS[number % SCANNERS.length], towards, share);
}

/** A colour for anything that has a name; the same one every time. */
export function ofName(name) {
  let hash = 2166136261;
  for (const letter of String(name)) hash = Math.imul(hash ^ letter.codePointAt(0), 16777619);
  return ofHue((hash >>> 0) / 4294967296);
}

/** Neighbours of a list get hues that lie far apart. */
export function ofNumber(number) {
  return ofHue(number * 0.618034);
}

function ofHue(hue) {
  const wave = (shift) => 0.56 + 0.34 * Math.cos(2 * Math.PI * (hue + shift));
  return [wave(0), wave(2 / 3), wave(1 / 3)];
}

export function css(colour) {
  return `rgb(${colour.map((each) => Math.round(255 * each)).join(', ')})`;
}

/** A gradient of CSS, for legends. */
export function gradient(colourAt) {
  const stops = [0, 0.2, 0.4, 0.6, 0.8, 1].map((share) => css(colourAt(share)));
  return `linear-gradient(to right, ${stops.join(', ')})`;
}
