// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/merged_recording.h"

#include <algorithm>

#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

/// Files that stay open from the start. Of more, those are open whose time has come.
constexpr std::size_t most_open_files = 16;

bool differ(const std::string& a, const std::string& b) {
    return !a.empty() && !b.empty() && a != b;
}

}  // namespace

Expected<std::unique_ptr<Recording>> MergedRecording::open(const std::vector<RecordingFile>& files,
                                                           Open open_file) {
    std::unique_ptr<MergedRecording> merged(new MergedRecording(std::move(open_file)));
    std::optional<Fault> fault;
    for (const RecordingFile& file : files) {
        Part part{.file = file};
        const auto begun = file.missing.empty() ? merged->begin(part) : refuse(file.missing);
        if (!begun && file.named) return tl::unexpected(begun.error());
        if (!begun) {
            merged->warn(begun.error().why + "; it is left out");
            fault = fault.value_or(begun.error());
            continue;
        }
        merged->parts_.push_back(std::move(part));
        merged->enqueue(merged->parts_.size() - 1);
        if (merged->parts_.size() <= most_open_files) continue;
        merged->parts_.back().recording.reset();
        merged->parts_.back().head.reset();
    }
    if (merged->parts_.empty())
        return tl::unexpected(fault.value_or(Fault{{}, "name a recording"}));
    return merged;
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
    auto opened = open_(part.file.path);
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
    meet_streams(part);
    part.head = std::move(*item);
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
    for (std::size_t i = 0; i < theirs.size(); ++i) {
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

}  // namespace scipd::sim
