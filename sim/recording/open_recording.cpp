// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/open_recording.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "sim/recording/compression/compression.h"
#include "sim/recording/mcap/mcap.h"
#include "sim/recording/npy/npy.h"
#include "sim/recording/pcap/pcap.h"
#include "sim/recording/recording_files.h"
#include "sim/recording/ros/bags.h"
#include "sim/recording/text/text_formats.h"
#include "sim/recording/text/text_recording.h"
#include "sim/text/text_number.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

/// Bytes that tell the format.
constexpr std::size_t enough = 4096;

using Open = Expected<std::unique_ptr<Recording>> (*)(InputFile);

struct Magic {
    std::string_view bytes;
    Open open;
};
constexpr std::array magics = {
    Magic{{"\x89MCAP", 5}, open_mcap},         Magic{{"#ROS", 4}, open_bag},
    Magic{{"SQLite format 3", 16}, open_db3},  Magic{{"\x93NUMPY", 6}, open_npy},
    Magic{{"\xA1\xB2\xC3\xD4", 4}, open_pcap}, Magic{{"\xD4\xC3\xB2\xA1", 4}, open_pcap},
    Magic{{"\xA1\xB2\x3C\x4D", 4}, open_pcap}, Magic{{"\x4D\x3C\xB2\xA1", 4}, open_pcap},
    Magic{{"\x0A\x0D\x0D\x0A", 4}, open_pcap},
};

/// Files that must be unpacked first.
struct Packed {
    std::string_view bytes;
    const char* what_to_do;
};
constexpr std::array packed_files = {
    Packed{{"\x1F\x8B", 2}, "is packed by gzip; unpack it: gunzip FILE"},
    Packed{{"BZh", 3}, "is packed by bzip2; unpack it: bunzip2 FILE"},
    Packed{{"\xFD\x37zXZ", 5}, "is packed by xz; unpack it: unxz FILE"},
    Packed{{"PK\x03\x04", 4}, "is a zip, as .npz are; unpack it and name a .npy in it"},
};

/// The reader for a text that has this line at or near its beginning.
std::optional<Open> reader_for(std::string_view line) {
    if (line.starts_with("## Player")) return open_player;
    if (is_carmen_line(line)) return open_carmen;
    if (line.starts_with("# host_time_s") || line.find(", recorded by ") != line.npos)
        return open_csv;
    if (line.starts_with("[") && line.ends_with("]") && line.find('{') == line.npos)
        return open_ubh;
    if (line.starts_with("{")) return open_json_lines;
    if (is_row_of_numbers(line) || is_row_of_titles(line)) return open_table;
    return std::nullopt;
}

std::optional<Open> reader_for_ending(std::filesystem::path path) {
    if (path.extension() == ".zst" || path.extension() == ".zstd") path = path.stem();
    const std::filesystem::path ending = path.extension();
    if (ending == ".csv") return open_csv;
    if (ending == ".jsonl" || ending == ".ndjson") return open_json_lines;
    if (ending == ".ubh") return open_ubh;
    return std::nullopt;
}

std::optional<Open> reader_for_text(std::string_view beginning) {
    beginning = behind_byte_order_mark(beginning);
    while (!beginning.empty()) {
        const std::string_view line = take_until(beginning, "\n");
        if (const auto reader = reader_for(trimmed(line))) return reader;
        if (trimmed(line).empty() || line.starts_with('#')) continue;
        // Other lines have no title that is known; rows may be below them nevertheless.
        const std::string_view next = beginning.substr(0, beginning.find('\n'));
        return is_row_of_numbers(next) ? std::optional<Open>(open_table) : std::nullopt;
    }
    return std::nullopt;
}

Expected<std::unique_ptr<Recording>> open_plain(InputFile file, const std::string& beginning) {
    if (beginning.empty()) return file.refuse("is empty: it holds no scan");
    for (const Magic& magic : magics) {
        if (beginning.starts_with(magic.bytes)) return magic.open(std::move(file));
    }
    for (const Packed& packed : packed_files) {
        if (beginning.starts_with(packed.bytes)) return file.refuse(packed.what_to_do);
    }
    if (const auto open = reader_for_text(beginning)) return (*open)(std::move(file));
    if (const auto open = reader_for_ending(file.name())) return (*open)(std::move(file));
    return file.refuse(
        "begins like no recording that is read: MCAP, a bag of ROS (.bag, .db3), UBH, CSV or JSON "
        "lines of scipcat, rows of numbers, a log of CARMEN or Player, a NumPy array (.npy), a "
        "capture of a network (.pcap, .pcapng)");
}

/// Deletes a file, which a reader may have open.
struct Deleted {
    fs::path path;
    explicit Deleted(fs::path file) : path(std::move(file)) {}
    ~Deleted() {
        std::error_code ignored;
        fs::remove(path, ignored);
    }
    Deleted(const Deleted&) = delete;
    Deleted& operator=(const Deleted&) = delete;
};

/// Unpacks a whole file, as rosbag2 packs them, into one without a name that others know. Scans are
/// packed to a tenth of their size at best.
Expected<std::unique_ptr<Recording>> open_packed(InputFile packed) {
    constexpr std::size_t piece = std::size_t{64} << 10;
    const std::uint64_t most = std::max<std::uint64_t>(largest_block, 100 * packed.size());
    std::string name = (fs::temp_directory_path() / "scipd-recording-XXXXXX").string();
    const int descriptor = mkstemp(name.data());
    const Deleted temporary(name);
    const std::string no_room = "cannot be unpacked to " + name + ": " + std::strerror(errno) +
                                "; TMPDIR names another folder for it";
    if (descriptor < 0) return packed.refuse(no_room);
    const std::unique_ptr<std::FILE, decltype(&std::fclose)> out(fdopen(descriptor, "wb"),
                                                                 &std::fclose);
    std::uint64_t read = 0;
    std::uint64_t made = 0;
    const auto next = [&] {
        auto bytes = packed.read(read, piece);
        read += bytes ? bytes->size() : 0;
        return bytes;
    };
    const auto write = [&](std::string_view bytes) -> Expected<> {
        made += bytes.size();
        if (made > most) return refuse("makes more than " + std::to_string(most) + " bytes");
        if (std::fwrite(bytes.data(), 1, bytes.size(), out.get()) < bytes.size())
            return refuse(no_room);
        return {};
    };
    if (const auto done = unpack_zstd(next, write); !done) return packed.refuse(done.error().why);
    if (std::fflush(out.get()) != 0) return packed.refuse(no_room);
    auto file = InputFile::open(temporary.path);
    if (!file) return tl::unexpected(file.error());
    file->call(packed.name());
    const auto beginning = file->read(0, enough);
    if (!beginning) return tl::unexpected(beginning.error());
    return open_plain(std::move(*file), *beginning);
}

Expected<std::unique_ptr<Recording>> open_file(const fs::path& path) {
    return InputFile::open(path).and_then(
        [](InputFile file) { return open_recording(std::move(file)); });
}

}  // namespace

Expected<std::unique_ptr<Recording>> open_recording(const fs::path& path) {
    return open_recording(std::span(&path, 1));
}

Expected<std::unique_ptr<Recording>> open_recording(std::span<const fs::path> paths) {
    return open_files(paths, open_file);
}

Expected<std::unique_ptr<Recording>> open_recording(InputFile file) {
    const auto beginning = file.read(0, enough);
    if (!beginning) return tl::unexpected(beginning.error());
    return beginning->starts_with("\x28\xB5\x2F\xFD") ? open_packed(std::move(file))
                                                      : open_plain(std::move(file), *beginning);
}

}  // namespace scipd::sim
