// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads a mesh as GET /scene/meshes/HASH sends it.

const MAGIC = 0x314d4353;  // SCM1
const HEADER_BYTES = 12;

/** {positions, indices} that share the bytes of the message. */
export function readMesh(buffer) {
  const [magic, vertices, triangles] = new Uint32Array(buffer, 0, 3);
  const expected = HEADER_BYTES + 12 * vertices + 12 * triangles;
  if (magic !== MAGIC || buffer.byteLength !== expected) {
    throw new Error('a mesh of the daemon is in another format: load the page again');
  }
  return {
    positions: new Float32Array(buffer, HEADER_BYTES, 3 * vertices),
    indices: new Uint32Array(buffer, HEADER_BYTES + 12 * vertices, 3 * triangles),
  };
}
