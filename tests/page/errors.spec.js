// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How well a scanner reads changes in its card, while its driver goes on.
import {expect, open, test, withScan} from './page.js';

test('changes how well a scanner reads', async ({page, start, complaints}) => {
  const daemon = await start();
  await open(page, daemon);
  await withScan(page);
  const [{name}] = await daemon.get('/sensors');
  const errors = async () => (await daemon.get(`/sensors/${name}`)).errors;
  const card = page.locator('.card.sensor').first();
  await card.getByText('Accuracy and noise').click();
  await card.getByLabel('Accuracy').selectOption('ideal');
  await expect.poll(errors).toMatchObject({accuracy: 'ideal', noise: 1});
  await card.getByLabel('Noise').fill('3');
  await card.getByLabel('Noise').press('Enter');
  await expect.poll(errors).toMatchObject({accuracy: 'ideal', noise: 3, bias: 'unit'});
  await card.getByLabel('Noise').fill('-1');
  await card.getByLabel('Noise').press('Enter');
  await expect(page.getByText('must be a number from 0 to 100')).toBeVisible();
  await expect(card.getByLabel('Noise')).toHaveValue('3');
  // The browser tells of the refusal as well.
  complaints.length = 0;
});
