// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The twin of a scanner hears whatever the driver says to the scanner, and answers to nobody: its
// scans are held against the scanner's. Where it is gone it is looked for again. One thread.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/steady_timer.hpp>

#include "daemon/recording/wire_decoder.h"
#include "protocol/line_reader.h"
#include "sim/recording/values/recorded_scan.h"
#include "tools/scipcat/proxy/far_end.h"
#include "tools/scipcat/proxy/twin_comparison.h"
#include "tools/target.h"

namespace scipd::tools {

class Twin {
  public:
    struct Hooks {
        std::function<void(const TwinChange& change)> changed;
        /// What a user wants to know of the twin itself.
        std::function<void(const std::string& sentence)> news;
    };

    Twin(const boost::asio::any_io_executor& executor, Target target, OpenOptions options,
         double tolerance_mm, Hooks hooks);
    Twin(const Twin&) = delete;
    Twin& operator=(const Twin&) = delete;
    ~Twin() { leave(); }

    /// A driver is there, or gone.
    void come();
    void leave();
    /// What has gone to the scanner, or come from it.
    void hear(bool to_scanner, sim::HostTime time, std::string_view bytes);
    [[nodiscard]] std::uint64_t compared() const { return compared_; }

  private:
    void tell_request(std::string_view bytes);
    void hear_twin(std::string_view bytes);
    void compare(const sim::RecordedScan& scan);
    void opened();
    void lost(const std::string& why);
    void news(const std::string& sentence);

    Target target_;
    OpenOptions options_;
    Hooks hooks_;
    boost::asio::steady_timer again_;
    std::shared_ptr<FarEnd> twin_;  ///< null: it is gone, or there is no driver
    bool driven_ = false;
    daemon::WireDecoder scanner_says_;
    daemon::WireDecoder twin_says_;
    std::optional<sim::RecordedScan> latest_;  ///< of the twin
    TwinComparison comparison_;
    std::uint64_t compared_ = 0;
    protocol::LineReader requests_;
    std::string stream_;  ///< the request for the stream that runs; empty: none
    std::string told_;    ///< the latest news
};

}  // namespace scipd::tools
