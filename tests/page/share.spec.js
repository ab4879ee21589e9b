// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What one takes along from the page: a picture, scans as files, a link.
import {readFileSync} from 'node:fs';
import {SENSOR, expect, open, test, withScan} from './page.js';
import {hash} from './eye.js';
import {readPng} from './png.js';
import {scene} from './daemon.js';

const ROOM = ['--scene', scene('square_room.sdf'), '--accuracy', 'ideal'];

async function save(page, button) {
  const waiting = page.waitForEvent('download');
  await page.getByRole('button', {name: button, exact: true}).click();
  const download = await waiting;
  return {name: download.suggestedFilename(), bytes: readFileSync(await download.path())};
}

async function shared(page, daemon) {
  await open(page, daemon);
  await withScan(page);
  await page.getByRole('tab', {name: 'Share'}).click();
  await expect(page.locator('#kept')).toContainText('scans of');
  const {sent_mm: sent, intensity} = await daemon.get(`/sensors/${SENSOR}/truth`);
  return {sent, intensity};
}

test('a picture of the view tells what it shows', async ({page, start}) => {
  await page.addInitScript(() => {
    window.written = [];
    const write = CanvasRenderingContext2D.prototype.fillText;
    CanvasRenderingContext2D.prototype.fillText = function fillText(text, ...place) {
      window.written.push(text);
      write.call(this, text, ...place);
    };
  });
  const daemon = await start([...ROOM, '--seed', '18446744073709551615']);
  await shared(page, daemon);
  const {name, bytes} = await save(page, 'Save the view as PNG');
  expect(name).toMatch(/^scipd-.*\.png$/);
  const picture = readPng(bytes);
  const box = await page.locator('#canvas').boundingBox();
  expect(picture.width).toBe(Math.round(box.width));
  const below = picture.height - Math.round(box.height);
  expect(below).toBeGreaterThan(80);
  expect(below).toBeLessThan(200);
  const coloursAt = (y) => {
    const colours = new Set();
    for (let x = 0; x < picture.width; x += 5) colours.add(picture.at(x, y).join());
    return colours.size;
  };
  expect(coloursAt(Math.round(box.height / 2))).toBeGreaterThan(20);
  // The bar of the legend, somewhere below the view.
  const rows = Array.from({length: below}, (_, k) => coloursAt(picture.height - 1 - k));
  expect(Math.max(...rows)).toBeGreaterThan(20);

  const written = (await page.evaluate(() => window.written)).join('\n');
  const [low, high] = await page.locator('#legend .ends span').allTextContents();
  for (const part of ['square_room.sdf', `${SENSOR}: UST-10LX, accuracy ideal, seed 18446744073709551615, scan `,
    'Points: Range', low, high, 'in the middle of the view']) expect(written).toContain(part);
  expect(written).toMatch(/\d{4}-\d\d-\d\d \d\d:\d\d:\d\d\.\d UTC/);
  expect(written).toMatch(/scan \d+ at [\d.]+ s/);
});

