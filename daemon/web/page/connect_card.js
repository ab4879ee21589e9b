// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How one connects a driver to the chosen scanner, for as long as no scanner has a client.
import {partsOf, reach, usable} from './addresses.js';
import {byId, make, tell} from './elements.js';

const DRIVER = 'ros2 run urg_node urg_node_driver --ros-args';
const KEY = 'scipd connect card';

export class ConnectCard {
  constructor({status, settings, notices}) {
    Object.assign(this, {status, settings, notices});
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
      make('p', {class: 'dim'}, 'such as urg_node of ROS 2:'),
      make('div', {class: 'row command'}, this.command,
        make('button', {on: {click: () => this.copy()}, 'aria-label': 'Copy the command'}, 'Copy')));
    byId('panel-sensors').prepend(this.element);
    status.addEventListener('changed', () => this.update());
    settings.watch('sensor', () => this.update());
  }

  update() {
    const scanner = this.status.sensor(this.settings.get('sensor'));
    const hasClient = this.status.sensors.some(({clients}) => clients > 0);
    const isClosed = sessionStorage.getItem(KEY) === 'closed';
    this.element.hidden = isClosed || hasClient || !(scanner?.tcp || scanner?.pty);
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
