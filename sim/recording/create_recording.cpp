// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/create_recording.h"

#include <stdexcept>

#include "sim/recording/mcap/mcap.h"
#include "sim/recording/text/text_formats.h"

namespace scipd::sim {

std::unique_ptr<RecordingWriter> create_recording(const std::filesystem::path& path,
                                                  const ScannerIdentity& identity,
                                                  const Recorder& recorder) {
    return create_recording(path, path.extension().string(), identity, recorder);
}

std::unique_ptr<RecordingWriter> create_recording(const std::filesystem::path& path,
                                                  std::string_view ending,
                                                  const ScannerIdentity& identity,
                                                  const Recorder& recorder) {
    const std::string who = recorder.name + " " + recorder.version;
    if (ending == ".csv") return create_csv(path, identity, recorder.name);
    if (ending == ".jsonl") return create_json_lines(path, identity);
    if (ending == ".ubh") return create_ubh(path, identity, who);
    if (ending == ".mcap") {
        return create_mcap(path, identity, {.library = who, .compression = recorder.compression});
    }
    throw std::invalid_argument("\"" + path.string() +
                                "\" ends in none of .mcap, .ubh, .csv and "
                                ".jsonl");
}

}  // namespace scipd::sim
