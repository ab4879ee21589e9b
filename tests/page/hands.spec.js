// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What one moves by hand, and what a driver of the scanner sees of it.
import {WIDE, expect, near, open, test, withScan} from './page.js';
import {hash, lookFrom} from './eye.js';
import {AT, EYE, ahead, room} from './room.js';

test.use(WIDE);

async function poseOf(daemon) {
  return daemon.get('/robots/robot/pose');
}

test('a robot that is dragged sees the room from elsewhere', async ({page, start}) => {
  const daemon = await start(room());
  const before_m = await ahead(daemon);
  await open(page, daemon, hash(EYE, AT));
  await withScan(page);
  const project = lookFrom(EYE, AT, await page.locator('#canvas').boundingBox());
  const [from, to] = [project([-1, 0, 0.15]), project([-0.5, 0.3, 0.15])];
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move((from.x + to.x) / 2, (from.y + to.y) / 2, {steps: 4});
  await page.mouse.move(to.x, to.y, {steps: 4});
  await page.mouse.up();
  await near(async () => (await poseOf(daemon)).xyz[0], -0.5, 0.03);
  await near(async () => (await poseOf(daemon)).xyz[1], 0.3, 0.03);
  const {xyz} = await poseOf(daemon);
  await near(() => ahead(daemon), before_m - (xyz[0] + 1), 0.02);

  await page.keyboard.press('Control+z');
  await near(async () => (await poseOf(daemon)).xyz[0], -1, 0.001);
  await near(() => ahead(daemon), before_m, 0.005);
});

test('the ring turns a robot', async ({page, start}) => {
  const daemon = await start(room());
  await open(page, daemon, hash(EYE, AT, {select: 'robots:robot'}));
  await expect(page.locator('#selected')).toBeVisible();
  const box = await page.locator('#canvas').boundingBox();
  const project = lookFrom(EYE, AT, box);
  const middle = project([-1, 0, 0]);
  const radius = project([-0.55, 0, 0.02]).x - middle.x;
  await page.mouse.move(middle.x + radius, middle.y);
  await page.mouse.down();
  await page.mouse.move(middle.x + radius * 0.7, middle.y - radius * 0.7, {steps: 4});
  await page.mouse.move(middle.x, middle.y - radius, {steps: 4});
  await page.mouse.up();
  await near(async () => 2 * Math.atan2(...(await poseOf(daemon)).q.slice(2)), Math.PI / 2, 0.1);
  expect((await poseOf(daemon)).xyz[0]).toBeCloseTo(-1, 3);
});

test('keys select, drive, add, delete and undo', async ({page, start}) => {
  const daemon = await start(room());
  const models = async () => (await daemon.get('/scene')).models.map(({name}) => name);
  const atFirst = await models();
  await open(page, daemon, hash(EYE, AT));
  await withScan(page);
  await page.keyboard.press('n');
  await expect(page.locator('#selected-name')).toHaveText('robot');
  await page.keyboard.down('w');
  // A page that draws slowly moves the robot by 0.2 m with each picture. The box will stand 0.75 m ahead.
  await expect.poll(async () => (await poseOf(daemon)).xyz[0], {intervals: [30]}).toBeGreaterThan(-0.95);
  await page.keyboard.up('w');
  await page.waitForTimeout(300);
  expect(Math.abs((await poseOf(daemon)).xyz[1])).toBeLessThan(0.01);

  await page.keyboard.press('o');
  await expect.poll(models).toEqual([...atFirst, 'box 2']);
  await expect(page.locator('#selected-name')).toHaveText('box 2');
  await near(() => ahead(daemon), -0.25 - (await poseOf(daemon)).xyz[0], 0.02);
  await page.keyboard.press('Delete');
  await expect.poll(models).toEqual(atFirst);
  await page.keyboard.press('Control+z');
  await expect.poll(models).toEqual([...atFirst, 'box 2']);
  await page.keyboard.press('Control+z');
  await expect.poll(models).toEqual(atFirst);
  await page.keyboard.press('Control+z');
  await near(async () => (await poseOf(daemon)).xyz[0], -1, 0.001);
});

