// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the page tells of where drivers connect, and of sensors that must stay.
import {configuration, expect, open, test, withScan} from './page.js';
import {Scip} from './scip.js';
import {moduleOf} from './modules.js';

test('an address that nobody can connect to is not shown', async ({page, start}, info) => {
  const daemon = await start(configuration(info, 'square_room.sdf', {scanner: {model: 'UST-10LX', tcp: '0.0.0.0:0'}}));
  await open(page, daemon);
  await withScan(page);
  const card = page.locator('#sensors .sensor');
  const place = `127.0.0.1:${daemon.port}`;
  for (const element of [card, page.locator('.connect')]) {
    await expect(element).toContainText(place);
    await expect(element).not.toContainText('0.0.0.0');
  }
  await expect(page.locator('.connect')).toContainText('From other machines: the address of this one instead.');
  await expect(page.locator('#connect-command')).toContainText(`ip_address:=127.0.0.1 -p ip_port:=${daemon.port}`);
  // It goes with a client, and comes back without a word of a first one.
  const scip = await Scip.connect(daemon.port);
  await expect(page.locator('.connect')).toBeHidden();
  scip.close();
  await expect(page.locator('.connect')).toContainText('robot/scanner has no client. It listens at');
  await expect(page.locator('.connect')).not.toContainText('first');
});

test('says who can connect where', async () => {
  const {partsOf, reach, usable} = await moduleOf('addresses.js');
  const at = (hostname, tcp) => {
    globalThis.location = {hostname};
    return [usable(tcp), reach(tcp)];
  };
  const others = 'From other machines: the address of this one instead.';
  const only = 'Only programs on the machine of scipd can connect there.';
  expect(at('127.0.0.1', '0.0.0.0:10940')).toEqual(['127.0.0.1:10940', others]);
  expect(at('localhost', '0.0.0.0:10940')).toEqual(['127.0.0.1:10940', others]);
  expect(at('[::1]', '[::]:10940')).toEqual(['[::1]:10940', others]);
  expect(at('robot.local', '0.0.0.0:10940')).toEqual(['robot.local:10940', '']);
  expect(at('robot.local', '[::]:10940')).toEqual(['robot.local:10940', '']);
  expect(at('robot.local', '127.0.0.1:10940')).toEqual(['127.0.0.1:10940', only]);
  expect(at('127.0.0.1', '127.0.0.1:10940')).toEqual(['127.0.0.1:10940', '']);
  expect(at('robot.local', '192.168.0.10:10940')).toEqual(['192.168.0.10:10940', '']);
  delete globalThis.location;
  expect(partsOf('[fe80::1]:10940')).toEqual({host: 'fe80::1', port: '10940'});
  expect(partsOf('robot.local:1')).toEqual({host: 'robot.local', port: '1'});
});

test('the last sensor cannot be removed, and Delete tells how a robot is', async ({page, start}) => {
  const daemon = await start();
  await open(page, daemon, '#select=robots:robot');
  const remove = page.getByRole('button', {name: 'Remove sensor…'});
  await expect(remove).toBeDisabled();
  await expect(remove).toHaveAttribute('title', 'The last sensor cannot be removed');
  await page.locator('#canvas').press('Delete');
  await expect(page.locator('#notices')).toContainText('robot is the only robot, and scipd needs one.');
  await daemon.post('/sensors', {name: 'second/scanner', model: 'UST-10LX', tcp: '127.0.0.1:0'});
  await expect(remove).toHaveCount(2);
  for (const each of [0, 1]) await expect(remove.nth(each)).toBeEnabled();
  await page.locator('#canvas').press('Delete');
  await expect(page.locator('#notices')).toContainText('robot is a robot, which is removed with its last sensor.');
  await page.locator('#canvas').press('Escape');
  await page.locator('#canvas').press('Delete');
  await expect(page.locator('#notices')).toContainText('Nothing is selected.');
});
