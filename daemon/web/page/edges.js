// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The edges of a mesh: where faces end, or meet at an angle.

const MOST_TRIANGLES = 20_000;
const FLAT = Math.cos(0.35);
const PER_METRE = 10_000;

/** Pairs of points as x, y, z; null for meshes that are so fine that their edges would hide them. */
export function edgesOf({positions, indices}) {
  if (indices.length > 3 * MOST_TRIANGLES) return null;
  const same = samePlaces(positions);
  const found = new Map();
  for (let i = 0; i < indices.length; i += 3) {
    const corners = [same[indices[i]], same[indices[i + 1]], same[indices[i + 2]]];
    const normal = normalOf(positions, corners);
    if (!normal) continue;
    for (let k = 0; k < 3; ++k) note(found, corners[k], corners[(k + 1) % 3], normal);
  }
  return pairs(positions, found);
}

function samePlaces(positions) {
  const seen = new Map();
  const same = new Uint32Array(positions.length / 3);
  for (let i = 0; i < same.length; ++i) {
    const key = [0, 1, 2].map((k) => Math.round(positions[3 * i + k] * PER_METRE)).join();
    if (!seen.has(key)) seen.set(key, i);
    same[i] = seen.get(key);
  }
  return same;
}

function normalOf(positions, [a, b, c]) {
  const at = (corner, k) => positions[3 * corner + k];
  const u = [0, 1, 2].map((k) => at(b, k) - at(a, k));
  const v = [0, 1, 2].map((k) => at(c, k) - at(a, k));
  const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
  const length = Math.hypot(...n);
  return length > 0 ? n.map((each) => each / length) : null;
}

function note(found, a, b, normal) {
  const key = a < b ? a * 4294967296 + b : b * 4294967296 + a;
  const edge = found.get(key);
  if (!edge) {
    found.set(key, {a, b, normal, sharp: true, faces: 1});
    return;
  }
  edge.faces += 1;
  const cosine = edge.normal.reduce((sum, each, k) => sum + each * normal[k], 0);
  // Faces of the two sides of a thin sheet point away from each other and still are one.
  edge.sharp = edge.faces > 2 ? edge.sharp || Math.abs(cosine) < FLAT : Math.abs(cosine) < FLAT;
}

function pairs(positions, found) {
  const points = [];
  for (const {a, b, sharp} of found.values()) {
    if (!sharp) continue;
    points.push(...positions.subarray(3 * a, 3 * a + 3), ...positions.subarray(3 * b, 3 * b + 3));
  }
  return new Float32Array(points);
}
