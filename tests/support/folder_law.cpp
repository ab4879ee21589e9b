// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tests/support/folder_law.h"

#include <algorithm>

namespace scipd::testing {
namespace {

constexpr std::string_view may_include_words = "May include:";
constexpr std::string_view never_reaches_words = "Never reaches:";
constexpr std::string_view alone_words = " alone may also include ";

/// The names between backticks.
Names quoted_in(std::string_view text) {
    Names names;
    for (;;) {
        const std::size_t begin = text.find('`');
        const std::size_t end = text.find('`', begin + 1);
        if (begin == text.npos || end == text.npos) return names;
        names.emplace_back(text.substr(begin + 1, end - begin - 1));
        text.remove_prefix(end + 1);
    }
}

/// The items and paragraphs before the first section, each joined into one line.
Names items_in(std::string_view readme) {
    Names items{""};
    while (!readme.empty() && !readme.starts_with("## ")) {
        std::string_view line = readme.substr(0, readme.find('\n'));
        readme.remove_prefix(std::min(line.size() + 1, readme.size()));
        if (line.empty() || line.starts_with("- ")) items.emplace_back();
        if (line.starts_with("- ")) line.remove_prefix(2);
        items.back().append(items.back().empty() ? "" : " ").append(line);
    }
    return items;
}

bool is_standard(std::string_view included) {
    return included.find_first_of("./") == included.npos;
}

}  // namespace

std::optional<FolderLaw> law_in(std::string_view readme) {
    FolderLaw law;
    bool says_what = false;
    for (const std::string& item : items_in(readme)) {
        if (item.starts_with(may_include_words)) {
            says_what = true;
            law.may_include = quoted_in(item);
        } else if (item.starts_with(never_reaches_words)) {
            law.never_reaches = quoted_in(item);
        } else if (const auto at = item.find(alone_words); at != item.npos) {
            // The reason follows the colon.
            law.exemptions.push_back(
                {quoted_in(std::string_view{item}.substr(0, at)),
                 quoted_in(std::string_view{item}.substr(at).substr(0, item.find(": ", at) - at))});
        }
    }
    if (!says_what) return std::nullopt;
    return law;
}

std::string_view folder_of(std::string_view file) {
    return file.substr(0, file.rfind('/') + 1);
}

bool is_among(std::string_view file, const Names& names) {
    return std::ranges::any_of(names, [&](std::string_view name) {
        if (name.ends_with("/*")) return folder_of(file) == name.substr(0, name.size() - 1);
        return name.ends_with('/') ? file.starts_with(name) : file == name;
    });
}

bool may_include(const FolderLaw& law, std::string_view file, std::string_view included) {
    if (is_standard(included) || folder_of(included) == folder_of(file)) return true;
    if (is_among(included, law.may_include)) return true;
    const std::string name{file.substr(folder_of(file).size())};
    return std::ranges::any_of(law.exemptions, [&](const Exemption& exemption) {
        return is_among(name, exemption.files) && is_among(included, exemption.may_include);
    });
}

}  // namespace scipd::testing
