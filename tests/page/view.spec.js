// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the page draws: the maze and a scan, pixel by pixel against what the daemon says is true.
import {SENSOR, expect, open, test, withScan} from './page.js';
import {hash, lookFrom} from './eye.js';
import {readPng} from './png.js';
import {Scip} from './scip.js';
import {scene} from './daemon.js';

// Above the start of the maze, a little from the south.
const EYE = [1, 0.2, 7];
const AT = [1, 1, 0];

async function picture(page) {
  await page.waitForTimeout(300);
  return readPng(await page.screenshot());
}

/** Places of hits in W, from the true ranges and the pose of the scan. */
async function hits(daemon) {
  const truth = await daemon.get(`/sensors/${SENSOR}/truth`);
  const [{xyz, q: [, , z, w]}] = truth.poses;
  const yaw = 2 * Math.atan2(z, w);
  return truth.true_m.map((range_m, i) => {
    // A UST-10LX has 1440 steps a turn, and step 540 looks ahead.
    const angle = yaw + (truth.steps[i] - 540) * 2 * Math.PI / 1440;
    return range_m && {
      range_m,
      step: truth.steps[i],
      material: truth.material[i],
      at: (share) => [xyz[0] + share * range_m * Math.cos(angle),
        xyz[1] + share * range_m * Math.sin(angle), xyz[2]],
    };
  }).filter(Boolean);
}

function distance(a, b) {
  return Math.hypot(...a.map((value, k) => value - b[k]));
}

/** Of the whole picture those that the view has, away from what lies on it. */
function inSight(place, box) {
  const {x, y} = place;
  return x > box.x + 250 && x < box.x + box.width - 10 && y > box.y + 60 && y < box.y + box.height - 10;
}

async function look(page, daemon, settings) {
  // Playwright goes to the same page only if more than the part behind # differs.
  await page.goto('about:blank');
  await open(page, daemon, hash(EYE, AT, {theme: 'light', ...settings}));
  if (settings.points !== 'false') await withScan(page);
  const box = await page.locator('#canvas').boundingBox();
  const project = lookFrom(EYE, AT, box);
  return {box, project, pixels: await picture(page)};
}

const ROBOT = ['--pose', '1,1,0', '--accuracy', 'ideal'];

test('shows the maze and a scan where they are', async ({page, start}) => {
  const daemon = await start(ROBOT);
  const painted = await look(page, daemon, {rays: 'false', paint: 'material'});
  const bare = await look(page, daemon, {rays: 'false', points: 'false'});
  const {project, box} = painted;
  const seen = (await hits(daemon)).map((hit) => ({...hit, place: project(hit.at(1))}))
    .filter(({place}) => inSight(place, box));
  expect(seen.length).toBeGreaterThan(300);

  // The legend says which colour each material has.
  const legend = await materialColours(page, daemon);
  const right = seen.filter(({place, material}) => {
    const [x, y] = [Math.round(place.x), Math.round(place.y)];
    return distance(painted.pixels.at(x, y), legend[material]) < 60;
  });
  const changed = seen.filter(({place}) => {
    const [x, y] = [Math.round(place.x), Math.round(place.y)];
    return distance(painted.pixels.at(x, y), bare.pixels.at(x, y)) > 25;
  });
  expect(right.length / seen.length).toBeGreaterThan(0.9);
  expect(changed.length / seen.length).toBeGreaterThan(0.5);

  // Half a metre beside the hits nothing was drawn.
  const beside = seen.map((hit) => project(hit.at(1 - 0.5 / hit.range_m)));
  const same = beside.filter(({x, y}) =>
    distance(painted.pixels.at(Math.round(x), Math.round(y)), bare.pixels.at(Math.round(x), Math.round(y))) < 10);
  expect(same.length / beside.length).toBeGreaterThan(0.85);
});

