// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Triangles as a binary STL file: the same floats, without normals, which readers compute.

const HEAD = 84;
const TRIANGLE = 50;

/** positions: x, y and z of each vertex; indices: three for each triangle. */
export function stlOf({positions, indices}) {
  const count = indices.length / 3;
  const bytes = new Uint8Array(HEAD + TRIANGLE * count);
  const view = new DataView(bytes.buffer);
  view.setUint32(80, count, true);
  for (let i = 0; i < indices.length; ++i) {
    const at = HEAD + TRIANGLE * Math.floor(i / 3) + 12 * (1 + i % 3);
    for (let axis = 0; axis < 3; ++axis) view.setFloat32(at + 4 * axis, positions[3 * indices[i] + axis], true);
  }
  return bytes;
}
