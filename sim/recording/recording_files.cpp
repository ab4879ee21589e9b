// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/recording_files.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include <yaml-cpp/yaml.h>

#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 4> endings{".mcap", ".db3", ".bag", ".active"};
constexpr const char* metadata_name = "metadata.yaml";
/// rosbag2 writes 300 bytes for each file.
constexpr std::uintmax_t largest_metadata = std::uintmax_t{4} << 20;

/// Files that stay open from the start. Of more, those are open whose time has come.
constexpr std::size_t most_open_files = 16;

struct RecordingFile {
    fs::path path;
    bool named = true;    ///< by the user; else a folder has it
    std::string missing;  ///< a sentence, where the folder should have it
};

std::string shown_path(const fs::path& path) {
    return printable(path.string(), whole_path);
}

bool is_file(const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
}

bool is_bag(fs::path path) {
    if (path.extension() == ".zstd" || path.extension() == ".zst") path = path.stem();
    const std::string ending = path.extension().string();
    return std::ranges::find(endings, ending) != endings.end();
}

/// The names in the order of rosbag2, without folders: old versions begin with that of the bag.
/// Empty where a recorder was killed and left none.
std::vector<fs::path> names_by_metadata(const fs::path& metadata) {
    std::vector<fs::path> names;
    std::error_code error;
    if (!is_file(metadata) || fs::file_size(metadata, error) > largest_metadata) return names;
    try {
        const YAML::Node document = YAML::LoadFile(metadata.string());
        const YAML::Node about = document["rosbag2_bagfile_information"];
        for (const YAML::Node& name : about["relative_file_paths"])
            names.push_back(fs::path(name.as<std::string>()).filename());
    } catch (const YAML::Exception&) {
        names.clear();
    }
    return names;
}

/// The file, or as it is named once it has been packed.
RecordingFile file_in(const fs::path& folder, const fs::path& name) {
    for (const char* const packed : {"", ".zstd", ".zst"}) {
        const fs::path path = (folder / name).string() + packed;
        if (is_file(path)) return {path, false, {}};
    }
    return {
        folder / name, false,
        shown_path(folder / name) + ": there is no such file, but " + metadata_name + " names it"};
}

Expected<std::vector<RecordingFile>> files_in(const fs::path& folder) {
    std::vector<fs::path> names = names_by_metadata(folder / metadata_name);
    if (names.empty()) {
        std::error_code error;
        for (fs::directory_iterator entry(folder, error), end; !error && entry != end;) {
            if (is_bag(entry->path())) names.push_back(entry->path().filename());
            entry.increment(error);
        }
        if (error) return refuse(shown_path(folder) + ": cannot be read: " + error.message());
        std::ranges::sort(names);
    }
    if (names.empty())
        return refuse(shown_path(folder) +
                      ": is a folder without a bag (.mcap, .db3, .bag); name a recording");
    std::vector<RecordingFile> files;
    for (const fs::path& name : names)
        files.push_back(file_in(folder, name));
    return files;
}

Expected<std::vector<RecordingFile>> files_of(std::span<const fs::path> paths) {
    std::vector<RecordingFile> files;
    std::set<fs::path> named;
    for (const fs::path& path : paths) {
        std::error_code ignored;
        if (!named.insert(fs::weakly_canonical(path, ignored)).second) continue;
        if (!fs::is_directory(path, ignored)) {
            files.push_back({path, true, {}});
            continue;
        }
        auto inside = files_in(path);
        if (!inside) return tl::unexpected(inside.error());
        files.insert(files.end(), inside->begin(), inside->end());
    }
    return files;
}

bool differ(const std::string& a, const std::string& b) {
    return !a.empty() && !b.empty() && a != b;
}

class MergedRecording final : public Recording {
  public:
    explicit MergedRecording(OpenFile open_file)
        : Recording(""), open_file_(std::move(open_file)) {}

    /// Opens each file once for its streams and its first time.
    Expected<> open(const std::vector<RecordingFile>& files);
    void skip_ahead(std::chrono::nanoseconds since_first) override;

  private:
    struct Part {
        RecordingFile file;
        std::unique_ptr<Recording> recording;  ///< null before and after its time
        std::optional<RecordedItem> head;      ///< the next item
        std::optional<HostTime> begin;
        std::vector<std::size_t> streams;  ///< index here for each of the part's own
    };

    Next do_next() override;
    /// Opens a part and reads its first item.
    Expected<> begin(Part& part);
    Expected<> read_head(Part& part);
    void enqueue(std::size_t index);
    void skip(Part& part) const;
    void meet_streams(Part& part);
    std::size_t stream_for(const RecordedStream& stream, const Part& part);

    OpenFile open_file_;
    std::vector<Part> parts_;
    std::set<std::pair<HostTime, std::size_t>> queue_;  ///< time of the next item, index of part
    std::multimap<std::string, std::size_t> streams_by_name_;  ///< as the parts call them
    std::set<std::string> told_;  ///< warnings, without the file's name
    std::optional<std::chrono::nanoseconds> skip_;
};

