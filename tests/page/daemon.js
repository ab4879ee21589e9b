// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A scipd under test, with its control API on TCP.
import {execFile, spawn} from 'node:child_process';
import {mkdtempSync, rmSync} from 'node:fs';
import {once} from 'node:events';
import {tmpdir} from 'node:os';
import path from 'node:path';
import readline from 'node:readline';
import {promisify} from 'node:util';

export const programs = process.env.SCIPD_PROGRAMS;
export const root = process.env.SCIPD_ROOT;
export const run = promisify(execFile);

export function scene(name) {
  return path.join(root, 'scenes', name);
}

export class Daemon {
  /** http: an address for the page; without it, a free port. */
  static async start(options = [], http = '127.0.0.1:0') {
    const daemon = new Daemon();
    daemon.folder = mkdtempSync(path.join(tmpdir(), 'scipd-page-'));
    const usual = options.includes('--config') ? [] : ['--tcp', '127.0.0.1:0', '--http', http,
      ...(options.includes('--pty') ? [] : ['--pty', 'none'])];
    daemon.process = spawn(path.join(programs, 'scipd'), [...usual, ...options], {
      env: {...process.env, XDG_RUNTIME_DIR: daemon.folder},
      stdio: ['ignore', 'pipe', 'pipe'],
    });
    let log = '';
    daemon.process.stderr.on('data', (text) => { log += text; });
    const lines = readline.createInterface({input: daemon.process.stdout});
    const ended = once(daemon.process, 'exit').then(() => { throw new Error(`scipd ended: ${log}`); });
    ended.catch(() => {});
    const [line] = await Promise.race([once(lines, 'line'), ended]);
    daemon.ready = JSON.parse(line);
    return daemon;
  }

  get address() {
    return `http://${this.ready.http}/`;
  }

  get port() {
    return Number(this.ready.sensors[0].tcp.split(':').pop());
  }

  async get(route, token) {
    const headers = token ? {Authorization: `Bearer ${token}`} : {};
    const answer = await fetch(new URL(route, this.address), {headers});
    if (!answer.ok) throw new Error(`${route}: ${answer.status} ${await answer.text()}`);
    return answer.json();
  }

  put(route, body) {
    return this.send('PUT', route, body);
  }

  post(route, body) {
    return this.send('POST', route, body);
  }

  async send(method, route, body) {
    const answer = await fetch(new URL(route, this.address), {
      method, headers: {'Content-Type': 'application/json'}, body: JSON.stringify(body)});
    if (!answer.ok) throw new Error(`${route}: ${answer.status} ${await answer.text()}`);
  }

  async end(signal = 'SIGTERM') {
    if (this.process.exitCode === null && this.process.signalCode === null) {
      this.process.kill(signal);
      await once(this.process, 'exit');
    }
    rmSync(this.folder, {recursive: true, force: true});
  }
}
