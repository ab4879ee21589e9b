// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The panel World: the air, another world, and what is saved of both.
import {readdirSync, writeFileSync} from 'node:fs';
import path from 'node:path';
import {SENSOR, expect, open, test} from './page.js';
import {Scip} from './scip.js';
import {ahead, room} from './room.js';
import {run, scene} from './daemon.js';
import {poorContrasts, withoutName} from './readable.js';

async function scan(daemon) {
  const scip = await Scip.connect(daemon.port);
  const ranges = await scip.scan();
  scip.close();
  return ranges;
}

/** What is downloaded is unpacked by tar, which knows nothing of the page. */
async function saved(page, info) {
  const download = page.waitForEvent('download');
  await page.getByRole('button', {name: 'Save world and configuration'}).click();
  const file = info.outputPath((await download).suggestedFilename());
  await (await download).saveAs(file);
  await run('tar', ['xf', file, '-C', info.outputDir]);
  return file.replace(/\.tar$/, '/scipd.yaml');
}

function unlike(a, b) {
  return a.filter((mm, i) => Math.abs(mm - b[i]) > 2).length;
}

test('what is saved gives what is seen', async ({page, start}, info) => {
  const daemon = await start(room('-1,0.5,0.3'));
  const before = await scan(daemon);
  await daemon.put('/scene/models/box/pose', {xyz: [0.5, -0.6, 0.5], rpy: [0, 0, 0.4]});
  await daemon.put('/scene/media', [{kind: 'fog', visibility_m: 30}]);
  await open(page, daemon, '#panel=world');
  await page.locator('#canvas').press('o');
  await expect(page.locator('#selected-name')).toHaveText('box 2');
  await page.locator('#size-z').fill('1.25');
  await page.locator('#size-z').press('Enter');
  await expect.poll(async () => unlike(await scan(daemon), before)).toBeGreaterThan(50);
  const seen = await scan(daemon);
  const again = await start(['--config', await saved(page, info), '--free-ports']);
  expect(unlike(await scan(again), seen)).toBe(0);
  expect((await again.get('/scene/media')).map(({kind}) => kind)).toEqual(['fog']);
  const movable = async (each) => (await each.get('/scene')).models.filter((model) => model.movable)
    .map(({name}) => name).sort();
  expect(await movable(again)).toEqual(await movable(daemon));
  expect((await again.get('/robots/robot/pose')).xyz).toEqual((await daemon.get('/robots/robot/pose')).xyz);
});

const MAZE = `scene: ${scene('rescue_maze.sdf')}
http: 127.0.0.1:0
robots:
  rescue:
    pose: {xyz: [1, 1, 0]}
    poses: ${scene('rescue_maze.tum')}
    sensors:
      front: {model: UST-20LX, mount: {xyz: [0.2, 0, 0.25]}, tcp: "127.0.0.1:0"}
      rear: {model: URG-04LX, mount: {xyz: [-0.2, 0, 0.2], rpy: [0, 0, 3.14159]}, tcp: "127.0.0.1:0"}
  scout:
    sensors: {top: {model: UTM-30LX-EW, tcp: "127.0.0.1:0", profile: {serial: X0000001}}}
`;

test('meshes are saved with their world, and all scanners with theirs', async ({page, start}, info) => {
  const file = info.outputPath('maze.yaml');
  writeFileSync(file, MAZE);
  const daemon = await start(['--config', file]);
  await open(page, daemon, '#panel=world');
  const config = await saved(page, info);
  expect(readdirSync(path.join(path.dirname(config), 'meshes')).length).toBeGreaterThan(0);
  const again = await start(['--config', config]);
  const scanners = async (each) => (await each.get('/sensors')).map(({name, model, errors}) => ({name, model, errors}));
  expect(await scanners(again)).toEqual(await scanners(daemon));
  const materials = async (each) => (await each.get('/scene/objects')).objects.map(({material}) => material).sort();
  expect(await materials(again)).toEqual(await materials(daemon));
});

