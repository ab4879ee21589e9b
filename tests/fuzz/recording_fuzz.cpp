// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Any bytes as a recording, of the format that they look like: the items are sound scans or bytes
// of a stream that is there, what is wrong or left out can be shown, and there is an end.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>
#include <variant>

#include "daemon/recording/decoded_recording.h"
#include "sim/recording/open_recording.h"
#include "sim/text/quote.h"

namespace {

using namespace scipd::sim;

void require(bool holds) {
    if (!holds) std::abort();
}

void check(std::string_view sentence) {
    require(!sentence.empty() && sentence.size() < 4000);
    require(scipd::sim::printable(sentence, sentence.size()) == sentence);
}

void check(const RecordedScan& scan) {
    require(scan.intensities.empty() || scan.intensities.size() == scan.ranges.size());
    require(scan.directions.cluster >= 1);
    std::size_t values = 0;
    for (std::size_t step = 0; step < scan.steps(); ++step) {
        values += scan.ranges_of(step).size();
        require(scan.intensities.empty() ||
                scan.intensities_of(step).size() == scan.ranges_of(step).size());
    }
    require(values == scan.ranges.size());
}

/// Reads all of it; returns how many items there were.
std::size_t check(Recording& recording) {
    std::size_t count = 0;
    for (;; ++count) {
        const auto item = recording.next();
        if (!item) check(item.error().why);
        if (!item || !*item) break;
        require((*item)->stream < recording.streams().size());
        const auto* const scan = std::get_if<RecordedScan>(&(*item)->what);
        if (scan != nullptr) check(*scan);
    }
    for (const std::string& warning : recording.warnings())
        check(warning);
    const auto end = recording.next();
    require(end && !*end);
    return count;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string bytes(reinterpret_cast<const char*>(data), size);
    auto plain = open_recording(InputFile::of_bytes("FILE", bytes));
    if (!plain) {
        require(plain.error().why.starts_with("FILE"));
        check(plain.error().why);
        return 0;
    }
    (void)check(**plain);
    auto again = open_recording(InputFile::of_bytes("FILE", bytes));
    (void)check(*scipd::daemon::scans_of(std::move(*again)));
    return 0;
}
