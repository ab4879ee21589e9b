// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Short messages at the edge of the view, which screen readers read aloud.
import {make} from './elements.js';

const STAYS_MS = 5000;
const TROUBLE_STAYS_MS = 12_000;
const MOST = 4;

export class Notices {
  constructor(place) {
    this.place = place;
  }

  tell(text) {
    this.add(text, 'notice', STAYS_MS);
  }

  trouble(text) {
    this.add(text, 'notice trouble', TROUBLE_STAYS_MS);
  }

  /** With a button that does something about it; stays until it is closed. Returns a function that closes it. */
  offer(text, button, act) {
    const notice = this.add(text, 'notice trouble', null, make('button', {on: {click: () => {
      notice.remove();
      act();
    }}}, button));
    return () => notice.remove();
  }

  add(text, kind, stays_ms, button) {
    for (const old of this.place.children) {
      if (old.firstChild.textContent === text) old.remove();
    }
    const notice = make('div', {class: kind}, make('span', {}, text), button, make('button', {
      class: 'quiet', 'aria-label': 'Close this message', on: {click: () => notice.remove()}}, '×'));
    this.place.append(notice);
    if (this.place.children.length > MOST) this.place.firstChild.remove();
    if (stays_ms !== null) setTimeout(() => notice.remove(), stays_ms);
    return notice;
  }
}
