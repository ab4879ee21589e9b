// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/sdf_documents.h"

#include <algorithm>
#include <cstdio>
#include <string_view>
#include <tuple>
#include <utility>

#include "sim/loaders/file/doing.h"
#include "sim/loaders/file/load_error.h"
#include "sim/loaders/file/mistaken_file.h"
#include "sim/loaders/file/plain_file.h"
#include "sim/loaders/file/xml_text.h"
#include "sim/loaders/resources/model_folder.h"
#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

/// The largest file, as a share of the memory limit: 64 MiB for a world's limit. Once parsed, a
/// file takes up to 40 times its size.
constexpr std::size_t parts_of_memory = 64;
constexpr std::size_t longest_quoted = 60;

std::string warning_of_version(const tinyxml2::XMLElement& root) {
    const char* text = root.Attribute("version");
    int major = 0;
    int minor = 0;
    if (text == nullptr) return "has no version; it is read as SDF 1.12";
    if (std::sscanf(text, "%d.%d", &major, &minor) != 2) {
        return "has a version that is not a number; it is read as SDF 1.12";
    }
    if (std::tuple{major, minor} <= std::tuple{1, 12}) return {};
    return "is of version " + std::to_string(major) + '.' + std::to_string(minor) +
           ", which is newer than any known here; it is read as SDF 1.12";
}

/// What is wrong at the line that the parser stopped at.
std::string why_broken(tinyxml2::XMLError error) {
    switch (error) {
        case tinyxml2::XML_ERROR_EMPTY_DOCUMENT:
            return "it is empty";
        case tinyxml2::XML_ERROR_MISMATCHED_ELEMENT:
            return "an element begins here and has no end, or the end of another one";
        case tinyxml2::XML_ERROR_PARSING_ATTRIBUTE:
            return "an attribute must be NAME='VALUE'";
        case tinyxml2::XML_ERROR_PARSING_ELEMENT:
            return "an element does not end with > or />";
        case tinyxml2::XML_ERROR_PARSING_COMMENT:
            return "a comment does not end with -->";
        case tinyxml2::XML_ERROR_PARSING_CDATA:
            return "a <![CDATA[ does not end with ]]>";
        case tinyxml2::XML_ERROR_PARSING_TEXT:
            return "a text has no end";
        case tinyxml2::XML_ERROR_PARSING_DECLARATION:
            return "a declaration does not end with ?>, or stands in the middle";
        case tinyxml2::XML_ERROR_PARSING_UNKNOWN:
            return "a <! does not end with >";
        case tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED:
            return "its elements lie in each other too deep";
        default:
            return "something is wrong here";
    }
}

std::string broken_xml(const tinyxml2::XMLDocument& parsed) {
    const int line = std::max(parsed.ErrorLineNum(), 1);
    return ':' + std::to_string(line) +
           ": is no XML that can be read: " + why_broken(parsed.ErrorID());
}

/// What kind of text this is; empty if unknown.
std::string known_kind(std::string_view text) {
    if (auto why = why_mistaken(text, "SDF"); !why.empty()) return why;
    if (text.empty() || text.front() == '<') return {};
    return "is no SDF; it begins with '" +
           printable(text.substr(0, text.find_first_of("\r\n")), longest_quoted) +
           "', and an SDF file begins with <sdf>";
}

/// For a text and the result of its Parse(): ":LINE: is ...", which says what it is instead. Empty
/// if it is SDF or URDF.
std::string why_no_sdf(const std::string& text, const tinyxml2::XMLDocument& parsed) {
    const auto* root = parsed.Error() ? nullptr : parsed.RootElement();
    const std::string_view name = root == nullptr ? "" : root->Name();
    // Up to SDF 1.2, <sdf> was called <gazebo>.
    if (name == "sdf" || name == "robot" || name == "gazebo") return {};
    const std::string kind = known_kind(without_blank_start(text));
    if (!kind.empty()) return ":1: " + kind;
    if (parsed.Error()) return broken_xml(parsed);
    if (root == nullptr) return ":1: is no SDF: holds no element";
    return ':' + std::to_string(root->GetLineNum()) + ": is no SDF: its root is <" +
           printable(name, longest_quoted) + ">, not <sdf>";
}

}  // namespace

