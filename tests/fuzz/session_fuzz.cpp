// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Whole lives of a device, made up from the fuzzer's bytes: any model, up to three clients, all
// kinds of requests, scans, waits, hang-ups, boots and failures. Every client checks all that it
// receives, all requests are answered in the end, and time never stands still. Now and then a
// client repeats what it sent, in pieces, and must get the same answer. A find is printed as a
// script.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string>
#include <string_view>

#include "daemon/models/model_registry.h"
#include "tests/protocol/script.h"
#include "tests/protocol/script_maker.h"

namespace {

using namespace scipd;

void require(bool holds, const std::string& fault, const protocol::Script& script) {
    if (holds) return;
    std::cerr << fault << '\n' << protocol::to_text(script);
    std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 4) return 0;
    protocol::Choices choices(std::string_view(reinterpret_cast<const char*>(data), size));
    const bool again = choices.one_in(4);
    const auto& profile = choices.of(daemon::models()).profile;
    const int clients = choices.between(1, 3);
    const protocol::Script script = protocol::make_script(choices, profile, clients);
    const protocol::Outcome outcome = protocol::perform(script);
    require(outcome.fault.empty(), outcome.fault, script);
    if (!again) return 0;
    protocol::Choices cuts(std::uint64_t{size});
    const protocol::Outcome in_pieces = protocol::perform(protocol::in_fragments(script, cuts));
    require(in_pieces.told == outcome.told, "in pieces it is answered otherwise", script);
    return 0;
}
