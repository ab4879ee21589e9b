// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What one adds, deletes and makes of other materials, what a driver of the scanner sees of it, and how it is undone.
import {readFileSync, writeFileSync} from 'node:fs';
import {WIDE, expect, near, open, test, withScan} from './page.js';
import {hash, lookFrom} from './eye.js';
import {scene} from './daemon.js';
import {Scip} from './scip.js';
import {AT, EYE, FRONT, ahead, room} from './room.js';

test.use(WIDE);

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
  const project = lookFrom(EYE, [0.5, 0, 0], await page.locator('#canvas').boundingBox());
  const {x: clientX, y: clientY} = project([0.5, 0, 0]);
  await page.dispatchEvent('#view', 'drop', {dataTransfer: dropped, clientX, clientY});
  await page.locator('#add-unit').selectOption('0.001');
  await page.locator('#add-material').selectOption('wood');
  await page.locator('#add-form').getByRole('button', {name: 'Add'}).click();
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
  await page.getByRole('button', {name: 'Unlock', exact: true}).click();
  await page.locator('#canvas').press('Delete');
  await page.locator('#ask-go').click();
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
  await page.getByRole('button', {name: 'Unlock', exact: true}).click();
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
  await page.getByRole('button', {name: 'Unlock', exact: true}).click();
  await page.locator('#canvas').press('Delete');
  await expect(page.locator('#ask-dialog')).toContainText('http_body_bytes');
  await page.locator('#ask-dialog').getByRole('button', {name: 'Cancel'}).click();
  expect(await models()).toEqual(atFirst);
  await page.locator('#canvas').press('Delete');
  await page.locator('#ask-go').click();
  await expect.poll(models).toEqual(atFirst.filter((name) => name !== 'box'));
  await expect(page.locator('#notices')).toContainText('box is gone.');
  await page.locator('#canvas').press('Control+z');
  await expect(page.locator('#notices')).toContainText('nothing to undo');
});

test('a model of the world is deleted only once it is unlocked, and a large one after a question',
  async ({page, start}) => {
    const daemon = await start(room());
    const models = async () => (await daemon.get('/scene')).models.map(({name}) => name);
    const atFirst = await models();
    await open(page, daemon, hash(EYE, AT, {select: 'models:room', panel: 'world'}));
    await expect(page.locator('#selected-name')).toHaveText('room');
    await page.locator('#canvas').press('Delete');
    await expect(page.locator('#notices')).toContainText('room belongs to the world and is locked.');
    await page.waitForTimeout(500);
    expect(await models()).toEqual(atFirst);
    await page.getByRole('button', {name: 'Unlock all'}).click();
    await expect(page.getByRole('button', {name: 'Unlock all'})).toBeHidden();
    await page.locator('#canvas').press('Delete');
    await expect(page.locator('#ask-dialog')).toContainText('It is larger than the robot: 6.');
    await page.locator('#ask-dialog').getByRole('button', {name: 'Cancel'}).click();
    expect(await models()).toEqual(atFirst);
    await page.locator('#canvas').press('Delete');
    await page.locator('#ask-go').click();
    await expect.poll(models).not.toContain('room');
    await page.locator('#canvas').press('Control+z');
    await expect.poll(models).toContain('room');
    // It was asked once.
    await page.getByRole('button', {name: /^room/}).click();
    await page.locator('#canvas').press('Delete');
    await expect.poll(models).not.toContain('room');
  });

