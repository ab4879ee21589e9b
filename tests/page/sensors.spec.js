// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Several scanners side by side: their colours and scales, and how each is doing.
import {mkdirSync} from 'node:fs';
import {expect, open, test, withScan} from './page.js';
import {hash, lookFrom} from './eye.js';
import {readPng} from './png.js';
import {fleet} from './rigs.js';
import {Scip} from './scip.js';

function rig(info, robots) {
  mkdirSync(info.outputDir, {recursive: true});
  return fleet(info.outputDir, robots);
}

const lengthOf = (a) => Math.hypot(...a);
const minus = (a, b) => a.map((value, k) => value - b[k]);

/** CIE L*a*b* of a linear colour, for D65. */
function lab(linear) {
  const [x, y, z] = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]
    .map((row) => row.reduce((sum, share, k) => sum + share * linear[k], 0))
    .map((value, k) => value / [0.9505, 1, 1.089][k])
    .map((value) => value > 0.008856 ? Math.cbrt(value) : 7.787 * value + 16 / 116);
  return [116 * y - 16, 500 * (x - y), 200 * (y - z)];
}

// What people see who lack one kind of cone: Machado, Oliveira and Fernandes, 2009, severity 1.
const EYES = {
  usual: [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
  protanopia: [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
  deuteranopia: [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
  tritanopia: [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
};

function seenBy(eye, colour) {
  const linear = colour.map((each) => each <= 0.04045 ? each / 12.92 : ((each + 0.055) / 1.055) ** 2.4);
  const answers = EYES[eye].map((row) => row.reduce((sum, share, k) => sum + share * linear[k], 0));
  return lab(answers.map((each) => Math.min(Math.max(each, 0), 1)));
}

test('everybody can tell the colours of six scanners apart, and those of nine materials', async ({page, start}) => {
  await open(page, await start());
  const palettes = await page.evaluate(async () => {
    const {distinct, distinctCount, ofScanner} = await import('/page/colours.js');
    const first = (count, colourOf) => Array.from({length: count}, (_, i) => colourOf(i));
    return {scanners: first(6, ofScanner), materials: first(distinctCount, distinct)};
  });
  expect(palettes.materials.length).toBe(9);
  for (const [name, palette] of Object.entries(palettes)) {
    for (const eye of Object.keys(EYES)) {
      const seen = palette.map((colour) => seenBy(eye, colour));
      const apart = seen.flatMap((one, i) => seen.slice(0, i).map((other) => lengthOf(minus(one, other))));
      // About 2.3 can just be told apart side by side.
      expect(Math.min(...apart), `${name}, ${eye}`).toBeGreaterThan(15);
    }
  }
});

test('one scale is for the scans of all', async ({page, start}, info) => {
  const daemon = await start(rig(info, 1));
  const names = (await daemon.get('/sensors')).map(({name}) => name);
  const reads = async (name) => (await daemon.get(`/sensors/${name}/truth`)).sent_mm.filter((mm) => mm >= 20);
  for (const wanted of [names, names.slice(0, 1)]) {
    await page.goto('about:blank');
    await open(page, daemon, `#paint=range&show=${wanted.join()}`);
    await withScan(page);
    await expect(page.locator('#sensors .row > input:checked')).toHaveCount(wanted.length);
    await page.waitForTimeout(1500);
    const all = (await Promise.all(wanted.map(reads))).flat().sort((a, b) => a - b);
    const ends = [0.05, 0.95].map((share) => all[Math.round(share * (all.length - 1))] / 1000);
    const told = (await page.locator('#legend .ends span').allTextContents()).map(parseFloat);
    told.forEach((value, i) => expect(Math.abs(value - ends[i])).toBeLessThan(0.06));
  }
});

test('the legend names thirty scanners, each in its colour, and a click selects one', async ({page, start}, info) => {
  const daemon = await start(rig(info, 10));
  const names = (await daemon.get('/sensors')).map(({name}) => name);
  expect(names.length).toBe(30);
  await open(page, daemon, `#show=${names.join()}`);
  await withScan(page);
  const entries = page.locator('#legend .entry');
  await expect(entries).toHaveCount(30);
  const seen = await entries.evaluateAll((list) => list.map((entry) =>
    [entry.dataset.name, getComputedStyle(entry.querySelector('.swatch')).backgroundColor]));
  expect(seen.map(([name]) => name).sort()).toEqual([...names].sort());
  expect(new Set(seen.map(([, colour]) => colour)).size).toBe(30);
  // One line for each robot.
  const rows = await page.locator('#legend li').evaluateAll((list) => list.map((row) => [row.firstChild.textContent,
    new Set([...row.querySelectorAll('.entry')].map((entry) => entry.getBoundingClientRect().top)).size]));
  expect(rows.sort()).toEqual(Array.from({length: 10}, (_, i) => [`robot${i}`, 1]));
  const last = page.locator('#legend').getByTitle('Select robot9/right');
  await last.click();
  await expect(last).toHaveAttribute('aria-pressed', 'true');
  await expect(page.locator('#sensors .chosen')).toContainText('robot9/right');
});

test('latency has ticks at round numbers, and none without a client', async ({page, start}) => {
  const daemon = await start();
  await open(page, daemon);
  await withScan(page);
  const facts = page.locator('#sensors .facts');
  await expect(facts).toContainText('tty');
  await expect(facts.getByText('Latency')).toBeHidden();
  const scip = await Scip.connect(daemon.port);
  scip.say('MD0000108000000');
  await expect(facts.getByText(/^median [\d.]+ ms, 99th pct [\d.]+ ms, max [\d.]+ ms$/)).toBeVisible();
  const ticks = page.locator('.histogram .tick');
  await expect(ticks).not.toHaveCount(0);
  for (const text of await ticks.allTextContents()) expect(text).toMatch(/^[125]0{0,2} (µs|ms)$/);
  scip.close();
  await expect(page.locator('.histogram')).toBeHidden();
});

test('a card shows the client that waits', async ({page, start}) => {
  const daemon = await start();
  await open(page, daemon);
  const clients = page.locator('#sensors .facts div').filter({hasText: 'Clients'}).locator('dd');
  await expect(clients).toHaveText('0');
  const first = await Scip.connect(daemon.port);
  await first.ask('VV');
  const second = await Scip.connect(daemon.port);
  const {address, port} = second.socket.address();
  await expect(clients).toHaveText(`1 connected, 1 waiting: ${address}:${port}`);
  const third = await Scip.connect(daemon.port);
  await expect(clients).toHaveText(`1 connected, 2 waiting: ${address}:${port} and 1 more`);
  third.close();
  first.close();
  await second.ask('VV');
  await expect(clients).toHaveText('1');
  second.close();
});

test('many scanners are rows, which one finds and ticks together', async ({page, start}, info) => {
  const daemon = await start(rig(info, 3));
  await open(page, daemon, '#show=');
  const rows = page.locator('#sensors .sensor:visible');
  const ticked = page.locator('#sensors .row > input:checked');
  await expect(rows).toHaveCount(9);
  await expect(page.locator('#sensors .whole:visible')).toHaveCount(1);
  const all = page.getByRole('checkbox', {name: 'All', exact: true});
  await page.getByPlaceholder('Search').fill('robot1');
  await expect(rows).toHaveCount(3);
  await all.check();
  await page.getByPlaceholder('Search').fill('');
  await expect(rows).toHaveCount(9);
  expect(await all.evaluate((box) => box.indeterminate)).toBe(true);
  await expect(ticked).toHaveCount(3);
  await all.check();
  await expect(ticked).toHaveCount(9);
  await all.uncheck();
  await expect(ticked).toHaveCount(0);
});

test('a scanner comes with a new robot, and goes', async ({page, start, complaints}) => {
  const daemon = await start(['--accuracy', 'ideal']);
  await open(page, daemon);
  await withScan(page);
  await page.getByText('Add a scanner or a robot').click();
  const form = page.locator('#sensor-form');
  await expect(form.locator('#sensor-pose')).toBeHidden();
  await form.getByLabel('Name', {exact: true}).fill('rear');
  await form.getByLabel('Model').selectOption('URG-04LX@3.3.00');
  await form.getByLabel('TCP').fill(`127.0.0.1:${daemon.port}`);
  await form.getByRole('button', {name: 'Add'}).click();
  await expect(form.getByRole('alert')).toContainText('cannot listen');
  complaints.length = 0;
  await form.getByRole('combobox', {name: 'Robot'}).fill('second');
  await form.locator('#sensor-pose').getByLabel('x').fill('2');
  await form.locator('#sensor-mount').getByLabel('z').fill('0.5');
  await form.getByLabel('TCP').fill('127.0.0.1:0');
  await form.getByRole('button', {name: 'Add'}).click();
  const card = page.locator('#sensors .sensor').filter({hasText: 'second/rear'});
  await expect(card).toContainText('URG-04LX');
  await expect(card.getByRole('checkbox').first()).toBeChecked();
  const {tcp} = await daemon.get('/sensors/second/rear');
  await expect(page.getByRole('log')).toContainText(`second/rear is at ${tcp}`);
  const scip = await Scip.connect(Number(tcp.split(':').pop()));
  await expect(card).toContainText('Clients1');
  scip.close();
  expect((await daemon.get('/robots/second/pose')).xyz[0]).toBe(2);
  await page.getByRole('tab', {name: 'World'}).click();
  await expect(page.locator('#things')).toContainText('second');
  await page.getByRole('tab', {name: 'Sensors'}).click();
  await card.getByRole('button', {name: 'Remove sensor…'}).click();
  await page.locator('#ask-go').click();
  await expect(card).toHaveCount(0);
  await expect(page.locator('#things')).not.toContainText('second');
  await expect(page.locator('#state')).toHaveText('live');

  // Somebody else takes the chosen one away.
  await daemon.post('/sensors', {name: 'robot/left', model: 'UST-10LX', tcp: '127.0.0.1:0'});
  await page.goto('about:blank');
  await open(page, daemon, '#sensor=robot/left&show=robot/left');
  await expect(page.locator('#sensors .sensor').filter({hasText: 'robot/left'})).toHaveCount(1);
  await daemon.send('DELETE', '/sensors/robot/left');
  await expect(page.locator('#sensors .sensor')).toHaveCount(1);
  await expect(page.locator('#sensors').getByRole('checkbox').first()).toBeChecked();
  await expect.poll(() => page.evaluate(() => location.hash)).not.toContain('left');
});

test('a scanner whose fault acts says so, in its row and in the view', async ({page, start}, info) => {
  const daemon = await start(rig(info, 2));
  const [eye, at] = [[1, 0.2, 7], [1, 1, 0]];
  const [served, cut] = ['robot0/front', 'robot0/left'];
  await daemon.post(`/sensors/${cut}/faults`, {kind: 'cut', how: 'silent', for: {s: 1000}});
  const scip = await Scip.connect(Number((await daemon.get(`/sensors/${served}`)).tcp.split(':').pop()));
  scip.say('MD0000108000000');
  await open(page, daemon, hash(eye, at, {show: cut, sensor: 'robot1/front'}));
  const row = (name) => page.locator('#sensors .sensor').filter({hasText: name});
  await expect(row(cut).locator('.chip:visible')).toHaveText('cut');
  await expect(row(cut).locator('.brief')).not.toContainText('Hz');
  await expect(row(served).locator('.chip:visible')).toHaveText('streaming');
  await expect(row(served).locator('.brief')).toHaveText(/^[\d.]+ Hz to a client · [\d.]+ ms late · \d+ lost$/);
  await page.getByPlaceholder('Search').fill('cut');
  await expect(page.locator('#sensors .sensor:visible')).toHaveCount(1);

  const project = lookFrom(eye, at, await page.locator('#canvas').boundingBox());
  const place = project([1 + 0.1, 1, 0.25]);
  const yellow = async () => {
    const pixels = readPng(await page.screenshot());
    let found = 0;
    for (let u = -20; u <= 20; ++u) {
      for (let v = -50; v < 0; ++v) {
        const [r, g, b] = pixels.at(Math.round(place.x) + u, Math.round(place.y) + v);
        found += r > 230 && g > 180 && b < 110;
      }
    }
    return found;
  };
  await expect.poll(yellow).toBeGreaterThan(60);
  await daemon.send('DELETE', `/sensors/${cut}/faults`);
  await page.getByPlaceholder('Search').fill('');
  await expect(row(cut).locator('.chip:visible')).toHaveText('standby');
  await expect.poll(yellow).toBeLessThan(5);
  scip.close();
});
