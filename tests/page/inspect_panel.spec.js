// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The panel Inspect: a scan from above, step by step and over time, and the page that stands still and looks back.
import {AT, EYE, FRONT, room} from './room.js';
import {moduleOf} from './modules.js';
import {SENSOR, expect, near, open, test, withScan} from './page.js';
import {hash} from './eye.js';

async function inspect(page, daemon, rest = {}) {
  await open(page, daemon, hash(EYE, AT, {panel: 'inspect', ...rest}));
  await withScan(page);
  await expect(page.locator('#inspect-scan')).toBeVisible();
}

async function goTo(page, step) {
  await page.locator('#inspect-step').fill(String(step));
  await page.locator('#inspect-step').press('Enter');
  await expect(page.locator('#steps .marked th')).toHaveText(String(step));
}

/** The scans that the page gets from now on. */
async function received(page) {
  const {readScan} = await moduleOf('scan_message.js');
  const scans = [];
  page.on('websocket', (socket) => socket.on('framereceived', ({payload}) => {
    if (typeof payload === 'string') return;
    scans.push(readScan(payload.buffer.slice(payload.byteOffset, payload.byteOffset + payload.length)));
  }));
  return scans;
}

/** Of the pixels of the plot in the colour of what was sent: from where to where they lie. */
function dots(canvas) {
  const {width, height} = canvas;
  const other = Object.assign(document.createElement('canvas'), {width, height});
  const copy = other.getContext('2d', {willReadFrequently: true});
  copy.drawImage(canvas, 0, 0);
  const {data} = copy.getImageData(0, 0, width, height);
  const accent = getComputedStyle(canvas).getPropertyValue('--accent');
  const [r, g, b] = accent.match(/\w\w/g).map((hex) => parseInt(hex, 16));
  const box = {left: Infinity, right: 0, top: Infinity, bottom: 0};
  for (let i = 0; i < width * height; ++i) {
    const off = Math.abs(data[4 * i] - r) + Math.abs(data[4 * i + 1] - g) + Math.abs(data[4 * i + 2] - b);
    if (off > 30 || data[4 * i + 3] < 200) continue;
    const [x, y] = [(i % width) * canvas.clientWidth / width, Math.floor(i / width) * canvas.clientHeight / height];
    box.left = Math.min(box.left, x);
    box.right = Math.max(box.right, x);
    box.top = Math.min(box.top, y);
    box.bottom = Math.max(box.bottom, y);
  }
  return box;
}

test('plots a scan from above and lists its steps', async ({page, start}) => {
  const daemon = await start(room('0,0,0'));
  await inspect(page, daemon);
  // Ahead is on top. The walls are 3 m ahead and 2 m to each side, and the beams to the back end at (-2, ±2).
  await expect.poll(() => page.locator('#polar').evaluate(dots)).toMatchObject({top: expect.any(Number)});
  const {left, right, top, bottom} = await page.locator('#polar').evaluate(dots);
  expect((bottom - top) / (right - left)).toBeCloseTo(5 / 4, 1);
  const middle = {x: (left + right) / 2, y: top + 3 / 5 * (bottom - top)};
  const perMetre = (right - left) / 4;
  const click = (x_m, y_m) => page.locator('#polar').click({
    position: {x: middle.x - y_m * perMetre, y: middle.y - x_m * perMetre}});

  // The pillar around (1.5, 1.5), and the box around (1.8, -1.3).
  const seen = [[1, 1, 'pillar', 1.5 * Math.SQRT2 - 0.25], [1, -1, 'box', 1.5 * Math.SQRT2]];
  for (const [x_m, y_m, object, range_m] of seen) {
    await click(x_m, y_m);
    await near(async () => Number(await page.locator('#steps .marked th').textContent()),
      FRONT + Math.sign(y_m) * 180, 5);
    await goTo(page, FRONT + Math.sign(y_m) * 180);
    await expect(page.locator('#reading-facts')).toContainText(object);
    const sent_m = Number(await page.locator('#steps .marked td').nth(1).textContent());
    expect(Math.abs(sent_m - range_m)).toBeLessThan(0.002);
  }
  await page.locator('#polar').focus();
  await page.keyboard.press('ArrowLeft');
  await page.keyboard.press('PageUp');
  await expect(page.locator('#steps .marked th')).toHaveText(String(FRONT - 180 + 11));
  await expect(page.locator('#polar')).toHaveAttribute('aria-valuenow', String(FRONT - 180 + 11));
  await page.keyboard.press('Home');
  await expect(page.locator('#steps tbody tr').first().locator('th')).toHaveText('0');
});

test('the table has what was sent and what was true', async ({page, start}) => {
  const daemon = await start(room('0,0,0', 'sensor'));
  await inspect(page, daemon);
  await goTo(page, 700);
  await daemon.get(`/sensors/${SENSOR}/truth`);
  for (let tries = 0; ; ++tries) {
    const {scan, rows} = await page.locator('#panel-inspect').evaluate((panel) => ({
      scan: panel.querySelector('h2').textContent.match(/scan (\d+)$/)[1],
      rows: [...panel.querySelectorAll('#steps tbody tr')].map(
        (row) => [...row.children].map((cell) => cell.textContent)),
    }));
    const truth = await daemon.get(`/sensors/${SENSOR}/truth?scan=${scan}`).catch(() => null);
    if (!truth && tries < 60) {
      await page.waitForTimeout(100);
      continue;
    }
    expect(rows.length).toBe(11);
    expect(rows).toEqual(Array.from({length: 11}, (_, k) => 695 + k).map((step) => [
      String(step), ((step - FRONT) / 4).toFixed(2), (truth.sent_mm[step] / 1000).toFixed(3),
      truth.true_m[step].toFixed(3),
      String(Math.round(truth.sent_mm[step] - 1000 * truth.true_m[step])).replace('-', '−'),
      String(truth.intensity[step])]));
    break;
  }
});

