// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The page begins here.
import { REVISION } from "./three.module.js";

document.body.textContent = `scipd, with three.js r${REVISION}`;
