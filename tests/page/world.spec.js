// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The panel World: the air, another world, and what is saved of both.
import {SENSOR, expect, open, test} from './page.js';
import {Scip} from './scip.js';
import {room} from './room.js';

async function scan(daemon) {
  const scip = await Scip.connect(daemon.port);
  const ranges = await scip.scan();
  scip.close();
  return ranges;
}

test('fog is seen once scanners see the light', async ({page, start, complaints}) => {
  const daemon = await start(room());
  await open(page, daemon, '#panel=world');
  await page.getByText('The air:').click();
  await page.getByRole('button', {name: 'Add fog'}).click();
  await expect(page.locator('#notices')).toContainText('material');
  await page.locator('#air-accuracy').selectOption('material');
  await expect.poll(async () => (await daemon.get(`/sensors/${SENSOR}`)).errors.accuracy).toBe('material');
  const visibility = page.getByLabel('fog: how far people see, in m');
  await visibility.fill('1');
  await visibility.press('Enter');
  await expect.poll(() => daemon.get('/scene/media')).toMatchObject([{kind: 'fog', visibility_m: 1}]);
  // In fog of 1 m nobody sees the wall 4 m ahead.
  await expect.poll(async () => (await scan(daemon))[540]).toBeLessThan(3500);
  await visibility.fill('0.1');
  await visibility.press('Enter');
  await expect(page.locator('#notices')).toContainText('The air stays as it is');
  await expect(visibility).toHaveValue('1');
  for (const text of complaints.splice(0)) expect(text).toMatch(/400.*media/);
  await page.getByRole('button', {name: 'Add fog'}).click();
  await expect.poll(async () => (await daemon.get('/scene/media')).map(({kind}) => kind)).toEqual(['fog', 'dust']);
  await page.getByRole('button', {name: 'Remove dust'}).click();
  await page.getByRole('button', {name: 'Remove fog'}).click();
  await expect(page.locator('#air-state')).toHaveText('clear');
  await expect.poll(async () => Math.abs((await scan(daemon))[540] - 4000)).toBeLessThan(100);
});

test('another world is loaded, after a question if this one was changed', async ({page, start, complaints}) => {
  const daemon = await start(room());
  await open(page, daemon, '#panel=world');
  await page.getByText('Another world').click();
  await page.locator('#world-file').fill('nowhere.sdf');
  await page.getByRole('button', {name: 'Load it'}).click();
  await expect(page.locator('#notices')).toContainText('nowhere.sdf cannot be loaded');
  for (const text of complaints.splice(0)) expect(text).toMatch(/400.*scene/);
  await page.locator('#canvas').press('o');
  await expect(page.locator('#selected-name')).toHaveText('box 2');
  await page.locator('#world-file').fill('corridor.sdf');
  await page.locator('#world-form').getByRole('button', {name: 'Load it'}).click();
  await expect(page.locator('#ask-dialog')).toContainText('will be gone');
  await page.locator('#ask-go').click();
  await expect(page.locator('#world-name')).toHaveText('corridor.sdf');
  await expect.poll(async () => (await daemon.get('/scene')).models.map(({name}) => name)).not.toContain('box 2');
});
