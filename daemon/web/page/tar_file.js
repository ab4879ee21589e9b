// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Several files as one tar (POSIX ustar), which every system can open.

const BLOCK = 512;
const encoder = new TextEncoder();

/** files: [{name, bytes}], of names up to 100 bytes; time_s: since 1970. */
export function tarOf(files, time_s) {
  const parts = [];
  for (const {name, bytes} of files) {
    parts.push(header(name, bytes.byteLength, time_s), bytes, new Uint8Array(-bytes.byteLength & (BLOCK - 1)));
  }
  return new Blob([...parts, new Uint8Array(2 * BLOCK)], {type: 'application/x-tar'});
}

function header(name, size, time_s) {
  const block = new Uint8Array(BLOCK);
  const put = (at, text) => block.set(encoder.encode(text), at);
  const octal = (at, digits, value) => put(at, Math.floor(value).toString(8).padStart(digits, '0'));
  put(0, name);
  octal(100, 7, 0o644);
  octal(108, 7, 0);
  octal(116, 7, 0);
  octal(124, 11, size);
  octal(136, 11, time_s);
  put(148, ' '.repeat(8));
  put(156, '0');
  put(257, 'ustar\x0000');
  octal(148, 6, block.reduce((sum, each) => sum + each, 0));
  block[154] = 0;
  return block;
}
