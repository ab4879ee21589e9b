// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Asks before something that cannot be undone.
import {byId, tell} from './elements.js';

/** A promise of whether to go on. */
export function ask(question, why, go) {
  const dialog = byId('ask-dialog');
  tell(byId('ask-title'), question);
  tell(byId('ask-why'), why);
  tell(byId('ask-go'), go);
  dialog.returnValue = '';
  dialog.showModal();
  return new Promise((done) => {
    dialog.addEventListener('close', () => done(dialog.returnValue === 'go'), {once: true});
  });
}
