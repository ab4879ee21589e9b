// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One browser for all tests, Debian's, which draws without a graphics card.
import {defineConfig} from '@playwright/test';

export default defineConfig({
  testDir: '.',
  testMatch: '*.spec.js',
  workers: 1,
  // A busy machine without a graphics card is slow.
  timeout: 240_000,
  // It misses a turn now and then. The list of tests says which came right the second time.
  retries: 1,
  expect: {timeout: 30_000},
  reporter: 'list',
  outputDir: process.env.PAGE_TEST_OUTPUT || 'results',
  use: {
    // Each pixel costs, and most tests look at none. Narrower than this the page is that of a phone.
    viewport: {width: 960, height: 540},
    colorScheme: 'light',
    actionTimeout: 60_000,
    launchOptions: {
      executablePath: process.env.CHROMIUM || '/usr/bin/chromium',
      args: ['--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--no-sandbox',
        '--disable-dev-shm-usage', '--disable-background-networking'],
    },
  },
});