async function materialColours(page, daemon) {
  await page.goto('about:blank');
  await open(page, daemon, hash(EYE, AT, {paint: 'material'}));
  await withScan(page);
  const rows = await page.locator('#legend li').evaluateAll((items) => items.map((item) => [
    item.textContent, getComputedStyle(item.firstChild).backgroundColor]));
  return Object.fromEntries(rows.map(([name, css]) => [name, css.match(/\d+/g).map(Number)]));
}

test('draws rays green to the hit and red from it on', async ({page, start}) => {
  const daemon = await start(ROBOT);
  const rays = await look(page, daemon, {points: 'false', rays: 'true', behind: 'true'});
  const none = await look(page, daemon, {points: 'false', rays: 'false'});
  const found = await hits(daemon);
  const tint = (share, reach_m) => found.filter((hit) => hit.range_m < 4).flatMap((hit) => {
    const place = rays.project(hit.at(share ?? 1 + reach_m / hit.range_m));
    if (!inSight(place, rays.box)) return [];
    const [x, y] = [Math.round(place.x), Math.round(place.y)];
    const [after, before] = [rays.pixels.at(x, y), none.pixels.at(x, y)];
    return [after.map((value, k) => value - before[k])];
  });
  const mean = (list, k) => list.reduce((sum, each) => sum + each[k], 0) / list.length;
  const before = tint(0.5);
  const behind = tint(null, 0.5);
  expect(before.length).toBeGreaterThan(200);
  expect(behind.length).toBeGreaterThan(200);
  // Green takes red away more than green, and red the other way round.
  expect(mean(before, 1) - mean(before, 0)).toBeGreaterThan(10);
  expect(mean(behind, 0) - mean(behind, 1)).toBeGreaterThan(4);
});

test('shows the walls of the maze', async ({page, start}) => {
  const daemon = await start(ROBOT);
  const {pixels, project, box} = await look(page, daemon, {points: 'false', rays: 'false', grid: 'false'});
  const scene = await daemon.get('/scene/objects');
  const sky = pixels.at(Math.round(box.x + box.width / 2), Math.round(box.y + box.height / 2) - 0);
  const tops = scene.objects.filter(({name}) => /panel/.test(name)).map(({pose}) =>
    ({floor: project([pose.xyz[0], pose.xyz[1], 1.19])})).filter(({floor}) => inSight(floor, box));
  expect(tops.length).toBeGreaterThan(3);
  const drawn = tops.filter(({floor}) =>
    distance(pixels.at(Math.round(floor.x), Math.round(floor.y)), sky) > 12);
  expect(drawn.length / tops.length).toBeGreaterThan(0.9);
});

/** The brightest that a mark of a few pixels around this place can be, by its darkest colour. */
function whiteness(pixels, {x, y}) {
  const near = [-1, 0, 1].flatMap((dx) => [-1, 0, 1].map((dy) => [Math.round(x) + dx, Math.round(y) + dy]));
  return Math.max(...near.map(([u, v]) => Math.min(...pixels.at(u, v).slice(0, 3))));
}

/** Of these places, the share where two pictures differ. */
function changedShare(places, one, other) {
  const changed = places.filter(({x, y}) =>
    distance(one.at(Math.round(x), Math.round(y)), other.at(Math.round(x), Math.round(y))) > 25);
  return changed.length / places.length;
}

test('shows in white what is true beside what was sent', async ({page, start}) => {
  await page.emulateMedia({colorScheme: 'dark'});
  const daemon = await start(ROBOT);
  const [first, last] = [300, 780];
  await daemon.post(`/sensors/${SENSOR}/faults`, {kind: 'stick', steps: [first, last], range_m: 0.5});
  const scip = await Scip.connect(daemon.port);
  await expect.poll(async () => (await scip.scan())[540]).toBe(500);
  scip.close();
  const bare = await look(page, daemon, {rays: 'false', points: 'false'});
  const sent = await look(page, daemon, {rays: 'false', truth: 'false'});
  const both = await look(page, daemon, {rays: 'false', truth: 'true'});
  const stuck = (await hits(daemon)).filter(({step, range_m}) => step > first && step < last && range_m > 0.8);
  const wrong = stuck.map((hit) => bare.project(hit.at(0.5 / hit.range_m)));
  const real = stuck.map((hit) => bare.project(hit.at(1))).filter((place) => inSight(place, bare.box));
  expect(real.length).toBeGreaterThan(150);
  expect(changedShare(wrong, sent.pixels, bare.pixels)).toBeGreaterThan(0.9);
  expect(changedShare(real, sent.pixels, bare.pixels)).toBeLessThan(0.05);
  const isWhite = ({pixels}, place) => whiteness(pixels, place) > 200;
  expect(real.filter((place) => isWhite(both, place)).length / real.length).toBeGreaterThan(0.9);
  expect(real.filter((place) => isWhite(sent, place)).length / real.length).toBeLessThan(0.05);
});

