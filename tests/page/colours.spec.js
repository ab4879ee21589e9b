// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What has a colour on the page has the same one in the picture that `scipcat plot` draws.
import {readFileSync} from 'node:fs';
import path from 'node:path';
import {expect, open, test, withScan} from './page.js';
import {programs, run, scene} from './daemon.js';

const MARK = /fill:rgb\(([\d.]+)%,([\d.]+)%,([\d.]+)%\);[^>]* d="([^"]+)"/g;

/** {name: {colour, shape}} of the legend in an SVG of scipcat: each mark stands left of its text. */
function legendOf(svg) {
  const marks = [...svg.matchAll(MARK)].map(([, r, g, b, d]) => {
    const numbers = d.match(/-?[\d.]+/g).map(Number);
    const along = (k) => numbers.filter((_, i) => i % 2 === k);
    const middle = (list) => (Math.min(...list) + Math.max(...list)) / 2;
    const corners = new Set(along(0).map((x, i) => `${x},${along(1)[i]}`)).size;
    return {
      x: middle(along(0)), y: middle(along(1)), colour: [r, g, b].map((share) => Math.round(2.55 * share)),
      shape: d.includes('C') ? 'circle' : corners === 3 ? 'triangle' : 'square',
    };
  });
  const names = {};
  for (const [, x, y, name] of svg.matchAll(/<text [^>]*x="([\d.]+)" y="([\d.]+)"[^>]*>(\w+)<\/text>/g)) {
    const mark = marks.find((each) => Math.abs(each.x - x + 12) < 3 && Math.abs(each.y - y + 5) < 3);
    if (mark) names[name] = mark;
  }
  return names;
}

test('a material has the colour and the shape that scipcat plot gives it', async ({page, start}, info) => {
  const daemon = await start(['--config', scene('materials_demo.yaml'), '--http', '127.0.0.1:0', '--free-ports']);
  const sensors = (await daemon.get('/sensors')).map(({name}) => name);
  await open(page, daemon, `#paint=material&show=${sensors.join()}`);
  await withScan(page);
  const rows = page.locator('#legend li');
  const shown = () => rows.evaluateAll((items) => Object.fromEntries(items.map((item) => {
    const [swatch, text] = item.children;
    return [text.textContent, {
      colour: swatch.style.background.match(/\d+/g).map(Number), shape: swatch.className.replace('swatch ', '')}];
  })));
  // Of the fog in a corner.
  await expect(rows.last()).toHaveText('none');
  const compared = new Set();
  for (const target of daemon.ready.sensors.map(({tcp}) => `tcp://${tcp}`)) {
    const file = info.outputPath('materials.svg');
    await run(path.join(programs, 'scipcat'), ['plot', target, '--color', 'material', '--control',
      daemon.ready.control, '-o', file]);
    const [plot, legend] = [legendOf(readFileSync(file, 'utf8')), await shown()];
    for (const name of Object.keys(plot).filter((each) => each in legend)) {
      compared.add(name);
      expect(legend[name].shape, name).toBe(plot[name].shape);
      legend[name].colour.forEach((value, k) => expect(Math.abs(value - plot[name].colour[k]), name).toBeLessThan(2));
    }
  }
  expect(compared.size).toBeGreaterThan(10);
  expect([...compared]).toContain('none');
});
