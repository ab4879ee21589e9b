// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Which tests a sanitized build leaves out, and why.
#pragma once

namespace scipd::tests {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

/// For tests whose child process runs out of memory on purpose.
inline constexpr const char* sanitizers_want_memory =
    "a sanitizer takes memory for itself, and where none is left it reports that and ends the "
    "process instead of throwing std::bad_alloc";

/// For tests whose child process crashes in a library on purpose.
inline constexpr const char* sanitizers_report_crashes =
    "a sanitizer reports a library's crash, although the child process was made for it";

/// For tests whose child process must be done in a limited time.
inline constexpr const char* sanitizers_take_time =
    "a sanitizer makes Assimp so slow that its child process passes its limit of time";

}  // namespace scipd::tests
