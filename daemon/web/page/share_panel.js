// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What one takes along: a picture, a recording that the daemon makes, a link to the same view.
import {at} from './server.js';
import {boundSelect, byId, make, tell} from './elements.js';
import {CHOICES} from './settings.js';
import {viewPicture} from './view_picture.js';

const FORMATS = {mcap: 'MCAP', ubh: 'UBH', csv: 'CSV', jsonl: 'JSON lines'};

export class SharePanel {
  constructor(page) {
    const {server, settings, notices, link} = page;
    Object.assign(this, {page, server, settings, notices, link});
    this.recording = null;
    byId('save-picture').addEventListener('click', () => this.savePicture());
    byId('copy-link').addEventListener('click', () => this.copyLink());
    byId('keep').append(boundSelect(settings, 'scans', 'The next',
      CHOICES.scans.map((each) => [each, `${each} scans`])));
    byId('save-scans').append(...Object.entries(FORMATS).map(([format, label]) =>
      make('button', {id: `save-${format}`, on: {click: () => this.record(format)}}, label)));
    byId('record-stop').addEventListener('click', () => this.recording.abort());
    settings.watch('sensor', () => this.update());
    this.update();
  }

  update() {
    byId('save-scans').hidden = this.recording !== null;
    byId('record-stop').hidden = this.recording === null;
    if (this.recording) return;
    const sensor = this.settings.get('sensor');
    tell(byId('kept'), sensor
      ? `Of ${sensor}, as scipcat record writes them.` : 'Choose a scanner in the panel Sensors.');
  }

  async savePicture() {
    download(await viewPicture(this.page), `scipd-${stamp()}.png`);
  }

  /** The daemon leaves off when nobody waits any more. */
  async record(format) {
    const [sensor, scans] = [this.settings.get('sensor'), this.settings.get('scans')];
    this.recording = new AbortController();
    tell(byId('kept'), `Records ${scans} scans of ${sensor}…`);
    this.update();
    try {
      const path = at('/sensors/', sensor, `/recording?format=${format}&scans=${scans}`);
      const bytes = await this.server.bytes(path, this.recording.signal);
      download(new Blob([bytes]), `${sensor.replace('/', '-')}-${stamp()}.${format}`);
    } catch (error) {
      if (!this.recording.signal.aborted) this.notices.trouble(`${sensor}: ${error.message}`);
    }
    this.recording = null;
    this.update();
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
