// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <cmath>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "sim/recording/json/scan_json.h"
#include "sim/recording/text/text_formats.h"
#include "sim/recording/text/text_recording.h"
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
        const RecordedStream stream = stream_in(object, *scan);
        return RecordedItem{stream_of(stream.name, stream), std::move(*scan)};
    }

    [[nodiscard]] bool is_whole(std::string_view line) const override { return Json::accept(line); }

    static RecordedStream stream_in(const Json& object, const RecordedScan& scan) {
        RecordedStream stream{.name = text_in(object, "model"), .type = "JSON lines"};
        stream.identity = {.model = stream.name,
                           .serial = text_in(object, "serial"),
                           .min_range_m = metres_in(object, "dmin_mm"),
                           .max_range_m = metres_in(object, "dmax_mm")};
        if (stream.name.empty()) stream.name = "scanner";
        if (!stream.identity.serial.empty()) stream.name += " " + stream.identity.serial;
        learn_turn(scan.directions, stream.identity);
        return stream;
    }
};

class JsonLinesWriter final : public TextRecordingWriter {
  public:
    using TextRecordingWriter::TextRecordingWriter;

  private:
    std::string text_of(const RecordedScan& scan) override {
        nlohmann::ordered_json object;
        if (scan.host_time) object["host_time_s"] = std::stod(seconds_text(*scan.host_time));
        object["model"] = identity().model;
        object["serial"] = identity().serial;
        add_mm(object, "dmin_mm", identity().min_range_m);
        add_mm(object, "dmax_mm", identity().max_range_m);
        add_scan(object, scan);
        return object.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
    }

    static void add_mm(nlohmann::ordered_json& object, const char* key,
                       const std::optional<double>& range_m) {
        if (range_m) object[key] = std::llround(*range_m * 1000.0);
    }
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
