// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A driver's end of SCIP over TCP, written from the protocol and not from scipd's code.
import net from 'node:net';

const PATIENCE_MS = 15_000;

function decode(text) {
  let value = 0;
  for (const letter of text) value = value * 64 + letter.charCodeAt(0) - 0x30;
  return value;
}

function isRight(line) {
  const body = line.slice(0, -1);
  const sum = [...body].reduce((all, letter) => all + letter.charCodeAt(0), 0);
  return String.fromCharCode((sum & 0x3f) + 0x30) === line.slice(-1);
}

export class Scip {
  static async connect(port) {
    const scip = new Scip();
    scip.socket = net.connect(port, '127.0.0.1');
    scip.text = '';
    scip.waiting = null;
    scip.socket.on('data', (data) => scip.take(data));
    await new Promise((done, fail) => scip.socket.once('connect', done).once('error', fail));
    return scip;
  }

  take(data) {
    this.text += data.toString('latin1');
    this.waiting?.();
  }

  /** The lines of the next message, without the empty one. */
  async message() {
    const end_ms = Date.now() + PATIENCE_MS;
    for (;;) {
      const end = this.text.indexOf('\n\n');
      if (end >= 0) {
        const lines = this.text.slice(0, end).split('\n');
        this.text = this.text.slice(end + 2);
        return lines;
      }
      if (Date.now() > end_ms) throw new Error('the scanner says nothing');
      await new Promise((done) => {
        this.waiting = done;
        setTimeout(done, 100);
      });
    }
  }

  say(request) {
    this.socket.write(`${request}\n`);
  }

  async ask(request) {
    this.say(request);
    return this.message();
  }

  /** The distances of all steps of a UST-10LX, in mm. */
  async scan() {
    await this.ask('BM');
    for (let tries = 0; tries < 50; ++tries) {
      const [, status, , ...data] = await this.ask('GD0000108000');
      if (!status.startsWith('00')) continue;
      if (!data.every(isRight)) throw new Error('a sum is wrong');
      const letters = data.map((line) => line.slice(0, -1)).join('');
      return Array.from({length: letters.length / 3}, (_, i) => decode(letters.slice(3 * i, 3 * i + 3)));
    }
    throw new Error('the scanner has no scan');
  }

  close() {
    this.socket.destroy();
  }
}
