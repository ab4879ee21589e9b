// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the form of faults begins with: an example for each kind that needs more than its name. A page test starts each
// of them.

export const FAULT_EXAMPLES = {
  corrupt: {bytes: {rate: 0.01}},
  lose: {bytes: {rate: 0.001}},
  duplicate: {bytes: {rate: 0.001}},
  delay: {ms: 50, jitter_ms: 10},
  coalesce: {ms: 100},
  split: {bytes: {at: [3, 20]}, pause_ms: 5},
  truncate: {keep: 100, messages: 'scans', rate: 0.1},
  status: {status: '0L', command: 'MD'},
  state: {state: 'abnormal'},
  motor: {percent: -10},
  clock: {jump_ms: -402000},
  repeat: {rate: 0.1},
  reorder: {rate: 0.1},
  skip: {rate: 0.2},
  late: {ms: 20},
  shift: {by: 10},
  dirty: {steps: [400, 500], reads: 'weak'},
  blind: {steps: [400, 500]},
  interference: {rate: 0.05},
  stick: {steps: [400, 500], range_m: 1.5},
  poses: {how: 'late', ms: 200},
};
