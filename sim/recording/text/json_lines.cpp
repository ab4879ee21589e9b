// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/text/json_lines.h"

#include <cmath>
#include <map>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "sim/recording/file/growing_file.h"
#include "sim/recording/json/scan_json.h"
#include "sim/recording/text/text_recording.h"
#include "sim/recording/text/text_values.h"
#include "sim/text/text_number.h"

namespace scipd::sim {
namespace {

using Json = nlohmann::json;

/// A text member; empty if there is none.
std::string text_in(const Json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : std::string{};
}

std::optional<double> metres_in(const Json& object, const char* key_mm) {
    const auto found = object.find(key_mm);
    if (found == object.end() || !found->is_number()) return std::nullopt;
    return found->get<double>() / 1000.0;
}

class JsonLines final : public TextRecording {
  public:
    explicit JsonLines(InputFile file) : TextRecording("jsonl", std::move(file)) {}

  private:
    Next take(std::string_view line) override {
        if (trimmed(line).empty()) return std::nullopt;
        const Json object = Json::parse(line, nullptr, false);
        if (object.is_discarded()) return refuse("must be a JSON object, one a line");
        auto scan = scan_in(object);
        if (!scan) return tl::unexpected(scan.error());
        const auto seconds = object.find("host_time_s");
        if (seconds != object.end() && seconds->is_number())
            scan->host_time = host_time_of(seconds->get<double>());
        const std::size_t stream = stream_of(object, *scan);
        return RecordedItem{stream, std::move(*scan)};
    }

    [[nodiscard]] bool is_whole(std::string_view line) const override { return Json::accept(line); }

    std::size_t stream_of(const Json& object, const RecordedScan& scan) {
        const std::string model = text_in(object, "model");
        const std::string serial = text_in(object, "serial");
        const auto [found, is_new] = streams_by_name_.try_emplace({model, serial}, 0);
        if (!is_new) return found->second;
        RecordedStream stream{.name = model.empty() ? "scanner" : model, .type = "JSON lines"};
        if (!serial.empty()) stream.name += " " + serial;
        stream.identity.model = model;
        stream.identity.serial = serial;
        stream.identity.min_range_m = metres_in(object, "dmin_mm");
        stream.identity.max_range_m = metres_in(object, "dmax_mm");
        learn_turn(scan.directions, stream.identity);
        return found->second = add_stream(std::move(stream));
    }

    std::map<std::pair<std::string, std::string>, std::size_t> streams_by_name_;
};

class JsonLinesWriter final : public RecordingWriter {
  public:
    JsonLinesWriter(const std::filesystem::path& path, ScannerIdentity identity)
        : file_(path), identity_(std::move(identity)) {}

    void write(const RecordedScan& scan) override {
        nlohmann::ordered_json object;
        if (scan.host_time) object["host_time_s"] = std::stod(seconds_text(*scan.host_time));
        object["model"] = identity_.model;
        object["serial"] = identity_.serial;
        add_mm(object, "dmin_mm", identity_.min_range_m);
        add_mm(object, "dmax_mm", identity_.max_range_m);
        add_scan(object, scan);
        file_.write(object.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
        file_.flush();
    }

  private:
    static void add_mm(nlohmann::ordered_json& object, const char* key,
                       const std::optional<double>& range_m) {
        if (range_m) object[key] = std::llround(*range_m * 1000.0);
    }

    GrowingFile file_;
    ScannerIdentity identity_;
};

}  // namespace

Expected<std::unique_ptr<Recording>> open_json_lines(InputFile file) {
    return std::make_unique<JsonLines>(std::move(file));
}

std::unique_ptr<RecordingWriter> create_json_lines(const std::filesystem::path& path,
                                                   ScannerIdentity identity) {
    return std::make_unique<JsonLinesWriter>(path, std::move(identity));
}

}  // namespace scipd::sim