test('watches steps over time', async ({page, start}) => {
  const daemon = await start(room('0,0,0', 'sensor'));
  const scans = await received(page);
  await inspect(page, daemon);
  for (const step of [FRONT, 700]) {
    await goTo(page, step);
    await page.locator('#watch').click();
  }
  await expect(page.locator('#watched li')).toHaveCount(2);
  const first = page.locator('#watched li').first();
  const count = async () => Number((await first.textContent()).match(/(\d+) scans/)?.[1] ?? 0);
  await expect.poll(count).toBeGreaterThan(20);
  await page.locator('#canvas').press('h');
  await expect(page.locator('#timeline')).toBeVisible();
  await expect(async () => {
    // What comes when it stands still already is not kept.
    const kept = scans.slice(0, await count());
    for (const [k, step] of [FRONT, 700].entries()) {
      const mm = kept.map(({arrays}) => arrays.sent_mm[step]);
      const mean = mm.reduce((sum, each) => sum + each, 0) / mm.length;
      const sigma = Math.sqrt(mm.reduce((sum, each) => sum + (each - mean) ** 2, 0) / (mm.length - 1));
      const summary = `${(mean / 1000).toFixed(3)} m, σ ${sigma.toFixed(1)} mm, ${mm.length} scans`;
      expect(await page.locator('#watched li').nth(k).textContent()).toContain(`step ${step}${summary}`);
    }
  }).toPass();
  await page.getByRole('button', {name: 'Stop watching step 700'}).click();
  await expect(page.locator('#watched li')).toHaveCount(1);
});

test('stands still, looks back, and goes on', async ({page, start}) => {
  const daemon = await start(room('-1,0,0'));
  await inspect(page, daemon, {select: 'robots:robot'});
  await goTo(page, FRONT);
  const True = page.locator('#reading-facts > div').nth(2);
  for (const x of [-1, 0, 1]) {
    await daemon.put('/robots/robot/pose', {xyz: [x, 0, 0]});
    await expect(True).toContainText(`${(3 - x).toFixed(3)} m`);
    await page.waitForTimeout(700);
  }
  await page.locator('#canvas').press('h');
  await expect(page.locator('#timeline-time')).toHaveText('0.00 s');
  await daemon.put('/robots/robot/pose', {xyz: [-2, 0, 0]});
  await page.waitForTimeout(300);
  const casts = async () => (await daemon.get(`/sensors/${SENSOR}`)).casts.embree;
  const before = await casts();
  await page.waitForTimeout(1000);
  expect(await casts()).toBe(before);
  await expect(True).toContainText('2.000 m');
  await expect(page.locator('#pose-x')).toHaveValue('1.000');

  const slider = page.locator('#timeline-slider');
  await slider.evaluate((input) => {
    input.valueAsNumber = Number(input.min);
    input.dispatchEvent(new Event('input'));
  });
  await expect(True).toContainText('4.000 m');
  await expect(page.locator('#pose-x')).toHaveValue('-1.000');
  await expect(page.locator('#steps .marked td').nth(1)).toHaveText('4.000');
  const first = await page.locator('#inspect-sensor').textContent();
  await page.keyboard.press('.');
  await expect(page.locator('#inspect-sensor')).not.toHaveText(first);
  await page.keyboard.press(',');
  await expect(page.locator('#inspect-sensor')).toHaveText(first);
  // A click in a plot goes to the time that it is at: its right end is the moment of the pause.
  const plot = page.locator('#ranges-over-time');
  const {width} = await plot.boundingBox();
  await plot.click({position: {x: width - 9, y: 60}});
  await expect(True).toContainText('2.000 m');

  // What is no longer shown cannot be looked at.
  await page.getByRole('tab', {name: 'Sensors'}).click();
  const box = page.getByLabel(`Show the scans of ${SENSOR}`);
  await box.uncheck();
  await expect(page.locator('#timeline')).toBeHidden();
  await box.check();
  await page.getByRole('tab', {name: 'Inspect'}).click();
  await expect(page.locator('#inspect-scan')).toBeVisible();
  await page.locator('#canvas').press('h');
  await page.locator('#timeline-live').click();
  await expect(page.locator('#timeline')).toBeHidden();
  await expect(True).toContainText('5.000 m');
  await near(async () => Number(await page.locator('#pose-x').inputValue()), -2, 0.001);
});

test('keeps a minute, and no more than its bytes', async () => {
  const {Recorder} = await moduleOf('recorder.js');
  const scans = new EventTarget();
  const recorder = new Recorder(scans);
  const send = (sensor, got_s, bytes) => scans.dispatchEvent(Object.assign(new Event('scan'), {
    detail: {sensor, kind: 'scan', scan: Math.round(10 * got_s), got_s, arrays: {sent_mm: new Uint8Array(bytes)}}}));
  for (let k = 0; k < 2000; ++k) send('a', k / 10, 1000);
  expect(recorder.of('a').length).toBe(601);
  expect(recorder.at('a', 170.55).got_s).toBe(170.5);
  expect(recorder.at('a', 0).got_s).toBe(139.9);
  expect(recorder.beside('a', 170.5, -1).got_s).toBe(170.4);
  for (let k = 0; k < 40; ++k) send('b', 200 + k / 10, 10e6);
  const bytes = ['a', 'b'].flatMap((sensor) => recorder.of(sensor))
    .reduce((sum, {arrays}) => sum + arrays.sent_mm.length, 0);
  expect(bytes).toBeLessThanOrEqual(200e6);
  expect(bytes).toBeGreaterThan(180e6);
  expect(recorder.of('b').length).toBe(20);
});
