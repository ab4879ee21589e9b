// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What one takes along from the page: a picture, a recording, a link.
import {mkdirSync, readFileSync, writeFileSync} from 'node:fs';
import {SENSOR, WIDE, expect, open, test, withScan} from './page.js';
import {hash} from './eye.js';
import {readPng} from './png.js';
import {scene} from './daemon.js';

test.use(WIDE);

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
  await expect(page.locator('#kept')).toContainText(`Of ${SENSOR}`);
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

test('the daemon records the next scans, for whoever has the token', async ({page, start, complaints}, info) => {
  const [token, rig] = [info.outputPath('token'), info.outputPath('config.yaml')];
  mkdirSync(info.outputDir, {recursive: true});
  writeFileSync(token, 'a-token-of-this-test-0123456789', {mode: 0o600});
  writeFileSync(rig, `scene: ${scene('square_room.sdf')}
http: {listen: "127.0.0.1:0", token_file: token}
robots: {robot: {sensors: {scanner: {model: UST-10LX, accuracy: ideal, tcp: "127.0.0.1:0"}}}}
`);
  const daemon = await start(['--config', rig]);
  await page.goto(daemon.address);
  await page.locator('#token').fill('a-token-of-this-test-0123456789');
  await page.getByRole('button', {name: 'Continue'}).click();
  await withScan(page);
  await page.getByRole('tab', {name: 'Share'}).click();
  await page.getByLabel('The next').selectOption('10');
  const files = {};
  for (const [format, button] of Object.entries({mcap: 'MCAP', ubh: 'UBH', csv: 'CSV', jsonl: 'JSON lines'})) {
    const {name, bytes} = await save(page, button);
    expect(name).toMatch(new RegExp(`^robot-scanner-.*\\.${format}$`));
    files[format] = bytes;
  }
  expect(files.mcap.subarray(0, 5).toString('latin1')).toBe('\x89MCAP');
  expect(files.ubh.toString()).toContain('UST-10LX');
  const {sent_mm: sent} = await daemon.get(`/sensors/${SENSOR}/truth`, 'a-token-of-this-test-0123456789');
  const lines = files.jsonl.toString().trimEnd().split('\n').map(JSON.parse);
  expect(lines.map(({distances_mm: mm}) => mm)).toEqual(Array(10).fill(sent));
  expect(files.csv.toString().trimEnd().split('\n').filter((line) => !line.startsWith('#')).length).toBe(10);

  await page.getByLabel('The next').selectOption('4000');
  await page.getByRole('button', {name: 'CSV', exact: true}).click();
  await expect(page.locator('#kept')).toContainText('Records 4000 scans');
  await page.getByRole('button', {name: 'Stop'}).click();
  await expect(page.locator('#kept')).toContainText(`Of ${SENSOR}`);
  await expect(page.locator('#notices')).not.toContainText('daemon');
  for (const text of complaints) expect(text).toMatch(/401/);
  complaints.length = 0;
});

test('what a link says wrongly is left out', async ({page, start}) => {
  const daemon = await start(ROOM);
  await open(page, daemon);
  await withScan(page);
  const chosen = () => page.evaluate(() => {
    const {paint, rays, trail_s, cut_m, scans, eye} = Object.fromEntries(new URLSearchParams(location.hash.slice(1)));
    // It depends on when the first scan came, but is above the room in any case.
    const [x, y, z] = (eye || '').split(',').map(Number);
    return {paint, rays, trail_s, cut_m, scans, looksDown: Math.abs(x) < 10 && Math.abs(y) < 10 && z > 5 && z < 20};
  });
  await page.locator('#view-all').click();
  await expect.poll(async () => (await chosen()).looksDown).toBe(true);
  const usual = await chosen();
  for (const wrong of ['eye=1e300,0,0&at=0,0,0', 'eye=1,2,3&at=1,2,3', 'eye=1,2&at=0,0,0', 'eye=a,b,c&at=0,0,0',
    'paint=x&colours=y&trail_s=-1&cut_m=1e300&scans=', 'trail_s=1e9&scans=0&panel=x&sensor=x&select=x:y',
    'rays=x&trail_s=3&scans=7']) {
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
