// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Has GDAL read an elevation model, in a child process: the library is large, and its input may
// come from anywhere. It is in a module (gdal_dem.h), which a build without GDAL does not have.
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include <dlfcn.h>
#include <glm/vec2.hpp>

#include "sim/loaders/file/allowed_folder.h"
#include "sim/loaders/file/between_processes.h"
#include "sim/loaders/file/confined.h"
#include "sim/loaders/file/load_error.h"
#include "sim/loaders/file/plain_file.h"
#include "sim/loaders/terrain/gdal_dem.h"
#include "sim/loaders/terrain/height_file.h"
#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

using ReadDem = decltype(&scipd_read_dem);

[[noreturn]] void refuse_without(const fs::path& file) {
    if (SCIPD_GDAL) {
        throw std::runtime_error("needs " + file.filename().string() +
                                 ", which comes with scipd-read and is not at " + file.string());
    }
    throw std::runtime_error(
        "is no picture, and this scipd was built without GDAL, which reads elevation models; "
        "build it where libgdal-dev is installed, or convert the file with `gdal_translate "
        "-of PNG -ot UInt16 -scale` and name the PNG");
}

/// GDAL brings OpenBLAS, which starts a thread for each core when it is loaded. They have nothing
/// to do here, and the memory of many does not fit into a child.
ReadDem load_module() {
    const fs::path file = dem_module();
    std::error_code error;
    if (!fs::exists(file, error)) refuse_without(file);
    ::setenv("OPENBLAS_NUM_THREADS", "1", 1);
    void* module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    void* function = module == nullptr ? nullptr : dlsym(module, "scipd_read_dem");
    if (function == nullptr) {
        throw std::runtime_error("needs GDAL, which cannot be loaded: " + std::string(dlerror()) +
                                 or_in_no_folder());
    }
    return reinterpret_cast<ReadDem>(function);
}

/// In the child.
HeightGrid read_by(ReadDem read_dem, const fs::path& file) {
    constexpr std::size_t most_words = 400;
    HeightGrid grid;
    try {
        read_dem(file, grid);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& wrong) {
        throw std::runtime_error(printable(wrong.what(), most_words));
    }
    return grid;
}

void put_grid(const HeightGrid& grid, std::FILE* out) {
    put(grid.width, out);
    put_all(grid.values, out);
    put(glm::dvec2{grid.low, grid.high}, out);
    put(grid.size_m, out);
    put_each(grid.remarks, out, [](const auto& remark, std::FILE* to) { put_all(remark, to); });
}

HeightGrid take_grid(std::FILE* in) {
    HeightGrid grid;
    grid.width = grid.height = take<std::size_t>(in);
    grid.values = take_all<std::vector<float>>(in);
    const auto range = take<glm::dvec2>(in);
    grid.low = range.x;
    grid.high = range.y;
    grid.top_upside_down_m = 0.0;
    grid.size_m = take<glm::dvec3>(in);
    grid.remarks = take_each<std::vector<std::string>>(in, take_all<std::string>);
    return grid;
}

}  // namespace

fs::path dem_module() {
    std::error_code error;
    const auto here = fs::read_symlink("/proc/self/exe", error).parent_path();
    const auto beside = here / SCIPD_READ_DEM;
    return here.empty() || fs::exists(beside, error) ? beside : here / SCIPD_READ_DEM_FROM_BIN;
}

HeightGrid read_dem(const fs::path& file) {
    const Confines confines{.processor_time = std::chrono::seconds{60},
                            .memory_bytes = std::size_t{2} << 30U};
    try {
        if (const auto plain = check_plain_file(file); !plain) {
            throw std::runtime_error(plain.error().why + "; a terrain is wanted here");
        }
        static const ReadDem module = load_module();  // once for all terrains of a world
        return take_grid(run_confined(confines, [&](std::FILE* out) {
                             put_grid(read_by(module, file), out);
                         }).get());
    } catch (const std::exception& wrong) {
        throw LoadError({file.string() + ": " + wrong.what()});
    }
}

}  // namespace scipd::sim
