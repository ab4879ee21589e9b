// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/file/xml_text.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "sim/loaders/file/mistaken_file.h"

namespace scipd::sim {
namespace {

struct Mark {
    std::string_view begins;
    std::string_view ends;
    bool is_text;
};

constexpr std::array<Mark, 3> marks{
    {{"<!--", "-->", false}, {"<?", "?>", false}, {"<![CDATA[", "]]>", true}}};

}  // namespace

bool blank_comments(std::string& text) {
    bool any = false;
    const auto declaration = text.size() - without_blank_start(text).size();
    for (auto at = text.find('<'); at != text.npos; at = text.find('<', at)) {
        const auto rest = std::string_view{text}.substr(at);
        const auto mark = std::ranges::find_if(
            marks, [&](const Mark& known) { return rest.starts_with(known.begins); });
        if (mark == marks.end()) {
            ++at;
            continue;
        }
        const auto last = text.find(mark->ends, at + mark->begins.size());
        if (last == text.npos) break;  // who parses the text tells of it
        const auto end = last + mark->ends.size();
        const bool is_kept = mark->is_text || (at == declaration && rest.starts_with("<?"));
        if (!is_kept) {
            any = true;
            std::replace_if(
                text.begin() + static_cast<std::ptrdiff_t>(at),
                text.begin() + static_cast<std::ptrdiff_t>(end), [](char c) { return c != '\n'; },
                ' ');
        }
        at = end;
    }
    return any;
}

}  // namespace scipd::sim
