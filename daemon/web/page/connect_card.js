// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The address of the selected scanner and a command that connects a driver to it: shown while no scanner has a client,
// for two minutes at most, and not while the daemon is lost.
import {partsOf, reach, usable} from './addresses.js';
import {byId, make, tell} from './elements.js';

const DRIVER = 'ros2 run urg_node urg_node_driver --ros-args';
const KEY = 'scipd connect card';
const SHOWN_MS = 120_000;

export class ConnectCard {
  constructor({status, settings, notices, connection}) {
    Object.assign(this, {status, settings, notices, connection});
    this.since_ms = null;
    this.tcp = make('code');
    this.tty = make('code');
    this.command = make('code', {id: 'connect-command'});
    this.element = make('section', {class: 'card connect', 'aria-label': 'Connect a driver', hidden: true},
      make('div', {class: 'row'}, make('strong', {}, 'Connect a driver'), make('span', {class: 'space'}),
        make('button', {class: 'quiet', 'aria-label': 'Close this card', on: {click: () => this.close()}}, '×')),
      make('p', {class: 'dim'}, this.name = make('span'), ' has no client. It listens at'),
      make('dl', {class: 'facts'},
        make('div', {}, make('dt', {}, 'TCP'), make('dd', {}, this.tcp)),
        make('div', {}, make('dt', {}, 'tty'), make('dd', {}, this.tty))),
      this.reach = make('p', {class: 'dim'}),
      make('p', {class: 'dim'}, 'For example, with urg_node (ROS 2):'),
      make('div', {class: 'row command'}, this.command,
        make('button', {on: {click: () => this.copy()}, 'aria-label': 'Copy the command'}, 'Copy')));
    byId('panel-sensors').prepend(this.element);
    for (const [source, event] of [[status, 'changed'], [status, 'lost'], [connection, 'lost']]) {
      source.addEventListener(event, () => this.update());
    }
    settings.watch('sensor', () => this.update());
  }

  update() {
    const scanner = this.status.sensor(this.settings.get('sensor'));
    const hasClient = this.status.sensors.some(({clients}) => clients > 0);
    const isClosed = sessionStorage.getItem(KEY) === 'closed';
    const isUseful = this.connection.isOpen && !hasClient && Boolean(scanner?.tcp || scanner?.pty);
    this.since_ms = isUseful ? this.since_ms ?? performance.now() : null;
    this.element.hidden = !isUseful || isClosed || performance.now() - this.since_ms > SHOWN_MS;
    if (this.element.hidden) return;
    const tcp = scanner.tcp && usable(scanner.tcp);
    tell(this.name, scanner.name);
    tell(this.tcp, tcp || 'none');
    tell(this.tty, scanner.pty || 'none');
    tell(this.reach, tcp ? reach(scanner.tcp) : '');
    this.reach.hidden = !this.reach.textContent;
    tell(this.command, `${DRIVER} ${tcp ? overTcp(tcp) : `-p serial_port:=${scanner.pty}`}`);
  }

  async copy() {
    try {
      await navigator.clipboard.writeText(this.command.textContent);
      this.notices.tell('The command is copied.');
    } catch {
      getSelection().selectAllChildren(this.command);
      this.notices.tell('Copy the command that is selected.');
    }
  }

  close() {
    sessionStorage.setItem(KEY, 'closed');
    this.update();
  }
}

function overTcp(tcp) {
  const {host, port} = partsOf(tcp);
  return `-p ip_address:=${host} -p ip_port:=${port}`;
}
