// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/safe_output.h"

#include "sim/text/quote.h"

namespace scipd::tools {

SafeOutput::SafeOutput(std::ostream& stream) : stream_(stream), out_(stream.rdbuf(this)) {}

SafeOutput::~SafeOutput() {
    stream_.flush();
    stream_.rdbuf(out_);
}

void SafeOutput::write_as_is(std::ostream& stream, std::string_view text) {
    auto* const filter = dynamic_cast<SafeOutput*>(stream.rdbuf());
    if (filter == nullptr) return void(stream << text);
    const auto length = static_cast<std::streamsize>(text.size());
    if (filter->sync() == -1 || filter->out_->sputn(text.data(), length) != length)
        stream.setstate(std::ios::badbit);
}

SafeOutput::int_type SafeOutput::overflow(int_type character) {
    if (traits_type::eq_int_type(character, traits_type::eof())) return 0;
    const char c = traits_type::to_char_type(character);
    return xsputn(&c, 1) == 1 ? character : traits_type::eof();
}

std::streamsize SafeOutput::xsputn(const char* text, std::streamsize size) {
    line_.append(text, static_cast<std::size_t>(size));
    const auto end = line_.rfind('\n');
    return end == line_.npos || pass_on(end + 1) ? size : 0;
}

int SafeOutput::sync() {
    return pass_on(line_.size()) ? out_->pubsync() : -1;
}

bool SafeOutput::pass_on(std::size_t size) {
    const std::string text = sim::shown(std::string_view(line_).substr(0, size));
    line_.erase(0, size);
    const auto length = static_cast<std::streamsize>(text.size());
    return out_->sputn(text.data(), length) == length;
}

}  // namespace scipd::tools