test('a place that cannot be is not kept in the card', async ({page, start, complaints}) => {
  const daemon = await start(room());
  await open(page, daemon, hash(EYE, AT, {select: 'robots:robot'}));
  const [x, y] = [page.locator('#pose-x'), page.locator('#pose-y')];
  await expect(x).toHaveValue('-1.000');
  await x.fill('');
  await x.press('Enter');
  await expect(page.locator('#notices')).toContainText('A place is three numbers');
  await expect(x).toHaveValue('-1.000');
  expect((await poseOf(daemon)).xyz[0]).toBe(-1);
  await x.fill('1e9');
  await x.press('Enter');
  await expect(page.locator('#notices')).toContainText('robot cannot be moved');
  await expect(x).toBeFocused();
  await expect(x).toHaveValue('-1.000');
  // The browser itself tells of what is refused.
  for (const text of complaints.splice(0)) expect(text).toMatch(/400.*pose/);
  await y.fill('0.25');
  await daemon.put('/robots/robot/pose', {xyz: [0.5, 0, 0]});
  await expect(x).toHaveValue('0.500');
  await expect(y).toHaveValue('0.25');
  await y.press('Enter');
  await near(async () => (await poseOf(daemon)).xyz[1], 0.25, 1e-6);
  expect((await poseOf(daemon)).xyz[0]).toBe(0.5);
});

test('keys do nothing behind a dialog', async ({page, start}) => {
  const daemon = await start(room());
  const atFirst = (await daemon.get('/scene')).models.length;
  await open(page, daemon, hash(EYE, AT));
  await page.locator('#canvas').press('?');
  await expect(page.locator('#help-dialog')).toBeVisible();
  await page.evaluate(() => {
    document.activeElement.blur();
    for (const key of ['o', 'w']) document.body.dispatchEvent(new KeyboardEvent('keydown', {key, bubbles: true}));
  });
  await page.waitForTimeout(500);
  expect((await daemon.get('/scene')).models.length).toBe(atFirst);
  expect((await poseOf(daemon)).xyz[0]).toBe(-1);
  await page.keyboard.press('Escape');
  await expect(page.locator('#help-dialog')).toBeHidden();
  await page.locator('#canvas').press('o');
  await expect.poll(async () => (await daemon.get('/scene')).models.length).toBe(atFirst + 1);
});

test('a gamepad drives the robot', async ({page, start}) => {
  const daemon = await start(room());
  await page.addInitScript(() => {
    window.pad = {connected: true, axes: [0, 0, 0, 0], buttons: [{pressed: false}]};
    navigator.getGamepads = () => [window.pad];
  });
  await open(page, daemon, hash(EYE, AT));
  await withScan(page);
  await page.evaluate(() => {
    window.pad.axes[1] = -1;
    window.dispatchEvent(new Event('gamepadconnected'));
  });
  await near(async () => Math.min((await poseOf(daemon)).xyz[0], -0.7), -0.7, 0.001);
  await page.evaluate(() => { window.pad.axes = [-1, 0, 0, 0]; });
  await near(async () => Math.min((await poseOf(daemon)).q[2], 0.2), 0.2, 0.001);
  await page.evaluate(() => { window.pad.axes = [0, 0, 0, 0]; });
});

test('the view follows a robot', async ({page, start}) => {
  const daemon = await start(room());
  await open(page, daemon, hash(EYE, AT));
  await withScan(page);
  await page.keyboard.press('l');
  const looksAt = () => page.evaluate(() => new URLSearchParams(location.hash.slice(1)).get('at'));
  await expect.poll(looksAt).toBe('-1,0,0');
  await daemon.put('/robots/robot/pose', {xyz: [0.5, 1, 0], rpy: [0, 0, 1]});
  await expect.poll(looksAt).toBe('0.5,1,0');
  await page.keyboard.press('l');
  await daemon.put('/robots/robot/pose', {xyz: [0, 0, 0]});
  await page.waitForTimeout(1000);
  expect(await looksAt()).toBe('0.5,1,0');
});
