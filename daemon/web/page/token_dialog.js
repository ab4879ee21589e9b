// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Asks for the token of the control API.
import {byId} from './elements.js';

/** A promise of a token; wrong says that the last one was. */
export function askForToken(wrong) {
  const dialog = byId('token-dialog');
  const input = byId('token');
  byId('token-wrong').hidden = !wrong;
  input.value = '';
  return new Promise((done) => {
    const take = (event) => {
      event.preventDefault();
      if (!input.value.trim()) return;
      byId('token-form').removeEventListener('submit', take);
      dialog.close();
      done(input.value.trim());
    };
    byId('token-form').addEventListener('submit', take);
    dialog.oncancel = (event) => event.preventDefault();
    if (!dialog.open) dialog.showModal();
    input.focus();
  });
}
