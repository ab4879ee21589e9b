// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What one sees at once, measured in pixels: the picture must not drown in the rays of its scanners.
import {mkdirSync} from 'node:fs';
import {SENSOR, expect, open, test, withScan} from './page.js';
import {hash, lookFrom} from './eye.js';
import {readPng} from './png.js';
import {fleet} from './rigs.js';
import {Scip} from './scip.js';
import {scene} from './daemon.js';

const EYE = [-1.5, -4, 17];
const AT = [7.2, 7.2, 0];

/** Each x and y of the view that nothing lies on, but for its buttons, legend and scale. */
function* places({x, y, width, height}) {
  for (let v = Math.ceil(y) + 60; v < y + height - 10; ++v) {
    for (let u = Math.ceil(x) + 250; u < x + width - 10; ++u) yield [u, v];
  }
}

/** Redder than wood and brick are. */
function isRed([r, g, b]) {
  return r > 110 && g < 0.6 * r && b < 0.6 * r;
}

function redShare({pixels, box}) {
  let [red, all] = [0, 0];
  for (const [u, v] of places(box)) {
    red += isRed(pixels.at(u, v));
    all += 1;
  }
  return red / all;
}

/** Of the edges that one picture shows, those that another one still shows: its pixels differ in the same way. */
function edgesKept(bare, full) {
  let [kept, all] = [0, 0];
  const step = ({pixels}, u, v, [du, dv]) => {
    const [a, b] = [pixels.at(u, v), pixels.at(u + du, v + dv)];
    return a.map((value, k) => value - b[k]);
  };
  const dot = (a, b) => a.reduce((sum, value, k) => sum + value * b[k], 0);
  for (const [u, v] of places(bare.box)) {
    for (const aside of [[1, 0], [0, 1]]) {
      const edge = step(bare, u, v, aside);
      const strength = dot(edge, edge);
      if (strength < 40 ** 2) continue;
      all += 1;
      kept += dot(edge, step(full, u, v, aside)) > 0.5 * strength;
    }
  }
  expect(all).toBeGreaterThan(2000);
  return kept / all;
}

async function look(page, daemon, rest = {}) {
  const sensors = (await daemon.get('/sensors')).map(({name}) => name);
  await page.goto('about:blank');
  await open(page, daemon, hash(EYE, AT, {theme: 'light', show: sensors.join(), grid: 'false', ...rest}));
  await expect.poll(() => page.locator('#sensors .row > input:checked').count()).toBeGreaterThanOrEqual(sensors.length);
  await page.waitForTimeout(2000);
  return {pixels: readPng(await page.screenshot()), box: await page.locator('#canvas').boundingBox()};
}

const BARE = {rays: 'false', fans: 'false', points: 'false'};

test('with four scanners no more than a twentieth of the view is red', async ({page, start}) => {
  const daemon = await start(['--config', scene('two_robots.yaml'), '--http', '127.0.0.1:0', '--free-ports']);
  const [four, bare] = [await look(page, daemon), await look(page, daemon, BARE)];
  const [share, before] = [redShare(four), redShare(bare)];
  console.log(`red with four scanners: ${(100 * share).toFixed(2)} %, with none: ${(100 * before).toFixed(2)} %`);
  expect(share).toBeLessThan(0.05);
});

test('with thirty scanners the maze is still seen', async ({page, start}, info) => {
  mkdirSync(info.outputDir, {recursive: true});
  const daemon = await start(fleet(info.outputDir, 10));
  const [thirty, bare] = [await look(page, daemon), await look(page, daemon, BARE)];
  const [kept, red] = [edgesKept(bare, thirty), redShare(thirty)];
  console.log(`edges kept: ${(100 * kept).toFixed(1)} %, red: ${(100 * red).toFixed(2)} %`);
  expect(kept).toBeGreaterThan(0.5);
  expect(red).toBeLessThan(0.05);
});

