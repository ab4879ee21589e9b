// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/mesh/mesh_folder.h"

#include <algorithm>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include <assimp/DefaultIOStream.h>

#include "sim/loaders/file/plain_file.h"
#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

/// Assimp's own stream, over a file that is open already.
class Stream final : public Assimp::DefaultIOStream {
  public:
    Stream(File file, const std::string& name) : DefaultIOStream(file.release(), name) {}
};

Stream* stream_of(const std::string& contents) {
    File file = memory_file();
    std::fwrite(contents.data(), 1, contents.size(), file.get());
    std::rewind(file.get());
    // The stream asks for its size by this name.
    const std::string name = "/proc/self/fd/" + std::to_string(fileno(file.get()));
    return new Stream(std::move(file), name);
}

/// In the folder or below it. Below the root folder would be everything, so there nothing counts.
bool lies_in(const fs::path& file, const fs::path& folder) {
    if (file.parent_path() == folder) return true;
    const auto [end, ignored] =
        std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
    return folder.has_relative_path() && end == folder.end();
}

}  // namespace

MeshFolder::MeshFolder(const fs::path& mesh) : mesh_(mesh) {
    std::error_code error;
    folders_.push_back(fs::canonical(fs::absolute(mesh).parent_path(), error));
    folders_.push_back(fs::canonical(mesh, error).parent_path());
}

Expected<> MeshFolder::check(const fs::path& file) const {
    if (file == mesh_) return {};
    if (relieved_ && file.extension() == ".mtl") return refuse("is not wanted");
    // Resolves links and dots, also where the file is missing: nobody learns what lies elsewhere.
    std::error_code error;
    const fs::path real = fs::weakly_canonical(file, error);
    const bool inside = !error && std::ranges::any_of(folders_, [&](const fs::path& folder) {
        return lies_in(real, folder);
    });
    if (!inside) return refuse("does not lie in the folder of the mesh");
    if (!fs::exists(real, error)) return refuse("is not there");
    return check_plain_file(real);
}

bool MeshFolder::Exists(const char* file) const {
    return check(file).has_value();
}

Assimp::IOStream* MeshFolder::Open(const char* file, const char* mode) {
    std::string why;
    try {
        const auto allowed = mode[0] == 'r' ? check(file) : refuse("is only read");
        if (allowed && relieved_ && file == mesh_) return stream_of(*relieved_);
        if (allowed) return new Stream(open_file(file), file);
        why = allowed.error().why;
    } catch (const std::runtime_error& error) {
        why = error.what();
    }
    const fs::path name = fs::path{file}.lexically_relative(mesh_.parent_path());
    if (refusal_.empty()) refusal_ = "names " + quote(name.string(), whole_path) + ", which " + why;
    return nullptr;
}

}  // namespace scipd::sim
