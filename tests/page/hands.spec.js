// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What one does to the world by hand, and what a driver of the scanner sees of it.
import {readFileSync, writeFileSync} from 'node:fs';
import {expect, near, open, test, withScan} from './page.js';
import {hash, lookFrom} from './eye.js';
import {Scip} from './scip.js';
import {scene} from './daemon.js';

// A room of 6 m by 4 m; from its origin the wall ahead is 3 m away.
const room = (pose = '-1,0,0', accuracy = 'ideal') =>
  ['--scene', scene('square_room.sdf'), '--pose', pose, '--accuracy', accuracy];
const EYE = [0, -0.001, 9];
const AT = [0, 0, 0];
const FRONT = 540;

async function ahead(daemon) {
  const scip = await Scip.connect(daemon.port);
  const scan = await scip.scan();
  scip.close();
  return scan[FRONT] / 1000;
}

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
  await near(async () => Math.min((await poseOf(daemon)).xyz[0], -0.8), -0.8, 0.001);
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

test('a mesh file that is added is seen by the scanner, and so is its material', async ({page, start}) => {
  const daemon = await start(room('-1,0,0', 'material'));
  await open(page, daemon, hash(EYE, [0.5, 0, 0]));
  await withScan(page);
  // A plate across the way, 1.5 m ahead, in millimetres.
  const stl = 'solid plate\n' + [[[0, -500, 0], [0, 500, 0], [0, 500, 800]],
    [[0, -500, 0], [0, 500, 800], [0, -500, 800]]].map((corners) =>
    `facet normal -1 0 0\nouter loop\n${corners.map((each) => `vertex ${each.join(' ')}\n`).join('')}` +
    'endloop\nendfacet\n').join('') + 'endsolid plate\n';
  const dropped = await page.evaluateHandle((text) => {
    const transfer = new DataTransfer();
    transfer.items.add(new File([text], 'plate.stl'));
    return transfer;
  }, stl);
  await page.dispatchEvent('#view', 'drop', {dataTransfer: dropped});
  await page.locator('#add-unit').selectOption('0.001');
  await page.locator('#add-material').selectOption('wood');
  await page.getByRole('button', {name: 'Add it'}).click();
  await expect(page.locator('#selected-name')).toHaveText('plate');
  await near(() => ahead(daemon), 1.5, 0.05);
  const material = async () => (await daemon.get('/sensors/robot/scanner/truth')).material[FRONT];
  expect(await material()).toBe('wood');
  await page.locator('#selected-material').selectOption('matt_black');
  await expect.poll(async () => { await ahead(daemon); return material(); }).toBe('matt_black');
  await page.keyboard.press('Escape');
  await page.locator('#canvas').press('Control+z');
  await expect.poll(async () => { await ahead(daemon); return material(); }).toBe('wood');
});

test('the page knows the materials that scipd knows', async ({page, start}) => {
  const known = readFileSync(scene('materials.yaml'), 'utf8').match(/^ {2}\w+:$/gm).map((line) => line.slice(2, -1));
  const daemon = await start(room());
  await open(page, daemon, hash(EYE, AT, {select: 'models:box'}));
  await expect(page.locator('#selected-name')).toHaveText('box');
  const offered = await page.locator('#selected-material option').allTextContents();
  expect(offered).toEqual(expect.arrayContaining(known));
});

test('a model of the world that was deleted comes back as it was', async ({page, start}) => {
  const daemon = await start(room('0,0,0'));
  const objects = async () => (await daemon.get('/scene/objects')).objects;
  const movable = (await objects()).find((object) => object.model !== 'room' && !object.robot);
  const scan = async () => {
    const scip = await Scip.connect(daemon.port);
    const ranges = await scip.scan();
    scip.close();
    return ranges;
  };
  const before = await scan();
  await open(page, daemon, hash(EYE, AT, {select: `models:${movable.model}`}));
  await expect(page.locator('#selected-name')).toHaveText(movable.model);
  await page.locator('#canvas').press('Delete');
  await expect.poll(async () => (await objects()).some(({model}) => model === movable.model)).toBe(false);
  const without = await scan();
  expect(without.filter((mm, i) => Math.abs(mm - before[i]) > 5).length).toBeGreaterThan(5);
  await page.locator('#canvas').press('Control+z');
  await expect.poll(async () => (await objects()).some(({model}) => model === movable.model)).toBe(true);
  const again = await scan();
  expect(again.filter((mm, i) => Math.abs(mm - before[i]) > 5).length).toBe(0);
  const back = (await objects()).find(({model}) => model === movable.model);
  expect(back.material).toBe(movable.material);
});

