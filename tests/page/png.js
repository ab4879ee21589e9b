// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads the pixels of a PNG as browsers write it: 8 bits, RGB or RGBA, not interlaced.
import zlib from 'node:zlib';

export function readPng(file) {
  let place = 8;
  let header = null;
  const data = [];
  while (place < file.length) {
    const length = file.readUInt32BE(place);
    const kind = file.toString('latin1', place + 4, place + 8);
    const body = file.subarray(place + 8, place + 8 + length);
    if (kind === 'IHDR') header = body;
    if (kind === 'IDAT') data.push(body);
    place += 12 + length;
  }
  const [width, height] = [header.readUInt32BE(0), header.readUInt32BE(4)];
  const channels = {2: 3, 6: 4}[header[9]];
  if (header[8] !== 8 || !channels || header[12]) throw new Error('this PNG is of another kind');
  const pixels = unfilter(zlib.inflateSync(Buffer.concat(data)), width, height, channels);
  const at = (x, y) => [...pixels.subarray((y * width + x) * channels, (y * width + x) * channels + 3)];
  return {width, height, at};
}

function unfilter(raw, width, height, channels) {
  const stride = width * channels;
  const pixels = new Uint8Array(stride * height);
  for (let y = 0; y < height; ++y) {
    const filter = raw[y * (stride + 1)];
    const row = y * stride;
    for (let i = 0; i < stride; ++i) {
      const left = i >= channels ? pixels[row + i - channels] : 0;
      const up = y ? pixels[row + i - stride] : 0;
      const corner = y && i >= channels ? pixels[row + i - stride - channels] : 0;
      const guess = [0, left, up, (left + up) >> 1, paeth(left, up, corner)][filter];
      pixels[row + i] = raw[y * (stride + 1) + 1 + i] + guess;
    }
  }
  return pixels;
}

function paeth(a, b, c) {
  const p = a + b - c;
  const [pa, pb, pc] = [Math.abs(p - a), Math.abs(p - b), Math.abs(p - c)];
  if (pa <= pb && pa <= pc) return a;
  return pb <= pc ? b : c;
}