std::uintmax_t SdfDocuments::largest_file_bytes() const {
    return options_.most_memory_bytes / parts_of_memory;
}

SdfDocument& SdfDocuments::add(const fs::path& file, const fs::path& folder,
                               const std::string& text) {
    auto document = std::make_unique<SdfDocument>();
    std::string bare = in_utf8(text);
    blank_comments(bare);
    document->xml.Parse(bare.c_str(), bare.size());
    if (const auto why = why_no_sdf(text, document->xml); !why.empty()) {
        throw LoadError({file.string() + why});
    }
    const bool is_robot = document->is_robot();
    document->sheet = {std::make_shared<const fs::path>(file), folder,
                       is_robot ? Dialect{} : dialect_of(document->root())};
    const auto warning = is_robot ? "" : warning_of_version(document->root());
    if (!warning.empty()) {
        draft_.warn(text_of(document->sheet.place(document->root())) + ": " + warning);
    }
    return *documents_.emplace_back(std::move(document));
}

const SdfDocument& SdfDocuments::open(const SdfSource& source) {
    return source.text ? add(source.file, resources_.folder(), *source.text)
                       : open_file(source.file);
}

SdfDocument& SdfDocuments::open_file(const fs::path& file) {
    now_doing("reading " + file.string());
    return add(file, file.parent_path(),
               read_text(file, largest_file_bytes(), "an SDF or URDF file is wanted here"));
}

const SdfDocument* SdfDocuments::included(const std::string& uri, const SdfSheet& sheet,
                                          const std::string& place) {
    const auto key = std::pair{uri, sheet.folder};
    if (const auto named = named_.find(key); named != named_.end()) return named->second;
    const auto* document = found(uri, sheet, place);
    // What is not there is told of at each place.
    if (document != nullptr) named_[key] = document;
    return document;
}

const SdfDocument* SdfDocuments::found(const std::string& uri, const SdfSheet& sheet,
                                       const std::string& place) {
    const fs::path found = resources_.find(uri, sheet.folder).lexically_normal();
    if (found.empty()) {
        leave_out_missing(uri, sheet.folder, place);
        return nullptr;
    }
    try {
        std::vector<std::string> notes{case_warning(uri, found)};
        const fs::path model = model_file_of(found, notes);
        const auto readable = check_model(found, model);
        for (const auto& note : notes) {
            if (!note.empty()) draft_.warn(place + note);
        }
        if (readable) return read(model, place);
        draft_.leave_out(place + quote(uri, whole_path) + ' ' + readable.error().why);
    } catch (const LoadError& error) {
        draft_.leave_out(place + error.what());
    }
    return nullptr;
}

const SdfDocument* SdfDocuments::read(const fs::path& file, const std::string& place) {
    if (const auto known = known_.find(file); known != known_.end()) return known->second;
    std::error_code error;
    if (fs::file_size(file, error) > largest_file_bytes() && !error) {
        draft_.leave_out(place + file.string() + ": is larger than " +
                         std::to_string(largest_file_bytes() >> 20U) + " MiB");
        return known_[file] = nullptr;
    }
    try {
        return known_[file] = &open({file});
    } catch (const LoadError& fault) {
        draft_.leave_out(fault.what());
        return known_[file] = nullptr;
    }
}

void SdfDocuments::leave_out_missing(const std::string& uri, const fs::path& folder,
                                     const std::string& place) {
    // A missing download is reported only once.
    const auto command = download_command(uri);
    if (!command.empty() && !told_.insert(command).second) return;
    draft_.leave_out(place + resources_.not_found(uri, folder));
}

SdfDocument& SdfDocuments::copy_of(const SdfDocument& document, const FilePlace& changed_at) {
    // It is parsed again, since a copy that tinyxml2 makes does not know its lines.
    SdfDocument& copy = open_file(*document.sheet.file);
    copy.sheet.changed_at = changed_at;
    return copy;
}

}  // namespace scipd::sim
