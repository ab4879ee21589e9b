// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The view as one works in it: straight down as on a plan, clicks that meet a point, and what steps aside.
import {SENSOR, expect, near, open, test, withScan} from './page.js';
import {hash, lookDown, lookFrom} from './eye.js';
import {AT, EYE, room} from './room.js';
import {poorContrasts, withoutName} from './readable.js';

test('from the top, what is higher is seen at the same place', async ({page, start}) => {
  const daemon = await start(room('-2,0,0'));
  await open(page, daemon, hash([0, 0, 9], AT, {top: '1'}));
  await expect(page.locator('#view-top')).toHaveAttribute('aria-pressed', 'true');
  const project = lookDown([0, 0, 9], AT, await page.locator('#canvas').boundingBox());
  // Somebody who looks from the middle sees the robot 0.9 m farther out, once it is 2.8 m up.
  await daemon.put('/robots/robot/pose', {xyz: [-2, 1, 2.8]});
  await page.waitForTimeout(500);
  const {x, y} = project([-2, 1]);
  await page.mouse.click(x, y);
  await expect(page.locator('#selected-name')).toHaveText('robot');
  await expect(page.locator('#pose-z')).toHaveValue('2.800');

  // What is dragged moves the plan, and keys come nearer.
  const at = () => page.evaluate(() => new URLSearchParams(location.hash.slice(1)).get('at'));
  const [from, to] = [project([0, -1.5]), project([0.5, -1])];
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(to.x, to.y, {steps: 4});
  await page.mouse.up();
  await expect.poll(async () => (await at()).split(',').map((each) => Math.round(10 * each))).toEqual([-5, -5, 0]);
  await page.locator('#view-all').click();
  await expect(page.locator('#view-top')).toHaveAttribute('aria-pressed', 'false');
  await expect.poll(() => page.url()).not.toContain('top=1');
  await page.locator('#canvas').press('t');
  await expect.poll(() => page.url()).toContain('top=1');
});

test('a click on a point of a scan selects nothing', async ({page, start}) => {
  const daemon = await start(room());
  const [eye, at] = [[-2.2, -1, 2], [1.5, 0.4, 0.2]];
  await open(page, daemon, hash(eye, at));
  await withScan(page);
  const {true_m, steps, poses: [{xyz}]} = await daemon.get(`/sensors/${SENSOR}/truth`);
  const i = steps.indexOf(600);
  const angle = (steps[i] - 540) * 2 * Math.PI / 1440;
  const point = [xyz[0] + true_m[i] * Math.cos(angle), xyz[1] + true_m[i] * Math.sin(angle), xyz[2]];
  const project = lookFrom(eye, at, await page.locator('#canvas').boundingBox());
  const [on, above] = [project(point), project([point[0], point[1], point[2] + 0.3])];
  await page.mouse.click(on.x, on.y);
  await page.waitForTimeout(300);
  await expect(page.locator('#selected')).toBeHidden();
  await page.mouse.click(above.x, above.y);
  await expect(page.locator('#selected-name')).toHaveText('room');
  await expect(page.locator('#selected-lock')).toHaveText('Unlock');
  // Under clock: wall there is no time to play.
  await expect(page.locator('#clock')).toBeHidden();
});

for (const width of [375, 1280]) {
  test(`legend and scale never cover the robot, ${width} pixels wide`, async ({page, start}) => {
    await page.setViewportSize({width, height: 740});
    const daemon = await start(room());
    await open(page, daemon, hash([0, 0, 9], AT, {top: '1', paint: 'material'}));
    await withScan(page);
    const box = await page.locator('#canvas').boundingBox();
    const project = lookDown([0, 0, 9], AT, box);
    const metres = 2 * Math.tan(25 * Math.PI / 180) * 9 / box.height;
    for (const id of ['legend', 'scale']) {
      const {x, y, width: across, height: down} = await page.locator(`#${id}`).boundingBox();
      const place = [(x + across / 2 - box.x - box.width / 2) * metres,
        (box.y + box.height / 2 - y - down / 2) * metres];
      await daemon.put('/robots/robot/pose', {xyz: [...place, 0]});
      const robot = project(place);
      for (const each of ['legend', 'scale']) {
        await expect.poll(async () => covers(await page.locator(`#${each}`).boundingBox(), robot), each).toBe(false);
      }
    }
  });
}

test('under clock: poses, time plays, stands still and steps', async ({page, start}) => {
  const daemon = await start([...room(), '--clock', 'poses']);
  const time_s = async () => (await daemon.get('/status')).time_s;
  await open(page, daemon, hash(EYE, AT));
  const before_s = await time_s();
  await page.getByRole('button', {name: 'Step'}).click();
  await near(time_s, before_s + 0.025, 1e-6);
  await page.locator('#clock-step-ms').selectOption('1000');
  await page.locator('#canvas').press('j');
  await near(time_s, before_s + 1.025, 1e-6);
  await expect(page.locator('#clock-rate')).toHaveText('paused: time waits for poses');
  expect(await page.evaluate(poorContrasts)).toEqual([]);
  expect(await page.evaluate(withoutName)).toEqual([]);

  await page.locator('#clock-factor').selectOption('5');
  await page.getByRole('button', {name: 'Play'}).click();
  const begun_ms = Date.now();
  await withScan(page);
  await expect.poll(time_s).toBeGreaterThan(before_s + 6);
  // At most as fast as was asked for; this machine may be slower, and the status may be older.
  expect(await time_s() - before_s - 1.025).toBeLessThan(5 * (Date.now() - begun_ms) / 1000 + 3);
  await page.getByRole('button', {name: 'Pause', exact: true}).click();
  await expect(page.getByRole('button', {name: 'Play'})).toBeVisible();
  await page.waitForTimeout(300);
  const stopped_s = await time_s();
  await page.waitForTimeout(700);
  expect(await time_s()).toBe(stopped_s);

  // Who drives sends stamps that time has not reached.
  await page.locator('#canvas').press('n');
  for (let i = 0; i < 5; ++i) await page.locator('#canvas').press('w', {delay: 150});
  await expect(page.locator('.notice.trouble')).toHaveCount(0);
  expect(await time_s() - stopped_s).toBeLessThan(0.001);
});

test('under clock: poses, time goes on once the page knows a pose', async ({page, start}) => {
  const daemon = await start([...room(), '--clock', 'poses']);
  const time_s = async () => (await daemon.get('/status')).time_s;
  let hear;
  const heard = new Promise((done) => { hear = done; });
  await page.routeWebSocket(/./, (socket) => {
    const server = socket.connectToServer();
    server.onMessage(async (message) => {
      await heard;
      socket.send(message);
    });
  });
  await open(page, daemon, hash(EYE, AT));
  // The status, which says that time goes by poses, comes another way, once a second.
  await page.waitForTimeout(2500);
  await expect(page.locator('#clock')).toBeHidden();
  const before_s = await time_s();
  hear();
  await page.getByRole('button', {name: 'Step'}).click();
  await near(time_s, before_s + 0.025, 1e-6);
});

function covers({x, y, width, height}, place) {
  return place.x > x && place.x < x + width && place.y > y && place.y < y + height;
}