Expected<> MergedRecording::open(const std::vector<RecordingFile>& files) {
    std::optional<Fault> fault;
    for (const RecordingFile& file : files) {
        Part part{.file = file};
        const auto begun = file.missing.empty() ? begin(part) : refuse(file.missing);
        if (!begun && file.named) return begun;
        if (!begun) {
            lose(tl::unexpected(begun.error()));
            fault = fault.value_or(begun.error());
            continue;
        }
        parts_.push_back(std::move(part));
        enqueue(parts_.size() - 1);
        if (parts_.size() <= most_open_files) continue;
        parts_.back().recording.reset();
        parts_.back().head.reset();
    }
    if (parts_.empty()) return tl::unexpected(fault.value_or(Fault{{}, "name a recording"}));
    return {};
}

void MergedRecording::skip_ahead(std::chrono::nanoseconds since_first) {
    skip_ = since_first;
    for (Part& part : parts_)
        skip(part);
}

void MergedRecording::skip(Part& part) const {
    if (!skip_ || !part.recording || !part.begin) return;
    const auto first = std::ranges::min_element(parts_, {}, &Part::begin)->begin;
    const auto rest = first ? *skip_ - (*part.begin - *first) : std::chrono::nanoseconds{};
    if (rest > std::chrono::nanoseconds{}) part.recording->skip_ahead(rest);
}

Recording::Next MergedRecording::do_next() {
    if (queue_.empty()) return std::nullopt;
    const std::size_t index = queue_.begin()->second;
    queue_.erase(queue_.begin());
    Part& part = parts_[index];
    if (!part.recording) {
        if (const auto begun = begin(part); !begun) return tl::unexpected(begun.error());
        skip(part);
    }
    std::optional<RecordedItem> item = std::exchange(part.head, std::nullopt);
    if (const auto read = read_head(part); !read) return tl::unexpected(read.error());
    enqueue(index);
    return item;
}

Expected<> MergedRecording::begin(Part& part) {
    auto opened = open_file_(part.file.path);
    if (!opened) return tl::unexpected(opened.error());
    part.recording = std::move(*opened);
    add_format(part.recording->format());
    part.streams.clear();
    const auto read = read_head(part);
    if (part.head) part.begin = order_time(*part.head);
    return read;
}

Expected<> MergedRecording::read_head(Part& part) {
    auto item = part.recording->next();
    if (!item) return tl::unexpected(item.error());
    part.head = std::move(*item);
    meet_streams(part);
    if (part.head) part.head->stream = part.streams[part.head->stream];
    return {};
}

/// Parts without times come one after the other, before those with times.
void MergedRecording::enqueue(std::size_t index) {
    Part& part = parts_[index];
    if (part.head) {
        queue_.emplace(order_time(*part.head).value_or(HostTime::min()), index);
        return;
    }
    // Each part may say the same of its topics: once is enough.
    const std::string name = printable(part.file.path.string(), whole_path);
    for (const std::string& warning : part.recording->warnings()) {
        const bool of_content = warning.starts_with(name + ": left out");
        if (!of_content || told_.insert(warning.substr(name.size())).second) warn(warning);
    }
    part.recording.reset();
}

void MergedRecording::meet_streams(Part& part) {
    const auto& theirs = part.recording->streams();
    while (part.streams.size() < theirs.size())
        part.streams.push_back(stream_for(theirs[part.streams.size()], part));
    // The one that has come is known better by now, and at the end all are.
    const std::size_t first = part.head ? part.head->stream : 0;
    const std::size_t end = part.head ? first + 1 : theirs.size();
    for (std::size_t i = first; i < end; ++i) {
        RecordedStream& ours = stream(part.streams[i]);
        ours.has_scans = ours.has_scans || theirs[i].has_scans;
        ours.has_bytes = ours.has_bytes || theirs[i].has_bytes;
        if (ours.identity.model.empty()) ours.identity = theirs[i].identity;
    }
}

std::size_t MergedRecording::stream_for(const RecordedStream& theirs, const Part& part) {
    const auto [begin, end] = streams_by_name_.equal_range(theirs.name);
    for (auto known = begin; known != end; ++known) {
        const ScannerIdentity& identity = stream(known->second).identity;
        if (!differ(identity.model, theirs.identity.model) &&
            !differ(identity.serial, theirs.identity.serial))
            return known->second;
    }
    RecordedStream added = theirs;
    if (begin != end) added.name += " of " + printable(part.file.path.filename().string());
    return streams_by_name_.emplace(theirs.name, add_stream(std::move(added)))->second;
}

}  // namespace

Expected<std::unique_ptr<Recording>> open_files(std::span<const fs::path> paths,
                                                const OpenFile& open_file) {
    const auto files = files_of(paths);
    if (!files) return tl::unexpected(files.error());
    if (files->size() == 1 && files->front().missing.empty()) return open_file(files->front().path);
    auto merged = std::make_unique<MergedRecording>(open_file);
    if (const auto opened = merged->open(*files); !opened) return tl::unexpected(opened.error());
    return merged;
}

std::vector<fs::path> split_paths(std::string_view text) {
    std::error_code ignored;
    std::vector<fs::path> paths;
    std::size_t begin = 0;
    for (std::size_t plus = text.find('+');
         plus != text.npos && !fs::exists(text.substr(begin), ignored);
         plus = text.find('+', plus + 1)) {
        const std::string_view name = text.substr(begin, plus - begin);
        if (!fs::exists(name, ignored)) continue;
        paths.emplace_back(name);
        begin = plus + 1;
    }
    // Without a file before a plus sign, it is a name like any other.
    paths.emplace_back(text.substr(begin));
    return paths;
}

}  // namespace scipd::sim