test('fog is seen once scanners see the light', async ({page, start, complaints}) => {
  const daemon = await start(room());
  await open(page, daemon, '#panel=world');
  await page.getByText('Fog, rain, dust:').click();
  await page.getByRole('button', {name: 'Add fog'}).click();
  await expect(page.locator('#notices')).toContainText('material');
  await page.locator('#air-accuracy').selectOption('material');
  await expect.poll(async () => (await daemon.get(`/sensors/${SENSOR}`)).errors.accuracy).toBe('material');
  const visibility = page.getByLabel('fog: visibility, in m');
  await expect(visibility).toBeVisible();
  expect(await page.evaluate(poorContrasts)).toEqual([]);
  expect(await page.evaluate(withoutName)).toEqual([]);
  await visibility.fill('1');
  await visibility.press('Enter');
  await expect.poll(() => daemon.get('/scene/media')).toMatchObject([{kind: 'fog', visibility_m: 1}]);
  // In fog of 1 m nobody sees the wall 4 m ahead.
  await expect.poll(async () => (await scan(daemon))[540]).toBeLessThan(3500);
  await visibility.fill('0.1');
  await visibility.press('Enter');
  await expect(page.locator('#notices')).toContainText('The air is unchanged');
  await expect(visibility).toHaveValue('1');
  for (const text of complaints.splice(0)) expect(text).toMatch(/400.*media/);
  await page.getByRole('button', {name: 'Add fog'}).click();
  await expect.poll(async () => (await daemon.get('/scene/media')).map(({kind}) => kind)).toEqual(['fog', 'dust']);
  await page.getByRole('button', {name: 'Remove dust'}).click();
  await page.getByRole('button', {name: 'Remove fog'}).click();
  await expect(page.locator('#air-state')).toHaveText('none');
  await expect.poll(async () => Math.abs((await scan(daemon))[540] - 4000)).toBeLessThan(100);
});

test('a robot outside of a newly loaded world is told, and brought in', async ({page, start}) => {
  const daemon = await start(['--pose', '12,12,0.5', '--accuracy', 'ideal']);
  await open(page, daemon, '#panel=world');
  await daemon.put('/scene', {file: scene('square_room.sdf')});
  const notice = page.locator('.notice').filter({hasText: 'robot is outside of this world.'});
  await notice.getByRole('button', {name: 'Bring it in'}).click();
  await expect(notice).toHaveCount(0);
  const pose = () => daemon.get('/robots/robot/pose');
  // The room is 6 m by 4 m around the origin.
  await expect.poll(async () => Math.abs((await pose()).xyz[0])).toBeLessThan(3);
  expect(Math.abs((await pose()).xyz[1])).toBeLessThan(2);
  expect((await pose()).xyz[2]).toBeCloseTo(0, 2);
  await expect.poll(() => ahead(daemon)).toBeLessThan(6);
  expect(Math.min(...(await scan(daemon)).filter((mm) => mm > 20))).toBeGreaterThan(400);
  await page.locator('#canvas').press('Control+z');
  await expect.poll(async () => (await pose()).xyz[0]).toBeCloseTo(12, 5);
  // A robot inside is not told of.
  await daemon.put('/robots/robot/pose', {xyz: [1, 1, 0]});
  await daemon.put('/scene', {file: scene('rescue_maze.sdf')});
  await expect(page.locator('#world-name')).toHaveText('rescue_maze.sdf');
  await page.waitForTimeout(1000);
  await expect(page.locator('.notice').filter({hasText: 'outside'})).toHaveCount(0);
});

test('another world is loaded, after a question if this one was changed', async ({page, start, complaints}) => {
  const daemon = await start(room());
  await open(page, daemon, '#panel=world');
  await page.getByText('Load another world').click();
  await page.locator('#world-file').fill('nowhere.sdf');
  await page.locator('#world-form').getByRole('button', {name: 'Load'}).click();
  await expect(page.locator('#notices')).toContainText('nowhere.sdf cannot be loaded');
  for (const text of complaints.splice(0)) expect(text).toMatch(/400.*scene/);
  await page.locator('#canvas').press('o');
  await expect(page.locator('#selected-name')).toHaveText('box 2');
  await page.locator('#world-file').fill('corridor.sdf');
  await page.locator('#world-form').getByRole('button', {name: 'Load'}).click();
  await expect(page.locator('#ask-dialog')).toContainText('will be lost');
  await page.locator('#ask-go').click();
  await expect(page.locator('#world-name')).toHaveText('corridor.sdf');
  await expect.poll(async () => (await daemon.get('/scene')).models.map(({name}) => name)).not.toContain('box 2');
});
