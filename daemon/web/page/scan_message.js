// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads a scan as WebSocket /view sends it: a header in JSON, then arrays.

const MAGIC = 0x31564353;  // SCV1
const TYPES = {
  f32: Float32Array, u32: Uint32Array, i32: Int32Array, u16: Uint16Array, i16: Int16Array,
  u8: Uint8Array,
};

/** {frame, ...header, NAME: typed array}. */
export function readScan(buffer) {
  const [magic, frame, headerBytes] = new Uint32Array(buffer, 0, 3);
  if (magic !== MAGIC) throw new Error('a scan is in another format: load the page again');
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 12, headerBytes)));
  const scan = {...header, frame, arrays: {}};
  let place = padded(12 + headerBytes);
  for (const {name, type, length} of header.arrays) {
    const Type = TYPES[type];
    scan.arrays[name] = new Type(buffer, place, length);
    place = padded(place + Type.BYTES_PER_ELEMENT * length);
  }
  return scan;
}

/** Each part begins at a multiple of 4. */
function padded(bytes) {
  return (bytes + 3) & ~3;
}
