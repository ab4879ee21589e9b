// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The control API: requests with the token, which it asks for when it must.

const KEY = 'scipd token';

/** What the daemon refused, in its own words. */
export class Refusal extends Error {
  constructor(status, problem) {
    const field = problem?.field ? `${problem.field}: ` : '';
    super(field + (problem?.detail || problem?.title || `HTTP status ${status}`));
    this.status = status;
    this.errors = problem?.errors || [];
  }
}

async function refusal(answer) {
  const problem = await answer.json().catch(() => null);
  return new Refusal(answer.status, problem);
}

/** What comes of it, or plain words where it ends before all was said: those of browsers differ. */
async function heard(coming) {
  try {
    return await coming;
  } catch (error) {
    throw new Error(error.name === 'TimeoutError' ? 'the daemon does not answer' : 'the daemon is not there');
  }
}

export class Server {
  /** ask(wrong) is a promise of a token. */
  constructor(ask) {
    this.ask = ask;
    this.token = sessionStorage.getItem(KEY);
    this.asking = null;
  }

  async get(path) {
    const answer = await this.request('GET', path);
    return heard(answer.json());
  }

  /** signal: ends it, however long it takes; without it, patience does. */
  async bytes(path, signal) {
    const answer = await this.request('GET', path, undefined, signal);
    return heard(answer.arrayBuffer());
  }

  async put(path, body) {
    const answer = await this.request('PUT', path, body);
    return answer.status === 204 ? null : heard(answer.json());
  }

  async post(path, body) {
    const answer = await this.request('POST', path, body);
    return heard(answer.json());
  }

  remove(path) {
    return this.request('DELETE', path);
  }

  async request(method, path, body, signal) {
    for (;;) {
      const used = this.token;
      const answer = await heard(fetch(path, this.options(method, body, signal)));
      if (answer.ok) return answer;
      if (answer.status !== 401) throw await refusal(answer);
      await this.newToken(used);
    }
  }

  options(method, body, signal) {
    const headers = {};
    if (this.token) headers.Authorization = `Bearer ${this.token}`;
    if (body !== undefined) headers['Content-Type'] = 'application/json';
    // A daemon that hangs is as good as gone; a world may take its time.
    const patience_ms = method === 'GET' ? 20_000 : 180_000;
    return {
      method,
      headers,
      body: body === undefined ? undefined : JSON.stringify(body),
      signal: signal || AbortSignal.timeout(patience_ms),
    };
  }

  /** Several requests may be refused at once; the user is asked once. */
  async newToken(refused) {
    if (this.token !== refused) return;
    this.asking ??= this.ask(Boolean(refused)).finally(() => { this.asking = null; });
    const answer = await this.asking;
    // What no header can hold is no token, and fetch() would throw at it.
    this.token = /^[\x21-\x7e]+$/.test(answer) ? answer : 'no-token';
    sessionStorage.setItem(KEY, this.token);
  }

  /** A browser cannot set headers of a WebSocket, so the token goes as a subprotocol. */
  socket(path) {
    const address = new URL(path, location.href);
    address.protocol = address.protocol === 'https:' ? 'wss:' : 'ws:';
    const protocols = this.token ? ['scipd', `bearer.${asSubprotocol(this.token)}`] : [];
    const socket = new WebSocket(address, protocols);
    socket.binaryType = 'arraybuffer';
    return socket;
  }
}

/** WebSocket() throws at a subprotocol with other signs than those of a token of HTTP (RFC 9110, 5.6.2). */
function asSubprotocol(text) {
  return encodeURIComponent(text).replaceAll('(', '%28').replaceAll(')', '%29');
}

/** The path of a thing: at('/sensors/', 'robot/scanner', '/faults'); names are percent-encoded. */
export function at(prefix, name, rest = '') {
  return prefix + name.split('/').map(encodeURIComponent).join('/') + rest;
}
