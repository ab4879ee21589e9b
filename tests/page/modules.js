// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Modules of the page that need no browser.
import {readFileSync} from 'node:fs';
import path from 'node:path';
import {root} from './daemon.js';

export function moduleOf(name) {
  const source = readFileSync(path.join(root, 'daemon/web/page', name));
  return import(`data:text/javascript;base64,${source.toString('base64')}`);
}
