// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What keys do, and the page that lists them. In a field keys write.
import {byId, isDialogOpen, make} from './elements.js';
import {PAINTS} from './paints.js';

const ORBIT_RAD = 0.08;
const PAN_PX = 40;

export class Keys {
  constructor(parts) {
    Object.assign(this, parts);
    this.table = this.makeTable();
    byId('keys').append(...this.table.filter((row) => row.help).map(
      ({shown, help}) => make('tr', {}, make('td', {}, ...kbd(shown)), make('td', {}, help))));
    byId('help').addEventListener('click', () => this.help());
    byId('help-close').addEventListener('click', () => byId('help-dialog').close());
    window.addEventListener('keydown', (event) => this.press(event));
  }

  help() {
    byId('help-dialog').showModal();
  }

  makeTable() {
    const {settings, viewpoint, selection, views, edits, undo, addDialog, clock, past, tape} = this;
    const orbit = (around, up) => () => viewpoint.orbit(around * ORBIT_RAD, up * ORBIT_RAD);
    const pan = (right, up) => () => viewpoint.pan(right * PAN_PX, up * PAN_PX);
    const toggle = (name) => () => settings.toggle(name);
    const nextPaint = () => {
      const now = PAINTS.findIndex(([name]) => name === settings.get('paint'));
      settings.set('paint', PAINTS[(now + 1) % PAINTS.length][0]);
    };
    return [
      {shown: 'W A S D', help: 'drive the selected thing, or the first robot; with Shift faster'},
      {key: 'n', act: () => selection.step(1), shown: 'N B', help: 'select the next thing, or the one before'},
      {key: 'b', act: () => selection.step(-1)},
      {key: 'arrowleft', act: orbit(-1, 0), shown: '← → ↑ ↓',
        help: 'orbit; with Shift: pan'},
      {key: 'arrowright', act: orbit(1, 0)},
      {key: 'arrowup', act: orbit(0, 1)},
      {key: 'arrowdown', act: orbit(0, -1)},
      {key: 'shift+arrowleft', act: pan(-1, 0)},
      {key: 'shift+arrowright', act: pan(1, 0)},
      {key: 'shift+arrowup', act: pan(0, 1)},
      {key: 'shift+arrowdown', act: pan(0, -1)},
      {key: '+', act: () => viewpoint.zoom(0.87), shown: '+ −', help: 'zoom in, zoom out'},
      {key: '=', act: () => viewpoint.zoom(0.87)},
      {key: 'shift++', act: () => viewpoint.zoom(0.87)},
      {key: '-', act: () => viewpoint.zoom(1.15)},
      {key: 'f', act: views.all, shown: 'F', help: 'fit the whole world'},
      {key: 't', act: views.top, shown: 'T', help: 'top view, as on a plan, and back'},
      {key: 'k', act: () => clock.toggle(), shown: 'K J',
        help: 'with clock: poses: play or pause, one step'},
      {key: 'j', act: () => clock.step()},
      {key: 'l', act: views.follow, shown: 'L', help: 'follow the selected thing, or the first robot'},
      {key: 'r', act: toggle('rays'), shown: 'R', help: 'rays'},
      {key: 'u', act: toggle('fans'), shown: 'U', help: 'fields of view of the other scanners'},
      {key: 'p', act: toggle('points'), shown: 'P', help: 'points'},
      {key: 'v', act: toggle('truth'), shown: 'V', help: 'ground truth'},
      {key: 'e', act: toggle('echoes'), shown: 'E', help: 'all echoes'},
      {key: 'x', act: toggle('through'), shown: 'X', help: 'show hidden points through walls'},
      {key: 'g', act: toggle('grid'), shown: 'G', help: 'grid and axes'},
      {key: 'c', act: nextPaint, shown: 'C', help: 'next colouring of points'},
      {key: 'o', act: () => edits.addShape('box'), shown: 'O',
        help: 'add a box at the pointer; with Shift: a cylinder'},
      {key: 'shift+o', act: () => edits.addShape('cylinder')},
      {key: 'm', act: () => addDialog.choose(), shown: 'M', help: 'add a mesh from a file'},
      {key: 'delete', act: () => edits.remove(selection.thing), shown: 'Delete', help: 'delete the selected model'},
      {key: 'ctrl+z', act: () => undo.undo(), shown: 'Ctrl+Z', help: 'undo'},
      {key: 'i', act: toggle('inspect'), shown: 'I', help: 'inspect at the pointer: on, off'},
      {key: 'y', act: () => tape.toggle(), shown: 'Y', help: 'measure a distance'},
      {key: 'h', act: () => past.toggle(), shown: 'H', help: 'freeze and rewind, or return to live'},
      {key: ',', act: () => past.step(-1), shown: ', .', help: 'one scan back or forward, within the last minute'},
      {key: '.', act: () => past.step(1)},
      {key: 'escape', act: () => this.release(), shown: 'Esc', help: 'cancel / deselect'},
      ...this.panelKeys(),
      {key: 'shift+?', act: () => this.help(), shown: '?', help: 'this list'},
      {key: '?', act: () => this.help()},
    ];
  }

  release() {
    this.selection.select(null);
    this.inspection.pin(null);
    this.tape.set(false);
  }

  panelKeys() {
    return this.tabs.names.map((name, i) => ({
      key: String(i + 1), act: () => this.settings.set('panel', name),
      ...(i === 0 ? {shown: `1 – ${this.tabs.names.length}`, help: 'the panels'} : {}),
    }));
  }

  press(event) {
    if (isDialogOpen()) return;
    if (event.target.closest?.('input:not([type=checkbox]), select, textarea')) return;
    const key = event.key.toLowerCase();
    if (event.altKey || event.metaKey && key !== 'z') return;
    const isCommand = event.ctrlKey || event.metaKey;
    if (!isCommand && this.drive.press(key, event.shiftKey)) {
      event.preventDefault();
      return;
    }
    const name = (isCommand ? 'ctrl+' : '') + (event.shiftKey ? 'shift+' : '') + key;
    const row = this.table.find((each) => each.key === name);
    if (!row) return;
    event.preventDefault();
    row.act();
  }
}

/** Keys with blanks between them; a dash stands for those between two keys. */
function kbd(shown) {
  return shown.split(/( )/).map((part) => /^[ –]$/.test(part) ? part : make('kbd', {}, part));
}
