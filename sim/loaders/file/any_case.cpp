// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/file/any_case.h"

#include <algorithm>
#include <system_error>
#include <vector>

#include "sim/loaders/file/allowed_folder.h"
#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

/// A folder is listed in no fixed order: of several matches, the smallest is always the same.
fs::path alike(const fs::path& folder, const fs::path& name) {
    std::vector<fs::path> found;
    std::error_code error;
    for (fs::directory_iterator at{folder, error}, end; !error && at != end; at.increment(error)) {
        if (lower(at->path().filename().native()) == lower(name.native())) {
            found.push_back(at->path());
        }
    }
    return found.empty() ? fs::path{} : *std::ranges::min_element(found);
}

/// Where not all may be read, without `..`: whether there is what they lead back from is nobody's
/// business.
fs::path to_look_for(const fs::path& path) {
    return folders_to_read() == nullptr ? path : fs::absolute(path).lexically_normal();
}

}  // namespace

std::string lower(std::string_view text) {
    std::string result{text};
    std::ranges::transform(result, result.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return result;
}

fs::path exactly(const fs::path& folder, const fs::path& name) {
    std::error_code error;
    fs::path whole = to_look_for(folder / name);
    return !whole.empty() && fs::exists(whole, error) && check_allowed(whole) ? whole : fs::path{};
}

fs::path in_any_case(const fs::path& folder, const fs::path& name) {
    const fs::path wanted = folders_to_read() == nullptr ? name : to_look_for(folder / name);
    fs::path at = wanted.is_absolute() ? wanted.root_path() : folder;
    for (const auto& part : wanted.relative_path()) {
        if (part.empty()) continue;  // after a trailing slash
        std::error_code error;
        fs::path next = fs::exists(at / part, error) ? at / part : alike(at, part);
        if (next.empty()) return {};
        at = std::move(next);
    }
    return check_allowed(at) ? at : fs::path{};
}

fs::path as_it_is_called(const fs::path& file, std::vector<std::string>& warnings) {
    const fs::path wanted = fs::absolute(file).lexically_normal();
    fs::path found = in_any_case(wanted.root_path(), wanted.relative_path());
    if (found.empty() || !differs_in_case(found, wanted.relative_path())) return file;
    warnings.push_back(file.string() + ": is called " + shown(found.string()) +
                       " here; it is used, though the names differ in case");
    return found;
}

bool differs_in_case(const fs::path& found, const fs::path& name) {
    const std::string has = found.lexically_normal().native();
    const std::string wants = name.lexically_normal().native();
    return !has.ends_with(wants) && lower(has).ends_with(lower(wants));
}

}  // namespace scipd::sim
