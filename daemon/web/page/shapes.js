// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Boxes and cylinders that are added by hand, as SDF, and other sizes of them. A shape is {kind, size}: metres along x,
// y and z. Boxes and cylinders stand on the origin of their model; a mesh has its middle where its file says.

const NEW = {box: [0.5, 0.5, 0.5], cylinder: [0.3, 0.3, 1]};
export const LEAST_M = 0.05;

export function newShape(kind) {
  return {kind, size: NEW[kind]};
}

export function sdfOf({kind, size: [x, y, z]}) {
  const geometry = kind === 'box'
    ? `<box><size>${x} ${y} ${z}</size></box>`
    : `<cylinder><radius>${x / 2}</radius><length>${z}</length></cylinder>`;
  return `<model name='${kind}'><link name='body'><visual name='${kind}'><pose>0 0 ${z / 2} 0 0 0</pose>` +
    `<geometry>${geometry}</geometry></visual></link></model>`;
}

/** What becomes of a box when one of its faces is moved: {size, shift}; the face across stays where it is. */
export function stretched({kind, size}, axis, sign, by_m) {
  const length_m = rounded(Math.max(size[axis] + by_m * (isRound(kind, axis) ? 2 : 1), LEAST_M));
  const shift = [0, 0, 0];
  if (axis < 2 && kind === 'box') shift[axis] = sign * (length_m - size[axis]) / 2;
  return {size: sizeWith({kind, size}, axis, length_m), shift};
}

/** With another length along an axis: a cylinder stays round, and a mesh keeps its shape. */
export function sizeWith({kind, size}, axis, length_m) {
  if (kind === 'mesh') return size[axis] > 0 ? size.map((each) => each * length_m / size[axis]) : size;
  return size.map((each, i) => i === axis || (isRound(kind, axis) && i < 2) ? length_m : each);
}

/** Of a shape in another size, in the frame of its model. */
export function middleOf({kind, size: before, middle}, size) {
  return kind === 'mesh' ? middle.map((each) => each * growth(before, size)) : [0, 0, size[2] / 2];
}

/** Of a mesh. */
export function growth(before, size) {
  const axis = before.indexOf(Math.max(...before));
  return size[axis] / before[axis];
}

/** These grow to both sides. */
function isRound(kind, axis) {
  return kind !== 'box' && axis < 2;
}

function rounded(value) {
  return Math.round(value * 100) / 100;
}
