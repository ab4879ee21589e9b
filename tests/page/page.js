// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What tests share: a page that must not complain, and daemons that end with the test.
import {writeFileSync} from 'node:fs';
import {test as base, expect} from '@playwright/test';
import {Daemon, scene} from './daemon.js';

export {expect};

/** For tests that measure pixels, or whose handles and words take more of a smaller window. */
export const WIDE = {viewport: {width: 1280, height: 720}};

export const test = base.extend({
  /** start(options): a scipd that ends with the test. */
  start: async ({}, use) => {
    const daemons = [];
    await use(async (...args) => {
      daemons.push(await Daemon.start(...args));
      return daemons[daemons.length - 1];
    });
    for (const daemon of daemons) await daemon.end('SIGKILL');
  },

  /** What the browser's console complained of while the daemons ran. A test that expects some empties it. */
  complaints: [async ({page, start}, use) => {
    const complaints = [];
    // Chromium may fetch the icon when the tab has already left for about:blank, and then blocks it.
    const isLateIcon = (text, url) =>
      /icon\.svg.* origin 'null'/.test(text) || (/ERR_FAILED/.test(text) && url.endsWith('/page/icon.svg'));
    page.on('console', (message) => {
      const [text, {url}] = [message.text(), message.location()];
      if (['error', 'warning'].includes(message.type()) && !isLateIcon(text, url)) complaints.push(`${text} ${url}`);
    });
    page.on('pageerror', (error) => complaints.push(error.stack));
    await use(complaints);
    expect(complaints).toEqual([]);
  }, {auto: true}],
});

/** Opens the page, and waits until it is live and a scan is drawn. */
export async function open(page, daemon, hash = '') {
  await page.goto(daemon.address + hash);
  await expect(page.locator('#state')).toHaveText('live');
}

export async function withScan(page) {
  await expect(page.locator('#legend')).toBeVisible();
}

/** The page's sensors at the test's first daemon are one UST-10LX: this is its name. */
export const SENSOR = 'robot/scanner';

export async function near(read, wanted, tolerance) {
  await expect.poll(async () => Math.abs(await read() - wanted), {timeout: 30_000})
    .toBeLessThan(tolerance);
}

/** Options of a scipd with these sensors of one robot. */
export function configuration(info, world, sensors) {
  const file = info.outputPath('config.yaml');
  writeFileSync(file, `scene: ${scene(world)}
http: {listen: "127.0.0.1:0"}
robots: {robot: {sensors: ${JSON.stringify(sensors)}}}
`);
  return ['--config', file];
}
