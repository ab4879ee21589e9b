// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Looking back while others go on: what comes and goes meanwhile, and what is there once one is back.
import {SENSOR, WIDE, expect, near, open, test, withScan} from './page.js';
import {AT, EYE, room} from './room.js';
import {hash, lookFrom} from './eye.js';
import {readPng} from './png.js';
import {scene} from './daemon.js';

test.use(WIDE);

const SECOND = {name: 'second/scanner', model: 'UST-10LX', tcp: '127.0.0.1:0', pose: {xyz: [1.5, 1.2, 0]}};

/** Whether many pixels around a place in the world are of the blue of a robot without a body. */
async function isRobotAt(page, xyz) {
  const {x, y} = lookFrom(EYE, AT, await page.locator('#canvas').boundingBox())(xyz);
  const pixels = readPng(await page.screenshot());
  let found = 0;
  for (let u = -18; u <= 18; ++u) {
    for (let v = -18; v <= 18; ++v) {
      const [r, g, b] = pixels.at(Math.round(x) + u, Math.round(y) + v);
      found += b > 110 && b > 1.4 * g && b > 2 * r;
    }
  }
  return found > 0.4 * 37 ** 2;
}

async function seek(page, end) {
  await page.locator('#timeline-slider').evaluate((input, which) => {
    input.valueAsNumber = Number(input[which]);
    input.dispatchEvent(new Event('input'));
  }, end);
}

/** There is nothing to stand still at before the first scan of what is shown. */
async function standStill(page) {
  await expect(async () => {
    await page.locator('#view-pause[aria-pressed="false"]').click();
    await expect(page.locator('#timeline')).toBeVisible({timeout: 1000});
  }).toPass();
}

test('a robot that was taken away is seen in the past, and only there', async ({page, start}) => {
  const daemon = await start(room());
  await daemon.post('/sensors', SECOND);
  const isSeen = () => isRobotAt(page, SECOND.pose.xyz);
  await open(page, daemon, hash(EYE, AT, {panel: 'world', sensor: SENSOR, show: SENSOR}));
  await withScan(page);
  await expect.poll(isSeen).toBe(true);
  await daemon.send('DELETE', `/sensors/${SECOND.name}`);
  await expect(page.locator('#things')).not.toContainText('second');
  await expect.poll(isSeen).toBe(false);

  await page.locator('#canvas').press('h');
  await expect(page.locator('#timeline')).toBeVisible();
  await seek(page, 'min');
  await expect.poll(isSeen).toBe(true);
  await page.locator('#timeline-live').click();
  await expect.poll(isSeen).toBe(false);
  await expect(page.locator('#things')).not.toContainText('second');
});

test('one who looks back goes on while things come and go', async ({page, start}) => {
  const daemon = await start(room());
  await daemon.post('/sensors', SECOND);
  await open(page, daemon, hash(EYE, AT, {panel: 'world', sensor: SECOND.name, show: SECOND.name}));
  await withScan(page);
  let before;
  await expect(async () => {
    await page.locator('#view-pause[aria-pressed="false"]').click();
    await seek(page, 'min');
    before = await page.locator('#timeline-time').textContent();
    const isPast = parseFloat(before.replace('−', '-')) < -0.2;
    if (!isPast) await page.locator('#timeline-live').click();
    expect(isPast).toBe(true);
  }).toPass();
  const staysThere = async () => {
    await page.waitForTimeout(1500);
    await expect(page.locator('#timeline')).toBeVisible();
    await expect(page.locator('#timeline-time')).toHaveText(before);
  };
  await page.locator('#canvas').press('o');
  await expect(page.locator('#things')).toContainText('box 2');
  await staysThere();
  await page.locator('#canvas').press('Delete');
  await expect(page.locator('#things')).not.toContainText('box 2');
  await staysThere();
  // The only scanner that one looks at.
  await daemon.send('DELETE', `/sensors/${SECOND.name}`);
  await staysThere();
  await expect(page.locator('#things')).toContainText('second');
  await daemon.post('/sensors', {...SECOND, name: 'third/scanner'});
  await staysThere();
  await expect(page.locator('#things')).not.toContainText('third');
  await page.locator('#timeline-live').click();
  await expect(page.locator('#things')).toContainText('third');
  await expect(page.locator('#things')).not.toContainText('second');
  await expect(page.getByLabel(`Show the scans of ${SENSOR}`)).toBeChecked();

  // What one moves oneself, one wants to see now.
  await standStill(page);
  await page.locator('#things').getByRole('button', {name: /^robot/}).click();
  await page.locator('#pose-x').fill('-2');
  await page.locator('#pose-x').press('Enter');
  await expect(page.locator('#timeline')).toBeHidden();
  await near(async () => (await daemon.get('/robots/robot/pose')).xyz[0], -2, 1e-6);
});

