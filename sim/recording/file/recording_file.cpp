// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/file/recording_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

/// The reason why the path names no plain file; empty if it does.
std::string why_no_file(const fs::path& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (status.type() == fs::file_type::not_found) return "there is no such file";
    if (status.type() == fs::file_type::none) return "cannot be read: " + error.message();
    if (status.type() == fs::file_type::directory) return "is a folder";
    if (status.type() != fs::file_type::regular) return "is no plain file";
    return {};
}

}  // namespace

Expected<InputFile> InputFile::open(const fs::path& path) {
    InputFile opened;
    opened.name_ = printable(path.string(), whole_path);
    opened.path_ = path;
    if (const std::string why = why_no_file(path); !why.empty()) return opened.refuse(why);
    opened.file_.reset(std::fopen(path.c_str(), "rbe"));
    if (!opened.file_)
        return opened.refuse("cannot be opened: " + std::string(std::strerror(errno)));
    std::error_code error;
    opened.size_ = fs::file_size(path, error);
    if (error) return opened.refuse("cannot be read: " + error.message());
    return opened;
}

InputFile InputFile::of_bytes(std::string name, std::string bytes) {
    InputFile opened;
    opened.name_ = std::move(name);
    opened.size_ = bytes.size();
    opened.bytes_ = std::make_unique<std::string>(std::move(bytes));
    opened.file_.reset(fmemopen(opened.bytes_->data(), opened.bytes_->size(), "rb"));
    return opened;
}

Expected<std::string> InputFile::read(std::uint64_t offset, std::size_t count) {
    if (offset >= size_) return std::string{};
    count = std::min<std::uint64_t>(count, size_ - offset);
    if (offset >= window_begin_ && offset + count <= window_begin_ + window_.size())
        return window_.substr(offset - window_begin_, count);
    std::string bytes(std::max(count, window_bytes), '\0');
    const bool found = fseeko(file_.get(), static_cast<off_t>(offset), SEEK_SET) == 0;
    const std::size_t got = found ? std::fread(bytes.data(), 1, bytes.size(), file_.get()) : 0;
    // Somebody may have shortened it meanwhile, which is no error of reading.
    if (!found || std::ferror(file_.get()) != 0)
        return refuse_byte(offset, "cannot be read: " + std::string(std::strerror(errno)));
    bytes.resize(got);
    if (count >= window_bytes) return bytes;
    window_ = std::move(bytes);
    window_begin_ = offset;
    return window_.substr(0, count);
}

std::FILE* InputFile::release() {
    std::rewind(file_.get());
    return file_.release();
}

tl::unexpected<Fault> InputFile::refuse_byte(std::uint64_t byte, const std::string& why) const {
    return sim::refuse(name_ + ": byte " + std::to_string(byte) + ": " + why);
}

tl::unexpected<Fault> InputFile::refuse_line(std::size_t line, const std::string& why) const {
    return sim::refuse(name_ + ":" + std::to_string(line) + ": " + why);
}

tl::unexpected<Fault> InputFile::refuse(const std::string& why) const {
    return sim::refuse(name_ + ": " + why);
}

GrowingFile::GrowingFile(const std::filesystem::path& path)
    : path_(path), file_(path, std::ios::binary | std::ios::trunc) {
    check();
}

void GrowingFile::write(std::string_view bytes) {
    file_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    check();
    size_ += bytes.size();
}

void GrowingFile::flush() {
    file_.flush();
    check();
}

void GrowingFile::check() const {
    if (!file_)
        throw std::runtime_error("cannot write " + path_.string() + ": " + std::strerror(errno));
}

}  // namespace scipd::sim
