// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What --help prints of an option: its name, a word for its value, and a sentence that ends with
// the bounds and the default. packaging/help_text.py reads it for the man pages.
#pragma once

namespace CLI {
class App;
}

namespace scipd::daemon {

/// For the program and all its commands, which must have been added already.
void use_our_help(CLI::App& program);

}  // namespace scipd::daemon
