// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the page says of a point, a ray or a wall, against the truth of that very scan and what a driver gets.
import {FRONT, room} from './room.js';
import {SENSOR, configuration, expect, open, test, withScan} from './page.js';
import {hash, lookFrom} from './eye.js';

// So near that neighbours of a scan lie 8 pixels apart.
const EYE = [1.9, 0, 1.3];
const AT = [3, 0, 0.3];

/** {label: text} of the card beside what is inspected. */
export async function reading(page) {
  await expect(page.locator('#reading')).toBeVisible();
  return page.locator('#reading').evaluate((card) => Object.fromEntries([
    ['name', card.querySelector('strong').textContent],
    ...[...card.querySelectorAll('dl > div')].map((row) => [...row.children].map((cell) => cell.textContent)),
  ]));
}

/** A card and the truth of the scan that it is of, which scipd keeps for a second. */
async function readingWithTruth(page, daemon, sensor = SENSOR) {
  for (let tries = 0; tries < 20; ++tries) {
    const card = await reading(page);
    const scan = Number(card.Age.match(/scan (\d+)/)[1]);
    const truth = await daemon.get(`/sensors/${sensor}/truth?scan=${scan}`).catch(() => null);
    if (truth) return {card, truth};
  }
  throw new Error('scipd has forgotten each scan that was read');
}

/** Where a step of a UST-10LX lies in W, which has 1440 steps a turn and looks ahead at 540. */
function placeOf({poses: [{xyz, q: [, , z, w]}]}, step, range_m) {
  const angle = 2 * Math.atan2(z, w) + (step - FRONT) * 2 * Math.PI / 1440;
  return [xyz[0] + range_m * Math.cos(angle), xyz[1] + range_m * Math.sin(angle), xyz[2]];
}

async function look(page, daemon, settings = {}, eye = EYE, at = AT) {
  await page.goto('about:blank');
  await open(page, daemon, hash(eye, at, settings));
  const box = await page.locator('#canvas').boundingBox();
  return lookFrom(eye, at, box);
}

test('tells of a point what was sent of it and what was true', async ({page, start}) => {
  const daemon = await start(room('0,0,0', 'sensor'));
  const project = await look(page, daemon, {rays: 'false'});
  await withScan(page);
  const {sent_mm: mm, ...truth} = await daemon.get(`/sensors/${SENSOR}/truth`);
  for (const step of [FRONT, FRONT + 13]) {
    const {x, y} = project(placeOf(truth, step, mm[step] / 1000));
    await page.mouse.move(x, y);
    await expect(page.locator('#reading-name')).toHaveText(new RegExp(`^${SENSOR}, step \\d+$`));
    const {card, truth: then} = await readingWithTruth(page, daemon);
    // Noise moves a point by some pixels, so a neighbour may lie nearer by now.
    const read = Number(card.name.match(/\d+$/)[0]);
    expect(Math.abs(read - step)).toBeLessThan(4);
    expect(card.Angle).toBe(`${((read - FRONT) / 4).toFixed(2)}°`);
    expect(card.Sent).toBe(`${(then.sent_mm[read] / 1000).toFixed(3)} m`);
    const error_mm = Math.round(then.sent_mm[read] - 1000 * then.true_m[read]);
    expect(card.True).toMatch(new RegExp(`^${then.true_m[read].toFixed(3)} m, error [+−]${Math.abs(error_mm)} mm$`));
    expect(card.Intensity).toBe(String(then.intensity[read]));
    expect([card.Cause, card.Material, card.Object]).toEqual(['measured', then.material[read], then.object[read]]);
    expect(parseFloat(card.Age)).toBeLessThan(5);
  }
  // Nothing can be pressed that goes when the pointer comes.
  await expect(page.locator('#reading-close')).toBeHidden();
  await page.mouse.move(10, 10);
  await expect(page.locator('#reading')).toBeHidden();
});

test('what is clicked stays read, through faults and moves', async ({page, start}) => {
  const daemon = await start(room('0,0,0'));
  const project = await look(page, daemon, {}, [1.5, -0.4, 1.3], [1.5, 0, 0.2]);
  await withScan(page);
  const truth = await daemon.get(`/sensors/${SENSOR}/truth`);
  const middle = project(placeOf(truth, FRONT, 1.5));
  await page.mouse.click(middle.x, middle.y);
  await page.mouse.move(10, 10);
  expect(await reading(page)).toMatchObject({
    name: `${SENSOR}, step ${FRONT}`, Angle: '0.00°', Sent: '3.000 m', True: '3.000 m, error +0 mm'});
  await daemon.post(`/sensors/${SENSOR}/faults`, {kind: 'stick', steps: [500, 580], range_m: 1});
  await expect.poll(async () => (await reading(page)).Sent).toBe('1.000 m');
  expect(await reading(page)).toMatchObject({True: '3.000 m, error −2000 mm', Fault: 'stick: the readings are stuck'});
  await daemon.put('/robots/robot/pose', {xyz: [0, 0, 0], rpy: [0, 0, Math.PI / 2]});
  await expect.poll(async () => (await reading(page)).True).toBe('2.000 m, error −1000 mm');
  await page.locator('#reading-close').click();
  await expect(page.locator('#reading')).toBeHidden();
});