// Two boxes in one link, each of its own material.
const PAIR = `<sdf version='1.9' xmlns:scipd='urn:scipd:sdf'><model name='pair'><link name='l'>${
  [['wood', 0], ['matt_black', 1]].map(([material, y]) =>
    `<visual name='${material}'><pose>0 ${y} 0.25 0 0 0</pose><scipd:material>${material}</scipd:material>` +
    '<geometry><box><size>.5 .5 .5</size></box></geometry></visual>').join('')}</link></model></sdf>`;

test('a model of several materials that was made of one gets them back', async ({page, start}) => {
  const daemon = await start(room());
  await daemon.post('/scene/models', {name: 'pair', sdf: PAIR});
  const materials = async () => (await daemon.get('/scene/objects')).objects
    .filter(({model}) => model === 'pair').map(({material}) => material);
  const before = await materials();
  expect(new Set(before).size).toBe(2);
  await open(page, daemon, hash(EYE, AT, {select: 'models:pair'}));
  await expect(page.locator('#selected-material')).toHaveValue('');
  await page.locator('#selected-material').selectOption('metal');
  await expect.poll(materials).toEqual(['metal', 'metal']);
  await page.locator('#canvas').press('Control+z');
  await expect.poll(materials).toEqual(before);
});

test('a box that was made of something else comes back so', async ({page, start}) => {
  const daemon = await start(room());
  const box = async () => (await daemon.get('/scene/objects')).objects.find(({model}) => model === 'box 2')?.material;
  await open(page, daemon, hash(EYE, AT));
  await page.locator('#canvas').press('o');
  await expect(page.locator('#selected-name')).toHaveText('box 2');
  await page.locator('#selected-material').selectOption('matt_black');
  await expect.poll(box).toBe('matt_black');
  await page.locator('#canvas').press('Delete');
  await expect.poll(box).toBe(undefined);
  await page.locator('#canvas').press('Control+z');
  await expect.poll(box).toBe('matt_black');
});

test('a model that is too large to be brought back goes only when that is clear', async ({page, start}, info) => {
  const config = info.outputPath('config.yaml');
  writeFileSync(config, `scene: ${scene('square_room.sdf')}
http: 127.0.0.1:0
limits: {http_body_bytes: 500}
robots: {robot: {sensors: {scanner: {model: UST-10LX, tcp: "127.0.0.1:0"}}}}
`);
  const daemon = await start(['--config', config]);
  const models = async () => (await daemon.get('/scene')).models.map(({name}) => name);
  const atFirst = await models();
  await open(page, daemon, hash(EYE, AT, {select: 'models:box'}));
  await expect(page.locator('#selected-name')).toHaveText('box');
  await page.locator('#canvas').press('Delete');
  await expect(page.locator('#ask-dialog')).toContainText('http_body_bytes');
  await page.getByRole('button', {name: 'Keep it'}).click();
  expect(await models()).toEqual(atFirst);
  await page.locator('#canvas').press('Delete');
  await page.getByRole('button', {name: 'Delete it'}).click();
  await expect.poll(models).toEqual(atFirst.filter((name) => name !== 'box'));
  await expect(page.locator('#notices')).toContainText('box is gone.');
  await page.locator('#canvas').press('Control+z');
  await expect(page.locator('#notices')).toContainText('nothing to undo');
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

test('nothing is undone in another world', async ({page, start}) => {
  const daemon = await start(room());
  await open(page, daemon);
  await page.locator('#canvas').focus();
  await page.keyboard.press('o');
  const models = async () => (await daemon.get('/scene')).models.map(({name}) => name);
  await expect.poll(models).toContain('box 2');
  await daemon.put('/scene', {file: scene('corridor.sdf')});
  await expect(page.locator('#world-name')).toHaveText('corridor.sdf');
  const there = await models();
  await page.locator('#canvas').focus();
  await page.keyboard.press('Control+z');
  await expect(page.locator('#notices')).toContainText('nothing to undo');
  expect(await models()).toEqual(there);
});

test('nothing is undone in the same world once it was loaded again', async ({page, start}) => {
  const daemon = await start(room());
  await open(page, daemon);
  await page.locator('#canvas').press('o');
  const models = async () => (await daemon.get('/scene')).models.map(({name}) => name);
  await expect.poll(models).toContain('box 2');
  await expect(page.locator('#selected-name')).toHaveText('box 2');
  await daemon.put('/scene', {file: scene('square_room.sdf')});
  await expect(page.locator('#selected')).toBeHidden();
  await daemon.post('/scene/models', {name: 'box 2', sdf: PAIR});
  await page.locator('#canvas').press('Control+z');
  await expect(page.locator('#notices')).toContainText('nothing to undo');
  expect(await models()).toContain('box 2');
});
