// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The page and the daemon: faults on the wire, a daemon that is killed, tokens, and many pages at once.
import {writeFileSync} from 'node:fs';
import path from 'node:path';
import {SENSOR, expect, open, test, withScan} from './page.js';
import {programs, run, scene} from './daemon.js';
import {Scip} from './scip.js';

test('a fault that the page starts is seen on the wire', async ({page, start}) => {
  const daemon = await start();
  await open(page, daemon);
  await page.getByRole('tab', {name: 'Faults'}).click();
  await page.getByText('Any other fault').click();
  await page.locator('#fault-kind').selectOption('status');
  await page.getByLabel('status', {exact: true}).fill('0L');
  await page.getByLabel('command', {exact: true}).fill('MD');
  await page.getByLabel('Lasts for').fill('');
  await page.getByRole('button', {name: 'Start the fault'}).click();
  await expect(page.locator('#faults li')).toContainText('active');

  await page.getByRole('tab', {name: 'Wire'}).click();
  const scip = await Scip.connect(daemon.port);
  // The panel listens a moment after it was opened.
  await expect(async () => {
    expect((await scip.ask('MD0000108001001'))[1].slice(0, 2)).toBe('0L');
    await expect(page.locator('#wire li.reply .chip').last()).toHaveText('status 0L', {timeout: 500});
  }).toPass();
  await expect(page.locator('#wire li.request code').last()).toHaveText(/^MD0000108001001/);
  await expect(page.locator('#wire li.request .means').last()).not.toBeEmpty();
  await expect(page.locator('#wire li.reply .explains').last()).not.toBeEmpty();

  await page.getByRole('tab', {name: 'Faults'}).click();
  await page.getByRole('button', {name: /^Stop fault/}).click();
  await expect(page.locator('#faults li')).toHaveCount(0);
  expect((await scip.ask('MD0000108001001'))[1].slice(0, 2)).toBe('00');
  scip.close();
});

test('a reply that a fault swallows whole has its place in the conversation', async ({page, start}) => {
  const daemon = await start();
  await open(page, daemon);
  await page.getByRole('tab', {name: 'Wire'}).click();
  const scip = await Scip.connect(daemon.port);
  await expect(async () => {
    await scip.ask('VV');
    await expect(page.locator('#wire li.reply')).not.toHaveCount(0, {timeout: 500});
  }).toPass();
  await daemon.post(`/sensors/${SENSOR}/faults`, {kind: 'truncate', keep: 0, command: 'VV'});
  await page.locator('#wire-clear').click();
  scip.say('VV');
  await expect(page.locator('#wire li.fault')).toHaveText(/fault truncate/);
  await scip.ask('PP');
  await expect(page.locator('#wire li')).toHaveText([/VV/, /fault truncate/, /PP/, /PP/]);
  scip.close();
});

test('each kind of fault starts as the form proposes it', async ({page, start}, info) => {
  const daemon = await start(['--pty', info.outputPath('tty')]);
  await open(page, daemon);
  await page.getByRole('tab', {name: 'Faults'}).click();
  const kinds = (await daemon.get('/faults/kinds')).map(({kind}) => kind);
  await page.getByText('Any other fault').click();
  await page.locator('#fault-at').fill('1000');
  for (const kind of kinds) {
    await page.locator('#fault-kind').selectOption(kind);
    await page.getByRole('button', {name: 'Start the fault'}).click();
    await expect.poll(async () => (await daemon.get(`/sensors/${SENSOR}/faults`)).map((each) => each.kind),
      {message: `${kind}: ${await page.locator('#fault-trouble').textContent()}`}).toContain(kind);
  }
});

test('tells that the daemon is gone, and goes on when it is back', async ({page, start, complaints}) => {
  const daemon = await start();
  await open(page, daemon);
  await withScan(page);
  const address = daemon.ready.http;
  await daemon.end('SIGKILL');
  await expect(page.locator('#state')).toHaveText('lost');
  await expect(page.locator('#lost')).toBeVisible();
  await page.locator('#canvas').press('o');
  await expect(page.locator('#notices')).toContainText('box cannot be added: the daemon is not there');
  const again = await start(['--scene', scene('square_room.sdf')], address);
  await expect(page.locator('#state')).toHaveText('live');
  await expect(page.locator('#lost')).toBeHidden();
  await expect(page.locator('#world-name')).toHaveText('square_room.sdf');
  const objects = (await again.get('/scene/objects')).objects.length;
  await page.getByRole('tab', {name: 'World'}).click();
  await expect(page.locator('#world-size')).toContainText(`${objects} objects`);
  await page.getByRole('tab', {name: 'Sensors'}).click();
  const scans = async () => Object.values((await again.get(`/sensors/${SENSOR}`)).casts).reduce((a, b) => a + b, 0);
  const before = await scans();
  await expect.poll(scans).toBeGreaterThan(before);
  // The browser itself tells of connections that fail.
  for (const text of complaints) expect(text).toMatch(/ERR_CONNECTION|Failed to load resource|WebSocket/);
  complaints.length = 0;
});