test('nothing of another world is seen in this one', async ({page, start}) => {
  const daemon = await start(room());
  await open(page, daemon);
  await withScan(page);
  await page.locator('#canvas').press('h');
  await expect(page.locator('#timeline')).toBeVisible();
  await daemon.put('/scene', {file: scene('corridor.sdf')});
  await expect(page.locator('#timeline')).toBeHidden();
  await expect(page.locator('#world-name')).toHaveText('corridor.sdf');
});

test('a move of a robot that is gone is not undone, and draws no robot', async ({page, start, complaints}) => {
  const daemon = await start(room());
  await daemon.post('/sensors', SECOND);
  await open(page, daemon, hash(EYE, AT, {panel: 'world', select: 'robots:second', sensor: SENSOR, show: SENSOR}));
  await withScan(page);
  const moveTo = async (y) => {
    await page.locator('#pose-y').fill(String(y));
    await page.locator('#pose-y').press('Enter');
    await near(async () => (await daemon.get('/robots/second/pose')).xyz[1], y, 1e-6);
  };
  await moveTo(-1.2);
  await moveTo(0.2);
  await page.locator('#canvas').press('Control+z');
  await expect(page.locator('#notices')).toContainText('Undone: moved second');
  await near(async () => (await daemon.get('/robots/second/pose')).xyz[1], -1.2, 1e-6);
  await daemon.send('DELETE', `/sensors/${SECOND.name}`);
  await expect(page.locator('#things')).not.toContainText('second');
  await page.getByRole('button', {name: 'Close this message'}).click();
  await page.locator('#canvas').press('Control+z');
  await expect(page.locator('#notices')).toContainText(
    'This cannot be undone (moved second): there is no robot "second"');
  await expect(page.locator('#notices')).not.toContainText('Undone');
  await expect(page.locator('#things')).not.toContainText('second');
  expect(await isRobotAt(page, SECOND.pose.xyz)).toBe(false);
  await page.locator('#canvas').press('Control+z');
  await expect(page.locator('#notices')).toContainText('nothing to undo');
  // The browser tells each request that is refused.
  expect(complaints.join()).toContain('404');
  complaints.length = 0;
});

/** Pairs of these that lie over each other, in the page. */
function covering(selectors) {
  const boxes = selectors.flatMap((each) => [...document.querySelectorAll(each)])
    .filter((element) => element.checkVisibility())
    .map((element) => ({name: element.id || element.textContent, ...element.getBoundingClientRect().toJSON()}));
  return boxes.flatMap((a, k) => boxes.slice(k + 1)
    .filter((b) => Math.min(a.right, b.right) > Math.max(a.left, b.left) + 1 &&
      Math.min(a.bottom, b.bottom) > Math.max(a.top, b.top) + 1)
    .map((b) => `${a.name} and ${b.name}`));
}

for (const [width, height, isWide] of [[1280, 720, true], [1000, 600, true], [800, 600, false], [375, 740, false]]) {
  test(`the bar lies over no card and no message, ${width} pixels wide`, async ({page, start}) => {
    await page.setViewportSize({width, height});
    const daemon = await start(room());
    await open(page, daemon, hash(EYE, AT, {panel: 'inspect'}));
    await withScan(page);
    for (const step of [540, 200]) {
      await page.locator('#inspect-step').fill(String(step));
      await page.locator('#inspect-step').press('Enter');
      await page.locator('#canvas').press('h');
      for (const key of ['Delete', 'Control+z']) await page.locator('#canvas').press(key);
      for (const each of ['#timeline', '#reading']) await expect(page.locator(each)).toBeVisible();
      await expect(page.locator('.notice')).toHaveCount(2);
      const all = ['#timeline', '#reading', '.notice', '#legend'];
      await expect.poll(() => page.evaluate(covering, isWide ? all : all.slice(0, 3))).toEqual([]);
      await page.locator('#canvas').press('n');
      await expect(page.locator('#selected')).toBeVisible();
      // A phone has no room for a card of what is read and one of what is selected.
      const some = ['#timeline', '#selected', '.notice', ...isWide ? ['#reading', '#legend', '.tools'] : []];
      await expect.poll(() => page.evaluate(covering, some)).toEqual([]);
      for (const key of ['Escape', 'h']) await page.locator('#canvas').press(key);
    }
  });
}
