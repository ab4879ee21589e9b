// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/world/inline_mesh.h"

#include <cstdlib>
#include <fstream>
#include <system_error>

#include "daemon/world/base64.h"
#include "sim/loaders/file/load_error.h"

namespace scipd::daemon {
namespace {

namespace fs = std::filesystem;

/// One that only this user can open.
fs::path new_folder() {
    std::error_code error;
    std::string name = (fs::temp_directory_path(error) / "scipd-mesh-XXXXXX").string();
    if (error || ::mkdtemp(name.data()) == nullptr)
        throw sim::LoadError({"there is no folder to read the mesh in; TMPDIR can name one"});
    return fs::canonical(name);
}

}  // namespace

InlineMesh::InlineMesh(const std::string& data, const std::string& format) {
    const auto bytes = base64_decoded(data);
    if (!bytes) throw sim::LoadError({"mesh_data must be base64"});
    folder_ = new_folder();
    file_ = folder_ / ("mesh." + format);
    std::ofstream file(file_, std::ios::binary);
    file.write(bytes->data(), static_cast<std::streamsize>(bytes->size()));
}

InlineMesh::~InlineMesh() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
}

}  // namespace scipd::daemon
