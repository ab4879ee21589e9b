// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Writes what is seen of a model as a GLB file, each object with the name of its material, so that a model that was
// deleted can be added again.
import {Matrix4} from './three.module.js';
import {matrixOf} from './pose.js';

const FLOAT = 5126;
const UINT = 5125;
const GLB = 0x46546c67;
const JSON_CHUNK = 0x4e4f534a;
const BINARY_CHUNK = 0x004e4942;
// glTF has y up; the daemon turns it to z up when it reads a mesh by itself.
const Y_UP = new Matrix4().set(1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1);

/** {mesh_data, mesh_format, pose}: what POST /scene/models takes. Without a pose all of it stays in W. */
export function meshFile(parts, world, pose) {
  const intoModel = pose ? new Matrix4().getInverse(matrixOf(pose)) : new Matrix4();
  const chunks = [];
  const file = {
    asset: {version: '2.0'}, scene: 0, scenes: [{nodes: []}], nodes: [], meshes: [], materials: [],
    accessors: [], bufferViews: [],
  };
  for (const part of parts) {
    const matrix = new Matrix4().multiplyMatrices(Y_UP,
      new Matrix4().multiplyMatrices(intoModel, part.mesh.matrixWorld));
    addPart(file, chunks, part.object, world.geometries.get(part.object.mesh).mesh, matrix);
  }
  const bytes = chunks.reduce((sum, chunk) => sum + chunk.byteLength, 0);
  file.buffers = [{byteLength: bytes}];
  return {
    mesh_data: toBase64(glb(file, chunks, bytes)),
    mesh_format: 'glb',
    pose: pose ? {xyz: pose.xyz, q: pose.q} : {xyz: [0, 0, 0]},
  };
}

function addPart(file, chunks, object, {positions, indices}, matrix) {
  const places = transformed(positions, matrix.elements);
  const position = addArray(file, chunks, places, FLOAT, 'VEC3', boundsOf(places));
  const index = addArray(file, chunks, indices, UINT, 'SCALAR', {});
  let material = file.materials.findIndex((each) => each.name === object.material);
  if (material < 0) material = file.materials.push({name: object.material}) - 1;
  const mesh = file.meshes.push({
    name: object.name, primitives: [{attributes: {POSITION: position}, indices: index, material}],
  }) - 1;
  file.scenes[0].nodes.push(file.nodes.push({name: object.name, mesh}) - 1);
}

function transformed(positions, m) {
  const places = new Float32Array(positions.length);
  for (let i = 0; i < positions.length; i += 3) {
    const [x, y, z] = positions.subarray(i, i + 3);
    for (let k = 0; k < 3; ++k) {
      places[i + k] = m[k] * x + m[4 + k] * y + m[8 + k] * z + m[12 + k];
    }
  }
  return places;
}

function boundsOf(places) {
  const min = [Infinity, Infinity, Infinity];
  const max = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < places.length; ++i) {
    min[i % 3] = Math.min(min[i % 3], places[i]);
    max[i % 3] = Math.max(max[i % 3], places[i]);
  }
  return {min, max};
}

function addArray(file, chunks, array, componentType, type, bounds) {
  const byteOffset = chunks.reduce((sum, chunk) => sum + chunk.byteLength, 0);
  chunks.push(array);
  const bufferView = file.bufferViews.push(
    {buffer: 0, byteOffset, byteLength: array.byteLength}) - 1;
  const count = type === 'VEC3' ? array.length / 3 : array.length;
  return file.accessors.push({bufferView, componentType, count, type, ...bounds}) - 1;
}

function glb(file, chunks, bytes) {
  let text = JSON.stringify(file);
  let json = new TextEncoder().encode(text);
  while (json.length % 4) json = new TextEncoder().encode(text += ' ');
  const whole = new Uint8Array(12 + 8 + json.length + 8 + bytes);
  const words = new DataView(whole.buffer);
  [GLB, 2, whole.length, json.length, JSON_CHUNK].forEach(
    (word, i) => words.setUint32(4 * i, word, true));
  whole.set(json, 20);
  words.setUint32(20 + json.length, bytes, true);
  words.setUint32(24 + json.length, BINARY_CHUNK, true);
  let place = 28 + json.length;
  for (const chunk of chunks) {
    whole.set(new Uint8Array(chunk.buffer, chunk.byteOffset, chunk.byteLength), place);
    place += chunk.byteLength;
  }
  return whole;
}

export function toBase64(bytes) {
  let text = '';
  for (let i = 0; i < bytes.length; i += 32_768) {
    text += String.fromCharCode(...bytes.subarray(i, i + 32_768));
  }
  return btoa(text);
}
