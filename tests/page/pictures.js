// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Draws the pictures of the page in docs/: pictures.js FOLDER, by way of `run`.
import {mkdtempSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import path from 'node:path';
import {chromium} from '@playwright/test';
import config from './playwright.config.js';
import {Daemon, scene} from './daemon.js';
import {Scip} from './scip.js';
import {fleet, namesOf} from './rigs.js';

const MAZE = ['--pose', '4.2,9,0.5', '--accuracy', 'sensor'];
const DEPOT = ['--scene', scene('depot.sdf'), '--accuracy', 'sensor', '--pose', '8,6,2'];
const MATERIALS = ['--scene', scene('materials.sdf'), '--mount', '0,0,0.3,0,0,0', '--accuracy', 'material'];
const WIDE = {width: 1280, height: 760};
const work = mkdtempSync(path.join(tmpdir(), 'scipd-pictures-'));

const PICTURES = [
  {name: 'page_light', world: MAZE, hash: '#eye=3.2,2.6,6.2&at=5.2,8.9,0&select=robots:robot', size: WIDE,
    theme: 'light', requests: ['MD0000108000000']},
  {name: 'page_dark', world: MAZE, hash: '#eye=1.2,4.2,3.6&at=4.6,9.3,0&paint=material&panel=wire', size: WIDE,
    theme: 'dark', requests: ['VV', 'PP', 'MD0000108001005', 'GD0000200000']},
  {name: 'page_phone', world: MAZE, hash: '#eye=1.6,2.5,7&at=5,9.6,0', size: {width: 375, height: 740}, theme: 'light'},
  {name: 'page_inspect', world: MAZE, hash: '#eye=3.2,2.6,6.2&at=5.2,8.9,0&panel=inspect',
    size: {width: 1280, height: 1120}, theme: 'light', watched: [300, 560]},
  {name: 'page_depot', world: DEPOT, hash: '#panel=world&eye=-7.5,-10.5,11&at=0.6,-0.4,0.4', size: WIDE,
    theme: 'light'},
  {name: 'page_many', world: fleet(work, 10), hash: `#eye=-1.5,-4,17&at=7.2,6.4,0&show=${namesOf(10).join()}`,
    size: WIDE, theme: 'light', requests: ['MD0000108000000'],
    faults: {'robot0/left': {kind: 'cut', how: 'silent', for: {s: 1000}}, 'robot6/front': {kind: 'stall'}}},
  {name: 'page_materials', world: MATERIALS, hash: '#eye=0.5,-5,12&at=2,0.3,0.3&paint=material', size: WIDE,
    theme: 'dark', requests: ['MD0000108000000']},
];

async function talk(daemon, requests) {
  const scip = await Scip.connect(daemon.port);
  for (const request of requests) {
    await scip.ask(request);
    // A stream takes its time.
    await new Promise((done) => setTimeout(done, 500));
  }
  return scip;
}

/** Steps of the scanner over some seconds in which the robot turns. */
async function watch(page, daemon, steps) {
  for (const step of steps) {
    await page.locator('#inspect-step').fill(String(step));
    await page.locator('#inspect-step').press('Enter');
    await page.locator('#watch').click();
  }
  for (let k = 0; k < 40; ++k) {
    await daemon.put('/robots/robot/pose', {xyz: [4.2, 9, 0], rpy: [0, 0, 0.5 + 0.3 * Math.sin(k / 6)]});
    await page.waitForTimeout(400);
  }
}

async function draw(browser, folder, picture) {
  const {name, world, hash, size, theme, requests = [], faults = {}, watched = []} = picture;
  const daemon = await Daemon.start(world);
  for (const [sensor, fault] of Object.entries(faults)) await daemon.post(`/sensors/${sensor}/faults`, fault);
  const page = await browser.newPage({viewport: size, colorScheme: theme});
  await page.goto(daemon.address + hash);
  await page.locator('#legend').waitFor();
  await page.waitForTimeout(1000);
  const scip = await talk(daemon, requests);
  if (watched.length) await watch(page, daemon, watched);
  // The rates of the panels need two answers.
  await page.waitForTimeout(3500);
  await page.screenshot({path: path.join(folder, `${name}.png`)});
  await page.close();
  scip.close();
  await daemon.end();
}

const folder = process.argv[2];
const browser = await chromium.launch(config.use.launchOptions);
for (const picture of PICTURES) await draw(browser, folder, picture);
await browser.close();
rmSync(work, {recursive: true});
