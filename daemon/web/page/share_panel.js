// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What one takes along: a picture, the scans of the last seconds, a link to the same view.
import {boundSelect, byId, make, tell} from './elements.js';
import {CHOICES} from './settings.js';
import {FILES} from './scan_files.js';
import {missedBetween} from './recorder.js';
import {viewPicture} from './view_picture.js';

const BETWEEN_MS = 1000;

export class SharePanel {
  constructor(page) {
    const {recorder, settings, notices, link} = page;
    Object.assign(this, {page, recorder, settings, notices, link});
    byId('save-picture').addEventListener('click', () => this.savePicture());
    byId('copy-link').addEventListener('click', () => this.copyLink());
    byId('keep').append(boundSelect(settings, 'keep_s', 'Of the last',
      CHOICES.keep_s.map((each) => [each, `${each} s`])));
    byId('save-scans').append(...Object.entries(FILES).map(([ending, {label}]) =>
      make('button', {id: `save-${ending}`, on: {click: () => this.saveScans(ending)}}, label)));
    setInterval(() => this.update(), BETWEEN_MS);
    settings.watch('*', () => this.update());
  }

  update() {
    if (this.settings.get('panel') !== 'share') return;
    const sensor = this.settings.get('sensor');
    const scans = this.scansToSave;
    const missed = missedBetween(scans);
    tell(byId('kept'), scans.length
      ? `${scans.length} scans of ${sensor} are here` + (missed
        ? `. This page was too slow for ${missed} others; scipcat record misses none.` : '.')
      : `No scans of ${sensor || 'any sensor'} are here. Tick a scanner in the panel Sensors.`);
  }

  get scansToSave() {
    return this.recorder.lastOf(this.settings.get('sensor'), this.settings.get('keep_s'));
  }

  async savePicture() {
    download(await viewPicture(this.page), `scipd-${stamp()}.png`);
  }

  saveScans(ending) {
    const recorded = this.scansToSave;
    if (!recorded.length) {
      this.notices.trouble('There are no scans yet. Tick a scanner in the panel Sensors.');
      return;
    }
    const {type, write} = FILES[ending];
    const name = this.settings.get('sensor').replace('/', '-');
    download(new Blob([write(recorded)], {type}), `${name}-${stamp()}.${ending}`);
  }

  async copyLink() {
    const text = this.link.address();
    byId('link').value = text;
    byId('link').hidden = false;
    byId('link').select();
    try {
      await navigator.clipboard.writeText(text);
      this.notices.tell('The link is copied.');
    } catch {
      this.notices.tell('Copy the link that is selected.');
    }
  }
}

function stamp() {
  return new Date().toISOString().slice(0, 19).replace(/:/g, '');
}

function download(blob, name) {
  const address = URL.createObjectURL(blob);
  make('a', {href: address, download: name}).click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}
