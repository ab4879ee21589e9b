// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/recording/decoded_recording.h"

#include <chrono>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "daemon/recording/wire_decoder.h"
#include "sim/recording/open_recording.h"
#include "sim/text/quote.h"

namespace scipd::daemon {
namespace {

using sim::RecordedBytes;
using sim::RecordedItem;
using sim::RecordedScan;

class DecodedRecording final : public sim::Recording {
  public:
    explicit DecodedRecording(std::unique_ptr<sim::Recording> inner)
        : Recording(inner->format()), inner_(std::move(inner)) {
        meet_streams();
    }

    void skip_ahead(std::chrono::nanoseconds since_first) override {
        inner_->skip_ahead(since_first);
    }

  private:
    Next do_next() override {
        while (ready_.empty()) {
            auto item = inner_->next();
            if (!item) return item;
            if (!*item) return end();
            if (inner_->streams().size() > met_) meet_streams();
            take(std::move(**item));
        }
        RecordedItem item = std::move(ready_.front());
        ready_.pop_front();
        check_time(item);
        return item;
    }

    /// Takes over the streams of scans; the others once they turn out to be SCIP.
    void meet_streams() {
        met_ = inner_->streams().size();
        for (const auto& stream : inner_->streams()) {
            const auto index = static_cast<std::size_t>(&stream - inner_->streams().data());
            if (stream.has_scans) outer_index(index);
        }
    }

    std::size_t outer_index(std::size_t inner) {
        const auto [found, is_new] = outer_.try_emplace(inner, streams().size());
        if (is_new) add_stream(inner_->streams()[inner]);
        return found->second;
    }

    void take(RecordedItem item) {
        if (auto* const scan = std::get_if<RecordedScan>(&item.what)) {
            const std::size_t outer = outer_index(item.stream);
            stream(outer) = inner_->streams()[item.stream];  // which may be better known by now
            ready_.push_back(
                {outer, sim::counter_clockwise(std::move(*scan)), item.logged, item.stamped});
            return;
        }
        // Where scans are beside the bytes, they are the same.
        if (inner_->streams()[item.stream].has_scans) return;
        WireDecoder& decoder = decoders_[item.stream];
        auto scans = decoder.take(std::get<RecordedBytes>(item.what));
        if (decoder.sound_messages() == 0) return;
        const std::size_t outer = outer_index(item.stream);
        stream(outer).identity = decoder.identity();
        for (RecordedScan& scan : scans)
            ready_.push_back({outer, std::move(scan)});
    }

    void check_time(const RecordedItem& item) {
        const auto time = std::get<RecordedScan>(item.what).host_time;
        Times& times = times_[item.stream];
        ++times.scans;
        if (time && times.last && *time < *times.last && ++times.back == 1)
            times.first_back = times.scans;
        if (time) times.last = time;
    }

    Next end() {
        meet_streams();
        for (const auto& [index, times] : times_) {
            if (times.back == 0) continue;
            warn(sim::printable(streams()[index].name) + ": the times of its scans go back " +
                 std::to_string(times.back) + " times, first at scan " +
                 std::to_string(times.first_back));
        }
        for (const auto& [inner, decoder] : decoders_) {
            if (decoder.sound_messages() == 0 || decoder.damaged_scans() == 0) continue;
            warn(sim::printable(inner_->streams()[inner].name) + ": " +
                 std::to_string(decoder.damaged_scans()) + " scans are damaged and left out");
        }
        for (const std::string& warning : inner_->warnings())
            warn(warning);
        return std::nullopt;
    }

    /// The times of a stream so far.
    struct Times {
        std::optional<sim::HostTime> last;
        std::size_t scans = 0;
        std::size_t back = 0;        ///< times that are earlier than the one before
        std::size_t first_back = 0;  ///< number of the first such scan, from 1
    };

    std::unique_ptr<sim::Recording> inner_;
    std::size_t met_ = 0;  ///< of its streams
    std::map<std::size_t, Times> times_;
    std::map<std::size_t, std::size_t> outer_;  ///< by the index of the inner stream
    std::map<std::size_t, WireDecoder> decoders_;
    std::deque<RecordedItem> ready_;
};

}  // namespace

sim::Expected<std::unique_ptr<sim::Recording>> open_scans(
    const std::vector<std::filesystem::path>& paths) {
    return sim::open_recording(paths).map(scans_of);
}

std::unique_ptr<sim::Recording> scans_of(std::unique_ptr<sim::Recording> recording) {
    return std::make_unique<DecodedRecording>(std::move(recording));
}

}  // namespace scipd::daemon