test('the first scan is soon there, and thirty scanners go on', async ({page, start}, info) => {
  mkdirSync(info.outputDir, {recursive: true});
  const daemon = await start(fleet(info.outputDir, 10));
  const sensors = (await daemon.get('/sensors')).map(({name}) => name);
  let acknowledged = 0;
  page.on('websocket', (socket) => socket.on('framesent', ({payload}) => {
    acknowledged += /^{"ack":\d+}$/.test(payload) ? 1 : 0;
  }));
  await open(page, daemon, `#show=${sensors.join()}`);
  const first = () => page.evaluate(() => performance.getEntriesByName('first scan')[0]?.startTime);
  await expect.poll(first).toBeGreaterThan(0);
  const [before, from_ms] = [acknowledged, Date.now()];
  await page.waitForTimeout(5000);
  const rate = (acknowledged - before) / sensors.length / ((Date.now() - from_ms) / 1000);
  console.log(`first scan after ${Math.round(await first())} ms; ${rate.toFixed(1)} pictures of all a second`);
  // Far less than a machine gives that does nothing else.
  expect(await first()).toBeLessThan(10_000);
  expect(rate).toBeGreaterThan(1);
});

test('a browser fetches few files', async ({page, start}) => {
  const daemon = await start();
  const main = await (await fetch(new URL('page/main.js', daemon.address))).text();
  test.skip(/^import .* from '\.\//m.test(main), 'this build has no esbuild, so each module is fetched by itself');
  const files = new Set();
  page.on('request', (request) => {
    const {pathname} = new URL(request.url());
    if (pathname === '/' || pathname.startsWith('/page/')) files.add(pathname);
  });
  await open(page, daemon);
  await withScan(page);
  expect([...files]).toContain('/page/main.js');
  expect(files.size).toBeLessThanOrEqual(20);
});

test('draws nothing beyond the world', async ({page, start}) => {
  const daemon = await start(['--scene', scene('square_room.sdf'), '--accuracy', 'ideal']);
  const [eye, at] = [[0, -0.01, 14], [0, 0, 0]];
  const drawn = async (settings) => {
    await page.goto('about:blank');
    await open(page, daemon, hash(eye, at, {theme: 'light', grid: 'false', truth: 'true', ...settings}));
    await page.waitForTimeout(1000);
    return readPng(await page.screenshot());
  };
  const [rays, bare] = [await drawn({behind: 'true'}), await drawn({rays: 'false', points: 'false', truth: 'false'})];
  const box = await page.locator('#canvas').boundingBox();
  const project = lookFrom(eye, at, box);
  // The outer walls of the room are 0.1 m thick, and 1 m high.
  const [low, high] = [project([-3.6, -2.6, 0]), project([3.6, 2.6, 0])];
  let [outside, inside] = [0, 0];
  for (const [u, v] of places(box)) {
    const differs = Math.hypot(...rays.at(u, v).map((value, k) => value - bare.at(u, v)[k])) > 6;
    const isIn = u > low.x && u < high.x && v < low.y && v > high.y;
    if (isIn) inside += differs;
    else outside += differs;
  }
  expect(inside).toBeGreaterThan(1000);
  expect(outside).toBe(0);
});

test('rays go to what is met, and of a recording to what was sent', async ({page, start}) => {
  await open(page, await start());
  const reaches = await page.evaluate(async () => {
    const {Reach} = await import('/page/reach.js');
    const shape = {origins: [0, 0, 0, 0, 0, 0, 0, 0, 0], directions: [1, 0, 0, 0, 1, 0, -0.6, 0.8, 0]};
    const world = {min: {x: -3, y: -2, z: 0}, max: {x: 3, y: 2, z: 1}, isEmpty: () => false};
    const limits = {beams: 3, nearest_mm: 20, dmax_mm: 30_000, max_range_m: 10};
    const scan = (true_m) => ({...limits, arrays: {true_m, sent_mm: [1500, 1, 40_000]}});
    const seen = (true_m, box) => [0, 1, 2].map((i) => new Reach(scan(true_m), shape, box).of(i));
    return [seen([1.2, NaN, NaN], world), seen([NaN, NaN, NaN], world), seen([NaN, NaN, NaN], null)];
  });
  expect(reaches).toEqual([[1.2, 2, 2.5], [1.5, 2, 2.5], [1.5, 10, 10]]);
});

test('begins with a look at the robot and its scan', async ({page, start}) => {
  const daemon = await start(['--pose', '4.2,9,0.5', '--accuracy', 'ideal']);
  await open(page, daemon);
  await withScan(page);
  await expect.poll(() => page.evaluate(() => location.hash)).toContain('eye=');
  const from = async (name) => page.evaluate((key) => new URLSearchParams(location.hash.slice(1)).get(key), name)
    .then((text) => text.split(',').map(Number));
  const box = await page.locator('#canvas').boundingBox();
  const project = lookFrom(await from('eye'), await from('at'), box);
  const truth = await daemon.get(`/sensors/${SENSOR}/truth`);
  const [{xyz}] = truth.poses;
  const hits = truth.true_m.flatMap((range_m, i) => {
    const angle = 0.5 + (truth.steps[i] - 540) * 2 * Math.PI / 1440;
    return range_m ? [project([xyz[0] + range_m * Math.cos(angle), xyz[1] + range_m * Math.sin(angle), xyz[2]])] : [];
  });
  const inView = ({x, y}) => x > box.x && x < box.x + box.width && y > box.y && y < box.y + box.height;
  expect([...hits, project(xyz)].every(inView)).toBe(true);
  const span = (axis) => Math.max(...hits.map((hit) => hit[axis])) - Math.min(...hits.map((hit) => hit[axis]));
  expect(Math.max(span('x') / box.width, span('y') / box.height)).toBeGreaterThan(0.5);
});

test('who looks elsewhere before the world is there looks there', async ({page, start}) => {
  const daemon = await start();
  let go;
  const world = new Promise((done) => { go = done; });
  await page.route('**/scene/objects', async (route) => {
    await world;
    await route.continue();
  });
  await page.goto(daemon.address);
  await page.locator('#view-all').click();
  go();
  await withScan(page);
  const eye = () => page.evaluate(() => new URLSearchParams(location.hash.slice(1)).get('eye'));
  await expect.poll(eye).not.toBeNull();
  await page.waitForTimeout(1000);
  const seen = await eye();
  await page.locator('#view-all').click();
  await page.waitForTimeout(500);
  expect(await eye()).toBe(seen);
});

test('follows a robot that drives by itself', async ({page, start}) => {
  const daemon = await start(['--poses', scene('rescue_maze.tum')]);
  await open(page, daemon);
  await withScan(page);
  await expect(page.locator('#view-follow')).toHaveAttribute('aria-pressed', 'true');
});

test('says how to connect a driver until one is there', async ({page, start}) => {
  const daemon = await start();
  await open(page, daemon);
  const card = page.getByRole('region', {name: 'Connect a driver'});
  await expect(card).toContainText(daemon.ready.sensors[0].tcp);
  const [address, port] = daemon.ready.sensors[0].tcp.split(':');
  await expect(card.locator('#connect-command')).toHaveText(
    `ros2 run urg_node urg_node_driver --ros-args -p ip_address:=${address} -p ip_port:=${port}`);
  const scip = await Scip.connect(daemon.port);
  await scip.ask('VV');
  await expect(card).toBeHidden();
  scip.close();
  await expect(card).toBeVisible();
  await card.getByRole('button', {name: 'Close'}).click();
  await expect(card).toBeHidden();
});

test('the connect card goes after two minutes, and with the daemon', async ({page, start, complaints}) => {
  const daemon = await start();
  await page.clock.install();
  await open(page, daemon);
  const card = page.getByRole('region', {name: 'Connect a driver'});
  await expect(card).toBeVisible();
  await page.clock.fastForward(100_000);
  await page.waitForTimeout(1500);
  await expect(card).toBeVisible();
  await page.clock.fastForward(30_000);
  await expect(card).toBeHidden();
  await expect(page.locator('#state')).toHaveText('live');
  // It is back with the next daemon, and gone with it.
  await daemon.end('SIGKILL');
  await expect(page.locator('#lost')).toHaveText('Connection to scipd lost. Reconnecting…');
  const again = await start([], daemon.ready.http);
  await expect(card).toBeVisible();
  await again.end('SIGKILL');
  await expect(card).toBeHidden();
  complaints.length = 0;
});

test('in the dark, the ground outshines nothing', async ({page, start}) => {
  const daemon = await start(['--scene', scene('depot.sdf'), '--pose', '8,6,2']);
  const [eye, at] = [[0, -0.01, 60], [0, 0, 0]];
  const groundIn = async (theme) => {
    await page.goto('about:blank');
    await page.emulateMedia({colorScheme: theme});
    await open(page, daemon, hash(eye, at, {rays: 'false', points: 'false', grid: 'false'}));
    await page.waitForTimeout(1000);
    const [pixels, box] = [readPng(await page.screenshot()), await page.locator('#canvas').boundingBox()];
    // Beside the hall, where there is nothing but ground.
    const {x, y} = lookFrom(eye, at, box)([20, 20, 0]);
    return Math.max(...pixels.at(Math.round(x), Math.round(y)));
  };
  expect(await groundIn('light')).toBeGreaterThan(120);
  expect(await groundIn('dark')).toBeLessThan(90);
});