test('scans are saved as CSV, JSON lines and UBH', async ({page, start}) => {
  const daemon = await start(ROOM);
  const {sent, intensity} = await shared(page, daemon);

  const csv = (await save(page, 'CSV')).bytes.toString().trimEnd().split('\n');
  const rows = csv.filter((line) => !line.startsWith('#')).map((line) => line.split(',').map(Number));
  expect(rows.length).toBeGreaterThan(1);
  expect(rows[0].slice(2, 2 + sent.length)).toEqual(sent);
  expect(rows[0].slice(2 + sent.length)).toEqual(intensity);
  // As scipcat says, by what PP tells: a UST-10LX sends nothing below 21 mm, and its DMIN is 20.
  expect(csv.find((line) => line.includes('is a code'))).toContain('not within 20 to 30000 is a code');
  expect(csv.find((line) => line.includes('host_time_s,'))).toMatch(/distance_mm_0,.*intensity_1080$/);

  const lines = (await save(page, 'JSON lines')).bytes.toString().trimEnd().split('\n').map(JSON.parse);
  expect(lines[0]).toMatchObject({
    model: 'UST-10LX', first_step: 0, cluster: 1, dmin_mm: 20, dmax_mm: 30000,
    distances_mm: sent, intensities: intensity});
  expect(lines[0].first_angle_rad).toBeCloseTo(-0.75 * Math.PI, 9);
  expect(lines[0].serial).toBeTruthy();

  const {name, bytes} = await save(page, 'UBH');
  expect(name).toMatch(/\.ubh$/);
  const ubh = bytes.toString().trimEnd().split('\n');
  const value = (key) => ubh[ubh.indexOf(`[${key}]`) + 1];
  expect(value('model')).toBe('UST-10LX');
  expect(value('minDistance')).toBe('20');
  expect(value('captureMode')).toBe('ME_Capture_mode');
  expect(['startStep', 'endStep', 'frontStep', 'totalSteps'].map(value)).toEqual(['0', '1080', '540', '1440']);
  expect(value('logtime')).toMatch(/^\d{4}-\d\d-\d\d \d\d:\d\d:\d\d\.\d{3}$/);
  expect(value('scan').split(';').map((step) => step.split('|').map(Number)))
    .toEqual(sent.map((mm, i) => [mm, intensity[i]]));
});

test('what a link says wrongly is left out', async ({page, start}) => {
  const daemon = await start(ROOM);
  await open(page, daemon);
  await withScan(page);
  const chosen = () => page.evaluate(() => {
    const {paint, rays, trail_s, cut_m, keep_s, eye} = Object.fromEntries(new URLSearchParams(location.hash.slice(1)));
    // It depends on when the first scan came, but is above the room in any case.
    const [x, y, z] = (eye || '').split(',').map(Number);
    return {paint, rays, trail_s, cut_m, keep_s, looksDown: Math.abs(x) < 10 && Math.abs(y) < 10 && z > 5 && z < 20};
  });
  await page.locator('#view-all').click();
  await expect.poll(async () => (await chosen()).looksDown).toBe(true);
  const usual = await chosen();
  for (const wrong of ['eye=1e300,0,0&at=0,0,0', 'eye=1,2,3&at=1,2,3', 'eye=1,2&at=0,0,0', 'eye=a,b,c&at=0,0,0',
    'paint=x&colours=y&trail_s=-1&cut_m=1e300&keep_s=', 'trail_s=1e9&keep_s=0&panel=x&sensor=x&select=x:y',
    'rays=x&trail_s=3&keep_s=7']) {
    await page.goto('about:blank');
    await open(page, daemon, `#${wrong}`);
    await withScan(page);
    await page.locator('#view-all').click();
    await expect.poll(chosen, wrong).toEqual(usual);
  }
});

test('a link holds the view, the selection and what is shown', async ({page, start, context}) => {
  const daemon = await start(ROOM);
  await open(page, daemon, hash([1, -3, 4], [0.5, 0, 0]));
  await withScan(page);
  await page.keyboard.press('n');
  await page.locator('#canvas').press('c');
  await page.locator('#canvas').press('g');
  await page.getByRole('tab', {name: 'Share'}).click();
  await page.getByRole('button', {name: 'Copy a link'}).click();
  const link = await page.locator('#link').inputValue();

  const other = await context.newPage();
  await other.goto(link);
  await withScan(other);
  await expect(other.locator('#selected-name')).toHaveText('robot');
  await expect(other.locator('#legend-title')).toHaveText('Intensity');
  await expect(other.getByRole('tab', {name: 'Share'})).toHaveAttribute('aria-selected', 'true');
  await expect.poll(() => other.evaluate(() => new URLSearchParams(location.hash.slice(1)).get('eye')))
    .toBe('1,-3,4');
  await other.getByRole('tab', {name: 'World'}).click();
  await expect(other.getByLabel('Grid and axes')).not.toBeChecked();
});
