// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Faults by the page: what its fields offer is what the daemon takes, troubles by name, scenarios, and the time bar.
import {readFileSync} from 'node:fs';
import {SENSOR, expect, open, test} from './page.js';
import {Scip} from './scip.js';
import {scene} from './daemon.js';

const LATER = {at: {s: 1000}, for: {s: 1}};

/** Whether the daemon takes a fault: 201, or else 400. */
async function takes(daemon, fault) {
  const answer = await fetch(new URL(`/sensors/${SENSOR}/faults`, daemon.address), {
    method: 'POST', headers: {'Content-Type': 'application/json'}, body: JSON.stringify({...LATER, ...fault})});
  if (answer.status === 201) return true;
  const {field, detail} = await answer.json();
  expect(answer.status, `${JSON.stringify(fault)}: ${field} ${detail}`).toBe(400);
  return false;
}

function tables(page) {
  return page.evaluate(async () => ({
    fields: (await import('/page/fault_fields.js')).FAULT_FIELDS,
    examples: (await import('/page/fault_examples.js')).FAULT_EXAMPLES,
  }));
}

/** Each value of a member with whether it must be taken. */
function trials({type, words, least, most, inside, whole}) {
  const step = whole ? 1 : 0.001;
  if (type === 'words') return [...words.map((word) => [word, true]), ['others', false]];
  if (type === 'share') return [[0, true], [1, true], [-0.001, false], [1.001, false]];
  if (type === 'number') {
    return [[inside ? least + step : least, true], [most, true], [inside ? least : least - step, false],
      [most + (whole ? 1 : most / 1e3), false]];
  }
  if (type === 'steps') return [[[least, most], true], [[least, most + 1], false], [[least - 1, most], false]];
  if (type === 'vector') return [[[-most, 0, most], true], [[0, 0, most * 1.1], false]];
  if (type === 'flag') return [[true, true], ['perhaps', false]];
  return [];
}

/** What a member of this kind needs beside it. */
const BESIDE = {
  poses: {ms: {how: 'late', ms: 1}, xyz: {how: 'jump'}, rpy: {how: 'jump'}},
  clock: {frozen: {}, ppm: {}, wrap_in_s: {}, repeat: {}},
  motor: {spin_up_s: {}},
};

test('what the fields of faults offer is what the daemon takes', async ({page, start}, info) => {
  const daemon = await start(['--pty', info.outputPath('tty')]);
  await open(page, daemon);
  const {fields, examples} = await tables(page);
  const kinds = await daemon.get('/faults/kinds');
  expect(Object.keys(fields).sort()).toEqual(kinds.map(({kind}) => kind).sort());
  let tried = 0;
  for (const {kind, members} of kinds) {
    expect(Object.keys(fields[kind]), kind).toEqual(members);
    for (const [member, spec] of Object.entries(fields[kind])) {
      for (const [value, fits] of trials(spec)) {
        const fault = {kind, ...(BESIDE[kind]?.[member] ?? examples[kind]), [member]: value};
        if (kind === 'poses' && member === 'how' && value === 'jump') fault.xyz = [1, 0, 0];
        if (kind === 'poses' && value !== 'late' && member === 'how') delete fault.ms;
        if (kind === 'cut' && member === 'how') delete fault.boot;
        expect(await takes(daemon, fault), JSON.stringify(fault)).toBe(fits);
        tried += 1;
      }
    }
  }
  console.log(`${tried} faults were tried`);
  expect(tried).toBeGreaterThan(150);
});

test('each trouble that has a name starts', async ({page, start}, info) => {
  const daemon = await start(['--pty', info.outputPath('tty')]);
  await open(page, daemon, '#panel=faults');
  const faults = async () => (await daemon.get(`/sensors/${SENSOR}/faults`)).map(({kind}) => kind);
  const scip = await Scip.connect(daemon.port);
  await scip.scan();
  scip.close();
  await page.getByRole('button', {name: 'Cable pulled'}).click();
  await expect.poll(faults).toEqual(['cut', 'hangup']);
  await page.getByRole('button', {name: 'Stop all'}).click();
  await expect.poll(faults).toEqual([]);
  const names = await page.locator('#fault-presets button').allTextContents();
  for (const name of names) await page.getByRole('button', {name, exact: true}).click();
  await expect.poll(async () => (await faults()).length).toBeGreaterThanOrEqual(names.length);
  await expect(page.locator('.notice.trouble')).toHaveCount(0);
});