test('a beam tells the faults that changed it, and no others', async ({page, start}) => {
  const daemon = await start(room('0,0,0'));
  await open(page, daemon, hash([0, -0.001, 9], [0, 0, 0], {panel: 'inspect'}));
  await withScan(page);
  const faultAt = async (step) => {
    await page.locator('#inspect-step').fill(String(step));
    await page.locator('#inspect-step').press('Enter');
    await expect(page.locator('#reading-name')).toHaveText(`${SENSOR}, step ${step}`);
    return (await reading(page)).Fault;
  };
  expect(await faultAt(FRONT)).toBe(undefined);
  await daemon.post(`/sensors/${SENSOR}/faults`, {kind: 'dirty', steps: [FRONT - 20, FRONT], reads: 'near'});
  await daemon.post(`/sensors/${SENSOR}/faults`, {kind: 'blind', steps: [FRONT, FRONT + 20]});
  await expect.poll(() => faultAt(FRONT - 1)).toBe('dirty: the window is dirty');
  await expect.poll(() => faultAt(FRONT + 1)).toBe('blind: the sector is blind');
  const faults = (await faultAt(FRONT)).split('; ').sort();
  expect(faults).toEqual(['blind: the sector is blind', 'dirty: the window is dirty']);
  for (const step of [FRONT - 21, FRONT + 21]) expect(await faultAt(step)).toBe(undefined);
  await daemon.send('DELETE', `/sensors/${SENSOR}/faults`);
  await expect.poll(() => faultAt(FRONT)).toBe(undefined);
});

test('a ray tells its echoes, or the code and the cause of none', async ({page, start}, info) => {
  const daemon = await start(configuration(info, 'materials.sdf', {multi: {
    model: 'UTM-30LX-EW', mount: {xyz: [0, 0, 0.3]}, tcp: '127.0.0.1:0', accuracy: 'material'}}));
  const project = await look(page, daemon, {points: 'false', sensor: 'robot/multi'}, [0, -0.5, 24], [0, 0, 0]);
  const truthOf = (scan) => daemon.get(`/sensors/robot/multi/truth${scan ? `?scan=${scan}` : ''}`);
  await expect.poll(async () => (await truthOf().catch(() => null))?.cause?.length).toBeGreaterThan(0);
  const first = await truthOf();
  const further = first.steps.find((step) => step % 9 === 0 && first.sent_echoes_mm[step].length > 1);
  const dark = first.cause.indexOf('too_dark') + 3;
  for (const step of [further, dark]) {
    const {x, y} = project(placeOf(first, step, 1.5));
    await page.mouse.move(x, y);
    const {card, truth} = await readingWithTruth(page, daemon, 'robot/multi');
    const read = Number(card.name.match(/step (\d+)$/)[1]);
    expect(Math.abs(read - step)).toBeLessThan(2);
    const echoes = truth.sent_echoes_mm[read].map((mm, k) =>
      `${(mm / 1000).toFixed(3)} m (${truth.sent_echoes_intensity[read][k]})`);
    expect(card.Echoes).toBe(echoes.join(', ') || 'none');
    expect(card.Object).toBe(truth.object[read]);
    expect(truth.cause[read]).toBe(step === dark ? 'too_dark' : 'measured');
    if (step !== dark) continue;
    expect(card).toMatchObject({Sent: `no range, code ${truth.sent_mm[read]}`, Cause: 'too little light came back',
      True: `${truth.true_m[read].toFixed(3)} m`});
  }
});

test('a wall tells its name, its material and its place', async ({page, start}) => {
  const daemon = await start(room('0,0,0'));
  const project = await look(page, daemon, {rays: 'false'}, [0, -0.001, 9], [0, 0, 0]);
  await withScan(page);
  // On top of the front wall, which is 0.1 m thick from x = 3 on and 2.5 m high.
  const {x, y} = project([3.05, 0.5, 2.5]);
  await page.mouse.move(x, y);
  const card = await reading(page);
  expect(card).toMatchObject({name: expect.stringContaining('front'), Material: 'wall', Model: 'room'});
  const [px, py, pz] = card.Place.split(',').map(parseFloat);
  expect(Math.abs(px - 3.05)).toBeLessThan(0.05);
  expect(Math.abs(py - 0.5)).toBeLessThan(0.02);
  expect(pz).toBeCloseTo(2.5, 2);
  const {poses: [{xyz}]} = await daemon.get(`/sensors/${SENSOR}/truth`);
  const away_m = Math.hypot(px - xyz[0], py - xyz[1], pz - xyz[2]);
  expect(Math.abs(parseFloat(card.Away) - away_m)).toBeLessThan(0.002);
  await page.locator('#canvas').press('i');
  await expect(page.locator('#reading')).toBeHidden();
  await page.mouse.move(x + 1, y);
  await page.waitForTimeout(300);
  await expect(page.locator('#reading')).toBeHidden();
});
