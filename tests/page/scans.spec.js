// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Scans of sensors that are more than a sweep of single ranges: several echoes, and pictures of cameras.
import {configuration, expect, open, test, withScan} from './page.js';
import {hash, lookFrom} from './eye.js';
import {readPng} from './png.js';

test('draws the second and third echoes', async ({page, start}, info) => {
  const daemon = await start(configuration(info, 'materials.sdf', {multi: {
    model: 'UTM-30LX-EW', mount: {xyz: [0, 0, 0.3]}, tcp: '127.0.0.1:0', accuracy: 'material'}}));
  const [eye, at] = [[0, -0.5, 24], [0, 0, 0]];
  const drawn = async (echoes) => {
    await page.goto('about:blank');
    await open(page, daemon, hash(eye, at, {rays: 'false', points: 'false', through: 'false', echoes}));
    await expect.poll(async () => (await daemon.get('/sensors/robot/multi')).casts.embree).toBeGreaterThan(0);
    await page.waitForTimeout(1000);
    return readPng(await page.screenshot());
  };
  const [without, all] = [await drawn('false'), await drawn('true')];
  const truth = await daemon.get('/sensors/robot/multi/truth');
  const further = truth.sent_echoes_mm.flatMap((echoes, i) =>
    echoes.slice(1).map((mm) => ({mm, step: truth.steps[i]})));
  expect(further.length).toBeGreaterThan(20);
  const project = lookFrom(eye, at, await page.locator('#canvas').boundingBox());
  // A UTM-30LX-EW has 1440 steps a turn, and step 540 looks ahead.
  const changed = further.filter(({mm, step}) => {
    const angle = (step - 540) * 2 * Math.PI / 1440;
    const place = project([mm / 1000 * Math.cos(angle), mm / 1000 * Math.sin(angle), 0.3]);
    const [x, y] = [Math.round(place.x), Math.round(place.y)];
    const [a, b] = [all.at(x, y), without.at(x, y)];
    return Math.hypot(...a.map((value, k) => value - b[k])) > 20;
  });
  // Noise moves echoes from scan to scan, and some lie behind a panel.
  expect(changed.length / further.length).toBeGreaterThan(0.4);
});

test('shows the picture of a camera', async ({page, start}, info) => {
  const daemon = await start(configuration(info, 'square_room.sdf', {camera: {
    camera: {columns: 32, rows: 24, fov_deg: [60, 45], rate_hz: 10, range_m: [0.1, 10]},
    mount: {xyz: [0, 0, 0.6]}}}));
  await open(page, daemon);
  await withScan(page);
  await expect(page.locator('.picture')).toBeVisible();
  const shown = await page.locator('.picture').evaluate((canvas) => {
    const {data} = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    return {width: canvas.width, height: canvas.height, data: [...data]};
  });
  const {columns, rows, range_m: ranges} = await daemon.get('/sensors/robot/camera/reading');
  expect([shown.width, shown.height]).toEqual([columns, rows]);
  // Viridis gets greener from near to far, all along.
  const green = (i) => shown.data[4 * i + 1];
  const pairs = ranges.map((range_m, i) => ({range_m, green: green(i)})).filter(({range_m}) => range_m)
    .sort((a, b) => a.range_m - b.range_m);
  expect(pairs.length).toBeGreaterThan(0.9 * columns * rows);
  for (let i = 1; i < pairs.length; ++i) {
    expect(pairs[i].green).toBeGreaterThanOrEqual(pairs[i - 1].green - 1);
  }
});

test('a wall that is seen rightly through glass is no error', async ({page, start}, info) => {
  const daemon = await start(configuration(info, 'materials.sdf', {single: {
    model: 'UST-10LX', mount: {xyz: [0, 0, 0.3]}, tcp: '127.0.0.1:0', accuracy: 'material'}}));
  const [eye, at] = [[0, -4, 8], [0, 4, 0.3]];
  await open(page, daemon, hash(eye, at, {rays: 'false', paint: 'error'}));
  await withScan(page);
  await page.waitForTimeout(1000);
  const pixels = readPng(await page.screenshot());
  const truth = await daemon.get('/sensors/robot/single/truth');
  const project = lookFrom(eye, at, await page.locator('#canvas').boundingBox());
  // The glass is 3 m to the left, and the wall behind it 5 m. Step 540 looks ahead.
  const through = truth.sent_mm.flatMap((mm, i) => {
    const angle = (truth.steps[i] - 540) * 2 * Math.PI / 1440;
    const [x, y] = [mm / 1000 * Math.cos(angle), mm / 1000 * Math.sin(angle)];
    return Math.abs(y - 5) < 0.05 && truth.true_m[i] * Math.sin(angle) < 3.1 ? [project([x, y, 0.3])] : [];
  });
  expect(through.length).toBeGreaterThan(30);
  // Red is what is wrong by three times the usual error, and more.
  const right = through.filter(({x, y}) => {
    const colour = pixels.at(Math.round(x), Math.round(y));
    return Math.max(...colour) > 150 && Math.max(...colour) - Math.min(...colour) < 170;
  });
  expect(right.length / through.length).toBeGreaterThan(0.8);
});

test('tells the materials of the points apart', async ({page, start}, info) => {
  const daemon = await start(configuration(info, 'materials.sdf', {single: {
    model: 'UTM-30LX', mount: {xyz: [0, 0, 0.3]}, tcp: '127.0.0.1:0', accuracy: 'ideal'}}));
  await open(page, daemon, hash([0, -0.5, 24], [0, 0, 0], {paint: 'material'}));
  await withScan(page);
  const looks = await page.locator('#legend .swatch').evaluateAll((swatches) => swatches.map((swatch) =>
    `${getComputedStyle(swatch).backgroundColor} ${swatch.className}`));
  const truth = await daemon.get('/sensors/robot/single/truth');
  const materials = new Set(truth.material.filter(Boolean));
  // More than there are colours.
  expect(materials.size).toBeGreaterThan(9);
  expect(looks.length).toBe(materials.size);
  expect(new Set(looks).size).toBe(looks.length);
});
