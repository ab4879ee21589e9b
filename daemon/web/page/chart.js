// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A canvas for curves: sharp on any screen, in the colours of the theme, with axes whose ticks are round numbers.

const SHARPEST = 2;
const ROUND = [1, 2, 5, 10];

/** The smallest of 1, 2 and 5 times a power of ten with which a span has no more than so many steps. */
export function roundStep(span, most) {
  const power = 10 ** Math.floor(Math.log10(span / most));
  return ROUND.map((each) => each * power).find((step) => span / step <= most) || 10 * power;
}

/** The multiples of a step from one number to another. */
export function ticks(from, to, step) {
  const first = Math.ceil(from / step - 1e-9);
  const last = Math.floor(to / step + 1e-9);
  return Array.from({length: Math.max(last - first + 1, 0)}, (_, k) => (first + k) * step);
}

export function tickText(value, step) {
  const text = value.toFixed(Math.max(-Math.floor(Math.log10(step) + 1e-9), 0));
  return text.replace('-', '−');
}

export class Chart {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext('2d');
  }

  /** An empty canvas as large as it is shown now; false where it is not shown. */
  begin() {
    const {canvas, context} = this;
    this.width = canvas.clientWidth;
    this.height = canvas.clientHeight;
    if (!this.width) return false;
    const sharp = Math.min(devicePixelRatio, SHARPEST);
    const [width, height] = [Math.round(this.width * sharp), Math.round(this.height * sharp)];
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, {width, height});
    context.setTransform(sharp, 0, 0, sharp, 0, 0);
    context.clearRect(0, 0, this.width, this.height);
    const style = getComputedStyle(canvas);
    this.colour = (name) => style.getPropertyValue(`--${name}`).trim();
    context.font = `12px ${style.fontFamily}`;
    return true;
  }

  /** A line through [x, y] places; null breaks it. */
  line(places, colour, {width = 1, dash = []} = {}) {
    const {context} = this;
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.setLineDash(dash);
    context.beginPath();
    let isOn = false;
    for (const place of places) {
      if (place) context[isOn ? 'lineTo' : 'moveTo'](...place);
      isOn = place !== null;
    }
    context.stroke();
    context.setLineDash([]);
  }

  dots(places, colour, size = 2) {
    this.context.fillStyle = colour;
    for (const [x, y] of places) this.context.fillRect(x - size / 2, y - size / 2, size, size);
  }

  /** halo: the name of the colour that keeps it apart from what lies under it. */
  text(text, x, y, {align = 'left', base = 'alphabetic', halo} = {}) {
    Object.assign(this.context, {textAlign: align, textBaseline: base, fillStyle: this.colour('dim')});
    if (halo) {
      Object.assign(this.context, {strokeStyle: this.colour(halo), lineWidth: 4, lineJoin: 'round'});
      this.context.strokeText(text, x, y);
    }
    this.context.fillText(text, x, y);
  }
}
