// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the members of each kind of fault are: words to choose of, numbers with their unit and bounds, sectors, bytes. A
// page test holds them to what the daemon takes. `inside`: the bound itself is refused.

const words = (about, list, fallback) => ({type: 'words', about, words: list, fallback});
const number = (about, unit, least, most, rest = {}) => ({type: 'number', about, unit, least, most, ...rest});
const share = (about, fallback) => ({type: 'share', about, fallback});
const vector = (about, unit, most) => ({type: 'vector', about, unit, most});
const flag = (about) => ({type: 'flag', about});
const code = (about) => ({type: 'code', about, fallback: 'any'});
const bytes = (about, ways, least) => ({type: 'bytes', about, ways, least, most: 65_535});
const WHOLE = {whole: true};

const STEPS = {type: 'steps', about: 'the first and the last step of the sector', least: 0, most: 100_000};
const BYTES = bytes('which bytes are hit', ['rate', 'at'], 0);
const MESSAGES = words('of which messages', ['all', 'scans', 'replies'], 'all');
const COMMAND = code('the code of a command, such as MD');
const OF_MESSAGES = share('of which share of messages', '100');
const DELAY_MS = (about, rest) => number(about, 'ms', 0, 10_000, rest);

export const FAULT_FIELDS = {
  corrupt: {bytes: BYTES, messages: MESSAGES, within: words('sums are the ends of lines', ['all', 'sums'], 'all')},
  lose: {bytes: BYTES, messages: MESSAGES},
  duplicate: {bytes: BYTES, messages: MESSAGES},
  noise: {count: number('number of bytes', 'bytes', 1, 4096, {...WHOLE, fallback: 20}),
    value: words('which bytes', ['nul', 'random'], 'nul')},
  delay: {ms: DELAY_MS('delay of messages'),
    jitter_ms: DELAY_MS('jitter, to either side', {fallback: 0})},
  coalesce: {ms: DELAY_MS('what is sent within this time leaves in one write')},
  split: {bytes: bytes('before which bytes messages are cut', ['at', 'every'], 1),
    pause_ms: DELAY_MS('between pieces', {fallback: 2})},
  stall: {},
  cut: {how: words('fin, rst: closed; silent: no bytes arrive; refuse: no new clients; mute: no replies',
    ['fin', 'rst', 'silent', 'refuse', 'mute'], 'rst'),
  boot: flag('the scanner boots at the end, as its cable carries power')},
  hangup: {},
  sums: {of: words('which sums', ['status', 'data', 'text', 'all'], 'all'), messages: MESSAGES, command: COMMAND,
    rate: OF_MESSAGES},
  truncate: {keep: number('bytes kept of each message', 'bytes', 0, 1_000_000, {...WHOLE, fallback: 'half'}),
    messages: MESSAGES, command: COMMAND, rate: OF_MESSAGES},
  linefeed: {lines: words('which line feeds are missing', ['last', 'all'], 'last'), messages: MESSAGES,
    command: COMMAND, rate: OF_MESSAGES},
  echo: {messages: MESSAGES, command: COMMAND, rate: OF_MESSAGES},
  resend: {what: words('the same reply twice, or the one before', ['twice', 'previous'], 'twice'), command: COMMAND,
    rate: OF_MESSAGES},
  status: {status: {type: 'status', about: 'two of 0-9 and A-Z'}, command: COMMAND},
  reboot: {boot_s: number('duration of the boot', 's', 0, 3600, {inside: true, fallback: 'as the model'})},
  state: {state: words('reported error state', ['unstable', 'recovering', 'laser', 'abnormal'])},
  sleep: {},
  motor: {percent: number('speed difference', '%', -50, 50, WHOLE),
    spin_up_s: number('spin-up time', 's', 0, 3600, {inside: true})},
  clock: {jump_ms: number('jump ahead', 'ms', -16_777_215, 16_777_215, WHOLE),
    ppm: number('rate error, positive: too fast', 'ppm', -10_000, 10_000),
    wrap_in_s: number('time until its 24 bits wrap', 's', 0, 3600, {inside: true}),
    frozen: flag('the clock stops'),
    repeat: number('the clock advances once in N scans', 'scans', 2, 1000, WHOLE)},
  repeat: {rate: share('which share of scans', '100')},
  reorder: {rate: share('which share of scans', '100')},
  freeze: {},
  skip: {rate: share('which share of scans', '100')},
  late: {ms: number('delay of scans', 'ms', 0, 900, {inside: true})},
  shift: {by: number('shift of the readings', 'steps', -10_000, 10_000, WHOLE)},
  intensity: {},
  dirty: {steps: STEPS,
    reads: words('30 mm, or the code for a weak echo or none', ['near', 'weak', 'nothing'], 'near')},
  blind: {steps: STEPS},
  interference: {steps: {...STEPS, fallback: 'all'}, rate: share('which share of beams', '1')},
  stick: {steps: STEPS, range_m: number('the range that it reads', 'm', 0, 1e7, {fallback: 'as at first'})},
  poses: {how: words('from where it is cast', ['stop', 'late', 'jump']),
    ms: number('of late: that time', 'ms', 0, 10_000, {inside: true}),
    xyz: vector('of jump: how far beside', 'm', 1e7), rpy: vector('of jump: how it is turned', 'rad', 1e6)},
};
