// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The measuring tape, between places whose distance is known.
import {FRONT, room} from './room.js';
import {SENSOR, expect, near, open, test, withScan} from './page.js';
import {hash, lookFrom} from './eye.js';

const EYE = [0, -0.001, 9];
const AT = [0, 0, 0];

/** What the tape does not tell yet is NaN. */
async function measured(page) {
  const lines = (await page.locator('#tape').innerText()).replaceAll('−', '-').split('\n');
  const [length, along = '', bearing] = lines;
  const along_m = along.match(/-?[\d.]+/g) ?? [NaN, NaN, NaN];
  return {length_m: parseFloat(length), bearing_deg: parseFloat(bearing), along_m: along_m.map(Number)};
}

test('measures by clicks and by a drag, and moves nothing', async ({page, start}) => {
  const daemon = await start(room('-1,0,0'));
  await open(page, daemon, hash(EYE, AT, {rays: 'false', points: 'false'}));
  await expect.poll(async () => (await daemon.get(`/sensors/${SENSOR}`)).casts.embree).toBeGreaterThan(0);
  await page.waitForTimeout(500);
  const project = lookFrom(EYE, AT, await page.locator('#canvas').boundingBox());
  await page.locator('#view-measure').click();
  // Two places of the floor, which the walls do not hide from above.
  const [a, b] = [project([-2, -1, 0]), project([1, 0.5, 0])];
  await page.mouse.click(a.x, a.y);
  await page.mouse.move(b.x, b.y);
  await page.mouse.click(b.x, b.y);
  await page.mouse.move(b.x + 90, b.y + 40);
  await near(async () => (await measured(page)).along_m[0], 3, 0.03);
  const label = await page.locator('#tape').boundingBox();
  for (const {x, y} of [a, b]) {
    expect(x > label.x && x < label.x + label.width && y > label.y && y < label.y + label.height).toBe(false);
  }
  const floor = await measured(page);
  expect(Math.abs(floor.length_m - Math.hypot(3, 1.5))).toBeLessThan(0.03);
  expect(Math.abs(floor.along_m[1] - 1.5)).toBeLessThan(0.03);
  expect(Math.abs(floor.along_m[2])).toBeLessThan(0.002);
  expect(Math.abs(floor.bearing_deg - Math.atan2(1.5, 3) * 180 / Math.PI)).toBeLessThan(0.8);

  // Over the robot and on: it stays where it is, and so does the view.
  const [robot, top] = [project([-1, 0, 0.15]), project([3.05, 0, 2.5])];
  await page.mouse.move(robot.x, robot.y);
  await page.mouse.down();
  await page.mouse.move(top.x, top.y, {steps: 4});
  await page.mouse.up();
  await near(async () => (await measured(page)).along_m[0], 4.05, 0.05);
  expect((await measured(page)).along_m[2]).toBeGreaterThan(2.3);
  expect((await daemon.get('/robots/robot/pose')).xyz).toEqual([-1, 0, 0]);
  expect(await page.evaluate(() => new URLSearchParams(location.hash.slice(1)).get('eye'))).toBe(EYE.join());
  await expect(page.locator('#selected')).toBeHidden();
  await expect(page.locator('#reading')).toBeHidden();

  await page.keyboard.press('Escape');
  await expect(page.locator('#tape')).toBeHidden();
  await expect(page.locator('#view-measure')).toHaveAttribute('aria-pressed', 'false');
});

test('takes to the points of a scan', async ({page, start}) => {
  const daemon = await start(room('0,0,0'));
  const [eye, at] = [[1.9, 0, 1.3], [3, 0, 0.3]];
  await open(page, daemon, hash(eye, at, {rays: 'false'}));
  await withScan(page);
  const project = lookFrom(eye, at, await page.locator('#canvas').boundingBox());
  const {true_m: truth, poses: [{xyz: [, , z]}]} = await daemon.get(`/sensors/${SENSOR}/truth`);
  const place = (step) => {
    const angle = (step - FRONT) * 2 * Math.PI / 1440;
    return [truth[step] * Math.cos(angle), truth[step] * Math.sin(angle), z];
  };
  await page.locator('#canvas').press('y');
  const ends = [FRONT - 20, FRONT + 20];
  for (const step of ends) {
    // Some pixels beside it.
    const {x, y} = project(place(step));
    await page.mouse.click(x + 1, y + 3);
  }
  await page.mouse.move(20, 20);
  // Of the front wall, 3 m ahead, between 5 degrees to the right and to the left; ranges are told in mm.
  await near(async () => (await measured(page)).length_m, 6 * Math.tan(5 * Math.PI / 180), 0.002);
  expect(Math.abs((await measured(page)).along_m[0])).toBeLessThan(0.002);
});
