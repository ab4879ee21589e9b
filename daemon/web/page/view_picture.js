// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The view as a picture that stands for itself: below it stand the world, the time, the scanners with their models and
// seeds, what the colours mean, and how long a metre is.
import {byId} from './elements.js';

const MARGIN_PX = 12;
const LINE_PX = 20;
const SWATCH_PX = 12;
const MOST_SENSORS = 6;
const BAR_PX = 200;

/** A promise of a PNG. */
export async function viewPicture({stage, scans, status, past}) {
  const view = await createImageBitmap(await stage.picture());
  const sharp = view.width / stage.canvas.clientWidth;
  const lines = [headOf(status, past), ...sensorsOf(scans, status)];
  const caption = new Caption(view.width / sharp, lines, legendOnScreen());
  const canvas = document.createElement('canvas');
  canvas.width = view.width;
  canvas.height = view.height + Math.round(caption.height * sharp);
  const context = canvas.getContext('2d');
  context.drawImage(view, 0, 0);
  context.translate(0, view.height);
  context.scale(sharp, sharp);
  caption.draw(context);
  return new Promise((done) => canvas.toBlob(done, 'image/png'));
}

function headOf(status, past) {
  const when = new Date(1000 * past.looksAt_s).toISOString().replace('T', ' ').replace(/\.(\d)\d\dZ/, '.$1 UTC');
  return `${status.latest.scene.split('/').pop()}  ·  ${when}  ·  scipd`;
}

/** One line for each sensor that is drawn, with the scan that one sees. */
function sensorsOf(scans, status) {
  const lines = scans.shown.slice(0, MOST_SENSORS).map((name) => {
    const {model, seed, errors} = status.sensor(name) || {};
    const scan = scans.scanOf(name);
    return [`${name}: ${model}`, errors && `accuracy ${errors.accuracy}`, `seed ${seed}`,
      scan && `scan ${scan.scan} at ${scan.time_s.toFixed(3)} s`].filter(Boolean).join(', ');
  });
  const more = scans.shown.length - lines.length;
  return more ? [...lines, `and ${more} more`] : lines;
}

/** What the legend in the view shows now: {title, stops, low, high} or {title, names}; null if it shows nothing. */
function legendOnScreen() {
  const legend = byId('legend');
  if (legend.hidden) return null;
  const title = byId('legend-title').textContent;
  const bar = legend.querySelector('.bar-of-colours');
  if (bar.checkVisibility()) {
    const [low, high] = [...legend.querySelectorAll('.ends span')].map((end) => end.textContent);
    return {title, stops: bar.style.background.match(/rgb\([^)]*\)/g), low, high};
  }
  const names = [...legend.querySelectorAll('[data-name]')].map((entry) => ({
    name: entry.dataset.name, colour: entry.querySelector('.swatch')?.style.background}));
  return {title, names};
}

class Caption {
  constructor(width, lines, legend) {
    Object.assign(this, {width, legend});
    const style = getComputedStyle(document.documentElement);
    this.colour = (name) => style.getPropertyValue(`--${name}`).trim();
    this.font = getComputedStyle(document.body).fontFamily;
    this.measure = document.createElement('canvas').getContext('2d');
    this.measure.font = `13px ${this.font}`;
    this.lines = lines.flatMap((line) => this.broken(line));
    this.rows = legend?.names ? this.rowsOf(legend.names) : [];
    const below = legend ? 1 + Math.max(this.rows.length, 1) : 0;
    this.height = 2 * MARGIN_PX + LINE_PX * (this.lines.length + below + 1);
  }

  /** In as many lines as it needs. */
  broken(text) {
    const lines = [''];
    for (const word of text.split(' ')) {
      const longer = lines[lines.length - 1] ? `${lines[lines.length - 1]} ${word}` : word;
      if (this.widthOf(longer) <= this.width - 2 * MARGIN_PX) lines[lines.length - 1] = longer;
      else lines.push(word);
    }
    return lines;
  }

  widthOf(text) {
    return this.measure.measureText(text).width;
  }

  /** As many names in a row as fit: [[{name, colour, x}, ...], ...]. */
  rowsOf(names) {
    const rows = [[]];
    let x = MARGIN_PX;
    for (const {name, colour} of names) {
      const wide = SWATCH_PX + 6 + this.widthOf(name) + 18;
      if (x + wide > this.width && rows[rows.length - 1].length) {
        rows.push([]);
        x = MARGIN_PX;
      }
      rows[rows.length - 1].push({name, colour, x});
      x += wide;
    }
    return rows;
  }

  draw(context) {
    context.fillStyle = this.colour('ground');
    context.fillRect(0, 0, this.width, this.height + 1);
    context.font = `13px ${this.font}`;
    context.textBaseline = 'middle';
    let y = MARGIN_PX + LINE_PX / 2;
    this.lines.forEach((line, k) => {
      this.write(context, line, MARGIN_PX, y, k ? 'dim' : 'text');
      y += LINE_PX;
    });
    y = this.drawLegend(context, y);
    this.drawScale(context, y);
  }

  write(context, text, x, y, colour) {
    context.fillStyle = this.colour(colour);
    context.fillText(text, x, y);
  }

  /** Gives where the next line stands. */
  drawLegend(context, y) {
    if (!this.legend) return y;
    this.write(context, `Points: ${this.legend.title}`, MARGIN_PX, y, 'dim');
    if (this.legend.stops) this.drawBar(context, y + LINE_PX);
    this.rows.forEach((row, k) => this.drawRow(context, row, y + (k + 1) * LINE_PX));
    return y + (1 + Math.max(this.rows.length, 1)) * LINE_PX;
  }

  drawBar(context, y) {
    const {stops, low, high} = this.legend;
    const left = MARGIN_PX + this.widthOf(low) + 8;
    const gradient = context.createLinearGradient(left, 0, left + BAR_PX, 0);
    stops.forEach((stop, k) => gradient.addColorStop(k / (stops.length - 1), stop));
    context.fillStyle = gradient;
    context.fillRect(left, y - 5, BAR_PX, 10);
    this.write(context, low, MARGIN_PX, y, 'text');
    this.write(context, high, left + BAR_PX + 8, y, 'text');
  }

  drawRow(context, row, y) {
    for (const {name, colour, x} of row) {
      context.fillStyle = colour || this.colour('ground');
      context.fillRect(x, y - SWATCH_PX / 2, SWATCH_PX, SWATCH_PX);
      this.write(context, name, x + SWATCH_PX + 6, y, 'text');
    }
  }

  /** As in the view, for its middle. */
  drawScale(context, y) {
    const long_px = byId('scale-bar').offsetWidth;
    context.strokeStyle = this.colour('text');
    context.lineWidth = 2;
    context.beginPath();
    context.moveTo(MARGIN_PX, y - 3);
    context.lineTo(MARGIN_PX, y + 4);
    context.lineTo(MARGIN_PX + long_px, y + 4);
    context.lineTo(MARGIN_PX + long_px, y - 3);
    context.stroke();
    const words = `${byId('scale-text').textContent} in the middle of the view`;
    this.write(context, words, MARGIN_PX + long_px + 10, y, 'text');
  }
}