test('a dirty window hides what stands ahead, and the time bar shows it', async ({page, start}) => {
  const daemon = await start(['--scene', scene('square_room.sdf'), '--accuracy', 'ideal']);
  await open(page, daemon, '#panel=faults');
  const ahead = async () => {
    const scip = await Scip.connect(daemon.port);
    const scan = await scip.scan();
    scip.close();
    return scan[540];
  };
  expect(await ahead()).toBeGreaterThan(1000);
  await page.getByRole('button', {name: 'Mud on the window'}).click();
  await expect.poll(ahead).toBe(30);
  await expect(page.locator('#fault-bar')).toHaveAttribute('aria-label', /dirty acted [1-9].* and is active/);
  const band = page.locator('#fault-bar .band');
  const width = async () => Number(await band.getAttribute('width'));
  const before = await width();
  await expect.poll(width).toBeGreaterThan(before);
  await page.getByRole('button', {name: 'Stop all'}).click();
  await expect.poll(ahead).toBeGreaterThan(1000);
  await expect(page.locator('#fault-bar')).toHaveAttribute('aria-label', /dirty acted \d+ times$/);
});

test('the fault log counts what repeats', async ({page, start}) => {
  const daemon = await start();
  await open(page, daemon, '#panel=faults');
  const faults = [{kind: 'dirty', steps: [500, 580], reads: 'weak', for: {s: 30}}, {kind: 'interference', rate: 0.5}];
  for (const fault of faults) await daemon.post(`/sensors/${SENSOR}/faults`, fault);
  const lines = page.locator('#fault-log li');
  const count = async (kind) => Number((await lines.filter({hasText: kind}).locator('.count').allTextContents())
    .join().match(/× (\d+)/)?.[1] ?? 0);
  for (const {kind} of faults) await expect.poll(() => count(kind)).toBeGreaterThan(80);
  await daemon.send('DELETE', `/sensors/${SENSOR}/faults`);
  await expect(lines).toHaveCount(6);
  const {entries} = await daemon.get(`/sensors/${SENSOR}/faults/log`);
  for (const {kind} of faults) {
    expect(await count(kind)).toBe(entries.filter((entry) => entry.kind === kind).length - 2);
  }
});

test('a fault is told in words', async ({page, start}) => {
  const daemon = await start();
  await open(page, daemon, '#panel=faults');
  const cards = page.locator('#faults li');
  const post = (fault) => daemon.post(`/sensors/${SENSOR}/faults`, fault);
  await post({kind: 'cut', how: 'silent', for: {s: 3}, at: {s: 1000}});
  await expect(cards.first()).toContainText('how: silent, for 3 s');
  await post({kind: 'dirty', steps: [500, 580], reads: 'weak', for: {s: 30}});
  await expect(cards.first()).toContainText('steps 500–580, reads weak, for 30 s');
});

async function drop(page, target, name, text) {
  const dataTransfer = await page.evaluateHandle(([file, content]) => {
    const transfer = new DataTransfer();
    transfer.items.add(new File([content], file));
    return transfer;
  }, [name, text]);
  await page.dispatchEvent(target, 'drop', {dataTransfer});
}

test('a scenario begins where its file is dropped', async ({page, start, complaints}) => {
  const daemon = await start();
  await open(page, daemon);
  await drop(page, '#view', 'cable_pulled.yaml', readFileSync(scene('faults/cable_pulled.yaml'), 'utf8'));
  await expect(page.locator('#panel-faults')).toBeVisible();
  await expect(page.locator('#scenario-state')).toContainText('cable_pulled.yaml: ');
  expect((await daemon.get('/scenario')).name).toBe('cable_pulled.yaml');
  await page.getByRole('button', {name: 'Stop the scenario'}).click();
  await expect.poll(async () => (await daemon.get('/scenario')).state).toBe('ended');
  await drop(page, '#panel-faults', 'wrong.yml', 'steps:\n  - {sensor: "*", kind: corupt}\n');
  await expect(page.locator('#scenario-trouble')).toContainText('wrong.yml cannot start.');
  await expect(page.locator('#scenario-trouble')).toContainText('corrupt');
  // The browser tells of the refusal as well.
  for (const text of complaints.splice(0)) expect(text).toMatch(/400.*scenario/);
});

test('a field that holds nonsense starts nothing', async ({page, start}) => {
  const daemon = await start();
  await open(page, daemon, '#panel=faults');
  await page.getByText('Any other fault').click();
  await page.locator('#fault-kind').selectOption('corrupt');
  await page.getByLabel('bytes', {exact: true}).fill('many');
  await page.getByRole('button', {name: 'Start the fault'}).click();
  await expect(page.locator('#fault-trouble')).toHaveText('bytes: a number from 0 to 100');
  expect(await daemon.get(`/sensors/${SENSOR}/faults`)).toEqual([]);
  await page.getByLabel('bytes', {exact: true}).fill('2.5');
  await page.locator('#fault-unit').selectOption('RB');
  await page.getByRole('button', {name: 'Start the fault'}).click();
  await expect.poll(async () => (await daemon.get(`/sensors/${SENSOR}/faults`)).map(({fault}) => fault))
    .toMatchObject([{kind: 'corrupt', bytes: {rate: 0.025}, until: 'RB'}]);
});
