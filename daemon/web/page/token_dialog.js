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
      dialog.onclose = null;
      dialog.close();
      done(input.value.trim());
    };
    byId('token-form').addEventListener('submit', take);
    // Without a token nothing goes on, so Esc does not end the question. A browser heeds no refusal of the second Esc.
    const show = () => { if (!dialog.open) dialog.showModal(); };
    dialog.onclose = show;
    show();
    input.focus();
  });
}
