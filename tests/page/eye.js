// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where a place in the world is in a picture, for somebody who looks with a field of view of 50 degrees: computed here
// from the link's numbers, not by the page.

const HALF = Math.tan(25 * Math.PI / 180);

const minus = (a, b) => a.map((value, k) => value - b[k]);
const dot = (a, b) => a.reduce((sum, value, k) => sum + value * b[k], 0);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => a.map((value) => value / Math.hypot(...a));

/** project(xyz) gives {x, y}, in pixels of a picture of box {x, y, width, height}. */
export function lookFrom(eye, at, box) {
  const ahead = unit(minus(at, eye));
  const right = unit(cross(ahead, [0, 0, 1]));
  const up = cross(right, ahead);
  return (xyz) => {
    const arm = minus(xyz, eye);
    const depth = dot(arm, ahead);
    const scale = box.height / 2 / (HALF * depth);
    return {
      x: box.x + box.width / 2 + scale * dot(arm, right),
      y: box.y + box.height / 2 - scale * dot(arm, up),
      depth,
    };
  };
}

/** As lookFrom, on a plan: straight down, with as much in sight as from the eye. */
export function lookDown(eye, at, box) {
  const scale = box.height / 2 / (HALF * (eye[2] - at[2]));
  return ([x, y]) => ({
    x: box.x + box.width / 2 + scale * (x - at[0]),
    y: box.y + box.height / 2 - scale * (y - at[1]),
  });
}

export function hash(eye, at, rest = {}) {
  return `#${new URLSearchParams({eye: eye.join(), at: at.join(), ...rest})}`;
}