test('a box stands where the pointer is, and its handles make it larger', async ({page, start}) => {
  const daemon = await start(room());
  await open(page, daemon, hash(EYE, AT));
  await withScan(page);
  const project = lookFrom(EYE, AT, await page.locator('#canvas').boundingBox());
  const there = project([0.5, 0, 0]);
  await page.mouse.move(there.x, there.y);
  await page.keyboard.press('o');
  await expect(page.locator('#selected-name')).toHaveText('box 2');
  const pose = async () => (await daemon.get('/scene/models/box%202/pose')).xyz;
  await near(async () => (await pose())[0], 0.5, 0.02);
  await near(() => ahead(daemon), 1.25, 0.03);

  // The side that looks at the robot comes 0.4 m nearer, and the one behind it stays.
  const [from, to] = [project([0.25, 0, 0.25]), project([-0.15, 0, 0.25])];
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(to.x, to.y, {steps: 4});
  await page.mouse.up();
  await near(() => ahead(daemon), 0.85, 0.03);
  await near(async () => (await pose())[0], 0.3, 0.02);
  await expect(page.locator('#size-x')).toHaveValue('0.90');
  await page.locator('#size-x').fill('0.3');
  await page.locator('#size-x').press('Enter');
  await near(() => ahead(daemon), 1.15, 0.03);
  await page.keyboard.press('Escape');
  for (let i = 0; i < 2; ++i) await page.locator('#canvas').press('Control+z');
  await near(() => ahead(daemon), 1.25, 0.03);
});

test('the card of what is inspected covers no handle', async ({page, start}) => {
  const daemon = await start(room());
  await open(page, daemon, hash(EYE, AT));
  await withScan(page);
  const project = lookFrom(EYE, AT, await page.locator('#canvas').boundingBox());
  const middle = project([0.5, 0, 0]);
  await page.mouse.move(middle.x, middle.y);
  await page.keyboard.press('o');
  await expect(page.locator('#selected-name')).toHaveText('box 2');
  const grips = [[0.75, 0, 0.25], [0.25, 0, 0.25], [0.5, 0.25, 0.25], [0.5, -0.25, 0.25], [0.5, 0, 0.5]].map(project);
  for (const place of [[0.5, 0, 0.5], [0.3, 0.2, 0.5], [0.7, -0.2, 0.5], [0.1, 0.3, 0], [0.1, -0.1, 0], [1, 0.1, 0]]) {
    const {x, y} = project(place);
    await page.mouse.move(x, y);
    await expect(page.locator('#reading')).toBeVisible();
    await expect.poll(async () => {
      const card = await page.locator('#reading').boundingBox();
      return grips.filter((grip) => grip.x > card.x && grip.x < card.x + card.width &&
        grip.y > card.y && grip.y < card.y + card.height).length;
    }, {message: place.join()}).toBe(0);
  }
});

test('a cylinder goes where one clicks', async ({page, start}) => {
  const daemon = await start(room());
  await open(page, daemon, hash(EYE, AT, {panel: 'world'}));
  await withScan(page);
  const project = lookFrom(EYE, AT, await page.locator('#canvas').boundingBox());
  await page.getByRole('button', {name: 'Add a cylinder'}).click();
  await expect(page.locator('#placing')).toBeVisible();
  const {x, y} = project([0, 0, 0]);
  await page.mouse.click(x, y);
  await expect(page.locator('#selected-name')).toHaveText('cylinder');
  await expect(page.locator('#placing')).toBeHidden();
  // Of 0.3 m across, seen from 1 m away.
  await near(() => ahead(daemon), 0.85, 0.03);
  await page.getByRole('button', {name: 'Add a box'}).click();
  await page.keyboard.press('Escape');
  await expect(page.locator('#placing')).toBeHidden();
  await page.getByRole('button', {name: 'Add a box'}).press('Enter');
  await expect(page.locator('#selected-name')).toHaveText('box 2');
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

test('what was begun in another world and ends in this one is not undone', async ({page, start}) => {
  const daemon = await start(room());
  await open(page, daemon);
  await page.route('**/scene/models', async (route) => {
    const answer = await route.fetch();
    await daemon.put('/scene', {file: scene('corridor.sdf')});
    await expect(page.locator('#world-name')).toHaveText('corridor.sdf');
    await route.fulfill({response: answer});
  });
  const answered = page.waitForResponse('**/scene/models');
  await page.locator('#canvas').press('o');
  await answered;
  await page.locator('#canvas').press('Control+z');
  await expect(page.locator('#notices')).toContainText('nothing to undo');
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
