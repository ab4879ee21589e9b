// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a function answers that reads what a user sent: the value, or what is wrong with it
// (docs/style.md says when). Values; any thread.
#pragma once

#include <string>
#include <utility>

#include <tl/expected.hpp>

namespace scipd::sim {

/// What is wrong with what a user sent.
struct Fault {
    std::string field;  ///< the part of it that is wrong; empty: the whole, or the caller knows it
    std::string why;    ///< a sentence for the user: what is wrong and what to do

    bool operator==(const Fault&) const = default;
};

template <class Value = void>
using Expected = tl::expected<Value, Fault>;

/// `return refuse(..)` ends a function that answers with an Expected.
inline tl::unexpected<Fault> refuse(std::string field, std::string why) {
    return tl::unexpected<Fault>(Fault{std::move(field), std::move(why)});
}
inline tl::unexpected<Fault> refuse(std::string why) {
    return refuse({}, std::move(why));
}

}  // namespace scipd::sim