test('says in plain words that the daemon does not answer', async ({page, start}) => {
  const daemon = await start();
  await open(page, daemon);
  await page.evaluate(() => {
    const timeout = AbortSignal.timeout.bind(AbortSignal);
    AbortSignal.timeout = () => timeout(500);
  });
  await page.route('**/scene/models', () => {});
  await page.locator('#canvas').press('o');
  await expect(page.locator('#notices')).toContainText('box cannot be added: the daemon does not answer');
});

test('asks for the new token when the daemon comes back with another', async ({page, start, complaints}, info) => {
  const file = info.outputPath('token');
  const config = info.outputPath('config.yaml');
  const begin = async (token, port) => {
    writeFileSync(file, `${token}\n`, {mode: 0o600});
    writeFileSync(config, `scene: ${scene('square_room.sdf')}
http: {listen: "127.0.0.1:${port}", token_file: ${file}}
robots: {robot: {sensors: {scanner: {model: UST-10LX, tcp: "127.0.0.1:0"}}}}
`);
    return start(['--config', config]);
  };
  const give = async (token) => {
    await page.locator('#token').fill(token);
    await page.getByRole('button', {name: 'Continue'}).click();
  };
  const [old, other] = ['an+old/token,of(this)test==012345', 'another-token-of-this-test-01234'];
  const daemon = await begin(old, 0);
  await page.goto(daemon.address);
  await give(old);
  await expect(page.locator('#state')).toHaveText('live');
  const port = new URL(daemon.address).port;
  await daemon.end('SIGKILL');
  await expect(page.locator('#state')).toHaveText('lost');
  await begin(other, port);
  await expect(page.locator('#token-wrong')).toBeVisible();
  await give(other);
  await expect(page.locator('#state')).toHaveText('live');
  await expect(page.locator('#token-dialog')).toBeHidden();
  await withScan(page);
  // The browser itself tells of connections that fail and of tokens that are refused.
  for (const text of complaints.splice(0)) expect(text).toMatch(/401|ERR_CONNECTION|Failed to load resource|WebSocket/);
});

test('asks for the token, and works with it', async ({page, start, complaints}, info) => {
  const file = info.outputPath('token');
  writeFileSync(file, 'a-token-of-this-test-0123456789\n', {mode: 0o600});
  const config = info.outputPath('config.yaml');
  writeFileSync(config, `scene: ${scene('square_room.sdf')}
http: {listen: "127.0.0.1:0", token_file: ${file}}
robots: {robot: {sensors: {scanner: {model: UST-10LX, tcp: "127.0.0.1:0"}}}}
`);
  const daemon = await start(['--config', config]);
  await page.goto(daemon.address);
  for (let i = 0; i < 3; ++i) await page.keyboard.press('Escape');
  await page.locator('#token').fill('wrong');
  await page.getByRole('button', {name: 'Continue'}).click();
  await expect(page.locator('#token-wrong')).toBeVisible();
  await page.locator('#token').fill('a-token-of-this-test-0123456789');
  await page.getByRole('button', {name: 'Continue'}).click();
  await expect(page.locator('#state')).toHaveText('live');
  await withScan(page);
  await page.reload();
  await withScan(page);
  await page.getByRole('tab', {name: 'Share'}).click();
  await page.getByRole('button', {name: 'Copy a link'}).click();
  expect(await page.locator('#link').inputValue()).not.toContain('token-of');
  for (const text of complaints) expect(text).toMatch(/401/);
  complaints.length = 0;
});

test('ten pages at once take nothing from a driver', async ({browser, start}) => {
  const daemon = await start();
  const context = await browser.newContext({viewport: {width: 480, height: 320}});
  const pages = await Promise.all(Array.from({length: 10}, () => context.newPage()));
  await Promise.all(pages.map((page) => page.goto(daemon.address)));
  for (const page of pages) await withScan(page);
  // It fails if a scan is missing or a byte is wrong.
  const load = await run(path.join(programs, 'scipbench'),
    ['load', '--seconds', '5', `tcp://${daemon.ready.sensors[0].tcp}`]).catch((error) => error);
  expect(load.code, load.stdout).toBeUndefined();
  for (const page of pages) await expect(page.locator('#state')).toHaveText('live');
  await context.close();
});
