// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where a driver finds what listens at a TCP address. One that listens at all addresses is found where the page is.

const ALL = /^(0\.0\.0\.0|\[::\])(?=:\d+$)/;
const LOOPBACK = /^(127\.|localhost\b|\[?::1\b)/;

/** One that a driver can connect to: what is told may be all addresses, which nobody can. */
export function usable(tcp) {
  return tcp.replace(ALL, location.hostname.replace('localhost', '127.0.0.1'));
}

/** Who can connect there, if it is not everybody who sees the page; else nothing. */
export function reach(tcp) {
  const isPageHere = LOOPBACK.test(location.hostname);
  if (ALL.test(tcp)) return isPageHere ? 'From other machines: the address of this one instead.' : '';
  return LOOPBACK.test(tcp) && !isPageHere ? 'Only programs on the machine of scipd can connect there.' : '';
}

/** {host, port}, as drivers want them: an address of IPv6 without its brackets. */
export function partsOf(tcp) {
  const [, host, port] = tcp.match(/^(.*):(\d+)$/);
  return {host: host.replace(/^\[(.*)\]$/, '$1'), port};
}