test('a trail shows where hits were, for its time', async ({page, start}) => {
  const daemon = await start(['--scene', scene('square_room.sdf'), '--accuracy', 'ideal']);
  const ofBox = async () => (await hits(daemon)).filter(({material}) => material === 'cardboard');
  const trailed = await look(page, daemon, {rays: 'false', trail_s: '5'});
  const old = (await ofBox()).map((hit) => trailed.project(hit.at(1))).filter((place) => inSight(place, trailed.box));
  expect(old.length).toBeGreaterThan(10);
  await daemon.put('/scene/models/box/pose', {xyz: [-2.5, 1.5, 0.3]});
  await expect.poll(async () => (await ofBox()).every((hit) => hit.at(1)[0] < -1)).toBe(true);
  const soon = await picture(page);
  await page.waitForTimeout(6000);
  const later = await picture(page);
  expect(changedShare(old, soon, later)).toBeGreaterThan(0.8);
  const bare = await look(page, daemon, {rays: 'false', trail_s: '0'});
  expect(changedShare(old, later, bare.pixels)).toBeLessThan(0.1);
});

test('a trail begins anew with a daemon that does', async ({page, start}) => {
  const daemon = await start();
  await open(page, daemon);
  const lengths = await page.evaluate(async () => {
    const {Trail} = await import('/page/trail.js');
    const trail = new Trail();
    trail.setLength(5);
    const hits = {positions: {array: new Float32Array(30)}, tints: {array: new Uint8Array(40)}};
    return [[1000, 4], [1001, 3], [1, 2], [2, 1]].map(([now_s, count]) => {
      trail.add(now_s, hits, count);
      return trail.marks.geometry.drawRange.count;
    });
  });
  expect(lengths).toEqual([4, 7, 2, 3]);
});

test('the view goes along into another world, and stays in the same one', async ({page, start}) => {
  const daemon = await start(['--scene', scene('square_room.sdf'), '--accuracy', 'ideal']);
  await open(page, daemon);
  await withScan(page);
  const link = () => page.evaluate(() => Object.fromEntries(new URLSearchParams(location.hash.slice(1))));
  const away = async () => {
    const {eye, at} = await link();
    return eye ? Math.hypot(...eye.split(',').map((value, k) => value - at.split(',')[k])) : Infinity;
  };
  await expect.poll(away).toBeLessThan(Infinity);
  const far_m = await away();
  await page.locator('#canvas').press('+');
  await expect.poll(away).toBeLessThan(0.9 * far_m);
  const near_m = await away();
  await daemon.put('/scene', {file: scene('square_room.sdf')});
  await page.waitForTimeout(2000);
  expect(await away()).toBeCloseTo(near_m, 2);
  // It is 30 m long, and its walls are seen from 2 m away to the end.
  await daemon.put('/scene', {file: scene('corridor.sdf')});
  await expect(page.locator('#world-name')).toHaveText('corridor.sdf');
  await expect.poll(away).toBeGreaterThan(2 * near_m);
  await page.locator('#view-top').click();
  await expect.poll(async () => (await link()).top).toBe('1');
  const high_m = await away();
  await daemon.put('/scene', {file: scene('square_room.sdf')});
  await expect.poll(away).toBeLessThan(high_m / 2);
  await expect(page.locator('#view-top')).toHaveAttribute('aria-pressed', 'true');
});
