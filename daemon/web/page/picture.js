// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a camera sees, as a picture: near is dark, far is bright, nothing is transparent.
import {viridis} from './colours.js';

export function pictureOf(scan, canvas) {
  const {columns, rows, arrays: {range_m: ranges}} = scan;
  canvas.width = columns;
  canvas.height = rows;
  const context = canvas.getContext('2d');
  const image = context.createImageData(columns, rows);
  let [near, far] = [Infinity, 0];
  for (const range_m of ranges) {
    if (!(range_m >= 0)) continue;
    near = Math.min(near, range_m);
    far = Math.max(far, range_m);
  }
  for (let i = 0; i < ranges.length; ++i) {
    if (!(ranges[i] >= 0)) continue;
    const colour = viridis((ranges[i] - near) / (far - near || 1));
    image.data.set([...colour.map((each) => 255 * each), 255], 4 * i);
  }
  context.putImageData(image, 0, 0);
}
