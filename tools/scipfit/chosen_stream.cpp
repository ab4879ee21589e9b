// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/chosen_stream.h"

#include <iostream>
#include <optional>
#include <variant>

#include "tools/options.h"
#include "tools/safe_output.h"
#include "tools/terminal.h"

namespace scipd::tools {
namespace {

class Progress {
  public:
    void tell(std::size_t scans) {
        constexpr std::size_t often = 500;
        if (!on_terminal_ || scans % often != 0) return;
        shown_ = true;
        SafeOutput::write_as_is(std::cerr, "\r" + std::to_string(scans) + " scans read");
        std::cerr.flush();
    }
    ~Progress() {
        if (shown_) SafeOutput::write_as_is(std::cerr, "\r\x1b[K");
    }
    Progress() = default;
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

  private:
    bool on_terminal_ = stderr_is_terminal();
    bool shown_ = false;
};

bool wanted(const sim::Recording& recording, std::size_t index, const std::string& stream,
            std::optional<std::size_t>& chosen) {
    if (!chosen && (stream.empty() || recording.streams()[index].name == stream)) chosen = index;
    return chosen == index;
}

std::string names_of(const sim::Recording& recording) {
    std::string names;
    for (const sim::RecordedStream& stream : recording.streams())
        names += (names.empty() ? "" : ", ") + stream.name;
    return names;
}

}  // namespace

std::size_t for_each_scan(sim::Recording& recording, const std::string& name,
                          const std::string& stream, const TakeScan& take) {
    Progress progress;
    std::optional<std::size_t> chosen;
    for (std::size_t scans = 0;;) {
        const auto item = recording.next();
        if (!item) throw WrongInput(item.error().why);
        if (!*item) break;
        if (!wanted(recording, (*item)->stream, stream, chosen)) continue;
        take(std::get<sim::RecordedScan>((*item)->what), recording.streams()[*chosen]);
        progress.tell(++scans);
    }
    if (!chosen && !stream.empty())
        throw WrongInput(name + ": has no scans of \"" + stream +
                         "\"; there are: " + names_of(recording));
    if (!chosen) throw WrongInput(name + ": holds no scans");
    if (stream.empty() && recording.streams().size() > 1)
        std::cerr << name << ": has several scanners, " << names_of(recording)
                  << "; --stream names "
                  << "one, and the first is taken\n";
    return *chosen;
}

}  // namespace scipd::tools
