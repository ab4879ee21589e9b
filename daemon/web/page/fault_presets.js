// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Common faults by the names that people have for them, each as one fault or several that begin together. A page test
// starts each of them. `front` is the step straight ahead.

export const FAULT_PRESETS = [
  {name: 'Cable pulled', about: 'for 3 s, no bytes arrive, and the tty is gone',
    faults: () => [{kind: 'cut', how: 'silent', for: {s: 3}}, {kind: 'hangup', for: {s: 3}, tty: true}]},
  {name: 'Power cycled', about: 'silent for 2 s, then the scanner boots',
    faults: () => [{kind: 'cut', how: 'silent', boot: true, for: {s: 2}}]},
  {name: 'Loose plug', about: 'about every 8 s, half a second of data is lost, until you stop it',
    faults: () => [{kind: 'cut', how: 'silent', for: {s: 0.5}, every: {s: 8}, jitter: {s: 2}}]},
  {name: 'Slow USB hub', about: 'for 20 s, bytes arrive late and in bursts',
    faults: () => [{kind: 'delay', ms: 40, jitter_ms: 30, for: {s: 20}}, {kind: 'coalesce', ms: 60, for: {s: 20}}]},
  {name: 'Electrical noise', about: 'for 20 s, one byte in 2000 is wrong',
    faults: () => [{kind: 'corrupt', bytes: {rate: 0.0005}, for: {s: 20}}]},
  {name: 'Dirty window', about: 'for 30 s, a sector straight ahead returns too weak an echo',
    faults: (front) => [{kind: 'dirty', steps: [Math.max(front - 40, 0), front + 40], reads: 'weak', for: {s: 30}}]},
  {name: 'Mud on the window', about: 'for 30 s, a sector straight ahead reads 30 mm',
    faults: (front) => [{kind: 'dirty', steps: [Math.max(front - 20, 0), front + 20], reads: 'near', for: {s: 30}}]},
  {name: 'Low sun', about: 'for 20 s, one beam in 20 reads a random range',
    faults: () => [{kind: 'interference', rate: 0.05, for: {s: 20}}]},
  {name: 'Busy computer', about: 'for 20 s, scans leave late, and one in ten is missing',
    faults: () => [{kind: 'late', ms: 40, for: {s: 20}}, {kind: 'skip', rate: 0.1, for: {s: 20}}]},
  {name: 'Motor failing', about: 'for 10 s, the motor turns 10 % too slowly',
    faults: () => [{kind: 'motor', percent: -10, for: {s: 10}}]},
  {name: 'Laser failing', about: 'the scanner reports it until it is rebooted (RB)',
    faults: () => [{kind: 'state', state: 'laser', until: 'RB'}]},
  {name: 'Clock jumps', about: 'for 10 s, its clock is 402 s behind',
    faults: () => [{kind: 'clock', jump_ms: -402_000, for: {s: 10}}]},
];
