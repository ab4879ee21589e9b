// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/file/mistaken_file.h"

#include <algorithm>

namespace scipd::sim {
namespace {

bool begins_with(std::string_view text, std::string_view beginning) {
    const auto lower = [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    };
    return std::ranges::equal(text.substr(0, beginning.size()), beginning, {}, lower);
}

}  // namespace

std::string_view without_blank_start(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
    return text;
}

std::string why_mistaken(std::string_view text, const std::string& wanted) {
    text = without_blank_start(text);
    if (begins_with(text, "<!doctype html") || begins_with(text, "<html")) {
        return "is a page of HTML, no " + wanted +
               "; download the file itself, not the page that shows it";
    }
    if (begins_with(text, "version https://git-lfs")) {
        return "is a pointer of Git LFS, no " + wanted +
               "; fetch the file itself with `git lfs pull`";
    }
    return {};
}

}  // namespace scipd::sim
