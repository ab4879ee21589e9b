// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/sdf.h"

#include <exception>
#include <utility>

#include <sdf/Exception.hh>

#include "sim/loaders/file/doing.h"
#include "sim/loaders/file/load_error.h"
#include "sim/loaders/file/plain_file.h"
#include "sim/loaders/sdf/model_folder.h"
#include "sim/loaders/sdf/resources.h"
#include "sim/loaders/sdf/sdf_cost.h"
#include "sim/loaders/sdf/sdf_file.h"
#include "sim/loaders/sdf/sdf_scene.h"
#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

LoadError unreadable(const fs::path& file, const std::string& why) {
    constexpr std::size_t most_told = 400;
    return LoadError(
        {file.string() + ": libsdformat cannot read it: " + printable(why, most_told)});
}

/// Tells the user what a large world takes, before it grows too large.
std::vector<std::string> notes_of(const SdfSource& source, double bytes, std::size_t most_bytes) {
    const auto most = static_cast<double>(most_bytes);
    constexpr double large = 0.25;
    if (bytes <= large * most) return {};
    return {source.file.string() + ": takes about " + megabytes(bytes) + " to read, of " +
            megabytes(most) + " that are allowed (world_memory_mb under limits)"};
}

LoadedScene load(const SdfSource& source, const fs::path& folder, const SdfOptions& options) {
    const Resources resources{folder, options.model_folders};
    try {
        SdfSurvey survey = survey_sdf(source, resources, options);
        MeshShelf shelf{options.most_triangles, options.mesh};
        if (survey.faults.empty()) shelf.read_ahead(survey.meshes);
        auto notes = notes_of(source, survey.bytes, options.most_memory_bytes);
        now_doing("letting libsdformat read " + source.file.string());
        SdfFile read = read_sdf(std::move(survey), options);
        if (!read.faults.empty()) throw LoadError(std::move(read.faults));
        now_doing("putting together what " + source.file.string() + " shows");
        LoadedScene loaded = scene_of(std::move(read), source.file, resources, options, shelf);
        loaded.notes = std::move(notes);
        if (options.strict && !loaded.warnings.empty()) throw LoadError(loaded.warnings);
        return loaded;
    } catch (const LoadError&) {
        throw;
    } catch (const std::exception& error) {
        // The library lets some exceptions of its number conversion through.
        throw unreadable(source.file, error.what());
    } catch (const sdf::Exception& error) {
        // sdf::Exception does not derive from std::exception.
        throw unreadable(source.file, error.GetErrorStr());
    }
}

/// Where the first element of a document begins.
std::size_t first_element(std::string_view text) {
    for (std::size_t at = text.find('<'); at != text.npos; at = text.find('<', at + 1)) {
        if (text.substr(at).starts_with("<!--")) {
            at = text.find("-->", at);
            if (at == text.npos) break;
        } else if (!text.substr(at).starts_with("<?")) {
            return at;
        }
    }
    return text.size();
}

}  // namespace

LoadedScene load_sdf(const fs::path& given, const SdfOptions& options) {
    // The library makes paths absolute, so scipd does too: messages then name a file in one way
    // only.
    const auto named = fs::absolute(given).lexically_normal();
    std::vector<std::string> of_folder;
    const auto file = model_file_of(named, of_folder);
    for (std::string& warning : of_folder)
        warning = named.string() + ": " + warning;
    if (options.strict && !of_folder.empty()) throw LoadError(std::move(of_folder));
    if (file.empty()) {
        throw LoadError({named.string() +
                         ": is a folder without a model.config that names an SDF file; name a file "
                         "or the folder of a model"});
    }
    if (const auto plain = check_plain_file(file); !plain) {
        throw LoadError(
            {file.string() + ": " + plain.error().why + "; name an SDF world or model"});
    }
    LoadedScene loaded = load({file}, file.parent_path(), options);
    loaded.warnings.insert(loaded.warnings.begin(), of_folder.begin(), of_folder.end());
    return loaded;
}

LoadedScene load_sdf_text(const std::string& text, const std::string& name, const fs::path& folder,
                          const SdfOptions& options) {
    std::string document = text;
    if (const auto at = first_element(text);
        std::string_view{text}.substr(at).starts_with("<model")) {
        document = "<sdf version='1.9' xmlns:scipd='urn:scipd:sdf'>" + text.substr(at) + "</sdf>";
    }
    return load({name, document}, fs::absolute(folder).lexically_normal(), options);
}

}  // namespace scipd::sim
