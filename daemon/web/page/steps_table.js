// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The steps around one of a scan, as a table.
import {angleOf, causeWords, sentWords} from './beam_words.js';
import {make, tell} from './elements.js';

const ROWS = 11;
const HEADS = ['Step', 'Angle °', 'Sent m', 'True m', 'Error mm', 'Intensity'];

/** act(i): a step that was clicked. */
export class StepsTable {
  constructor(table, act) {
    this.first = 0;
    this.rows = Array.from({length: ROWS}, (_, k) => make('tr', {on: {click: () => act(this.first + k)}},
      make('th', {scope: 'row'}), ...HEADS.slice(1).map(() => make('td'))));
    table.append(
      make('thead', {}, make('tr', {}, ...HEADS.map((head) => make('th', {scope: 'col'}, head)))),
      make('tbody', {}, ...this.rows));
  }

  /** i: the step in the middle, which is marked if it isMarked. */
  show(scan, i, isMarked) {
    this.first = Math.max(Math.min(i - Math.floor(ROWS / 2), scan.beams - ROWS), 0);
    this.rows.forEach((row, k) => {
      const step = this.first + k;
      row.hidden = step >= scan.beams;
      if (row.hidden) return;
      cellsOf(scan, step).forEach((text, column) => tell(row.children[column], text));
      row.title = causeWords(scan, step) || '';
      row.classList.toggle('marked', isMarked && step === i);
    });
  }
}

function cellsOf(scan, i) {
  const {true_m: truth, intensity, sent_mm: sent} = scan.arrays;
  const isMet = Number.isFinite(truth[i]);
  const isSent = sent[i] >= scan.nearest_mm && sent[i] <= scan.dmax_mm;
  return [
    String(scan.first_step + i),
    (angleOf(scan, i) * 180 / Math.PI).toFixed(2).replace('-', '−'),
    isSent ? (sent[i] / 1000).toFixed(3) : sentWords(scan, i).replace('no range, ', ''),
    isMet ? truth[i].toFixed(3) : '–',
    isMet && isSent ? String(Math.round(sent[i] - 1000 * truth[i])).replace('-', '−') : '–',
    intensity.length ? String(intensity[i]) : '–',
  ];
}
