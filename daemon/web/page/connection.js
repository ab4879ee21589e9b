// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A WebSocket that comes back by itself. Events: open, lost, text (parsed JSON) and binary.

const FIRST_PAUSE_MS = 250;
const LONGEST_PAUSE_MS = 4000;

export class Connection extends EventTarget {
  constructor(server, path) {
    super();
    this.server = server;
    this.path = path;
    this.pause_ms = FIRST_PAUSE_MS;
    this.wanted = false;
    this.socket = null;
  }

  open() {
    if (this.wanted) return;
    this.wanted = true;
    this.connect();
  }

  close() {
    this.wanted = false;
    clearTimeout(this.timer);
    const socket = this.socket;
    this.socket = null;
    // Browsers complain of a WebSocket that is closed before it is open.
    if (socket?.readyState === WebSocket.CONNECTING) socket.onopen = () => socket.close();
    else socket?.close();
  }

  get isOpen() {
    return this.socket?.readyState === WebSocket.OPEN;
  }

  send(message) {
    if (this.isOpen) this.socket.send(JSON.stringify(message));
  }

  connect() {
    const socket = this.server.socket(this.path);
    this.socket = socket;
    socket.onopen = () => {
      this.pause_ms = FIRST_PAUSE_MS;
      this.dispatchEvent(new Event('open'));
    };
    socket.onmessage = (event) => {
      if (socket === this.socket) this.take(event.data);
    };
    socket.onclose = (event) => {
      if (socket === this.socket) this.lost(event);
    };
  }

  take(data) {
    const isText = typeof data === 'string';
    const detail = isText ? JSON.parse(data) : data;
    this.dispatchEvent(new CustomEvent(isText ? 'text' : 'binary', {detail}));
  }

  lost(event) {
    if (!this.wanted) return;
    this.dispatchEvent(new CustomEvent('lost', {detail: event.reason}));
    this.timer = setTimeout(() => this.again(), this.pause_ms);
    this.pause_ms = Math.min(2 * this.pause_ms, LONGEST_PAUSE_MS);
  }

  /** A WebSocket does not tell why it was refused, but a request does: the token may be missing. */
  async again() {
    try {
      await this.server.get('/health');
    } catch (error) {
      if (this.wanted) this.lost({reason: error.message});
      return;
    }
    if (this.wanted) this.connect();
  }
}
