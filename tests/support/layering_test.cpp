// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The laws of the folders, read off the sources: who may include whom, and how long a file may be.
// Arrows go one way, and a folder that breaks its law is named with file and line.
#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct Law {
    std::string_view folder;  ///< or one file; the longest that fits a path counts
    std::vector<std::string_view>
        may_use;  ///< beginnings of includes; the standard library is everybody's
    std::string_view reason;
};

const std::string_view anything = "";

const std::vector<Law>& laws() {
    static const std::vector<Law> all = {
        {"protocol/",
         {"protocol/"},
         "protocol is the standard library and itself: no I/O, no metres"},
        {"sim/", {"sim/", "glm/"}, "sim knows neither SCIP nor Asio nor logs"},
        {"sim/world/",
         {"sim/world/", "sim/time.h", "sim/random.h", "glm/"},
         "a world knows nobody who looks at it"},
        {"sim/loaders/",
         {"sim/loaders/", "sim/world/", "sim/fnv1a.h", "sim/time.h", "glm/", "sdf/", "gz/",
          "ignition/", "assimp/", "nlohmann/", "console_bridge/", "tinyxml2.h", "yaml-cpp/", "stb/",
          "stb_image.h"},
         "loaders turn files into worlds"},
        {"sim/loaders/confined.cpp",
         {"sim/loaders/", "poll.h", "sys/", "unistd.h"},
         "child processes live behind this one file"},
        {"sim/loaders/sdf/dem.cpp",
         {"sim/loaders/", "glm/", "cpl_error.h", "gdal.h", "ogr_srs_api.h"},
         "GDAL lives behind this one file"},
        {"sim/loaders/plain_file.cpp",
         {"sim/loaders/", "fcntl.h", "sys/", "unistd.h"},
         "what the system says of a file is asked in this one"},
        {"sim/loaders/map/jpeg.cpp",
         {"sim/loaders/", "turbojpeg.h"},
         "libjpeg-turbo lives behind this one file"},
        {"sim/backends/",
         {"sim/backends/", "sim/world/", "sim/time.h", "sim/random.h", "glm/"},
         "backends cast rays into a world and know no sensor"},
        {"sim/backends/embree",
         {"sim/backends/", "sim/world/", "sim/time.h", "glm/", "embree3/", "embree4/",
          "xmmintrin.h", "pmmintrin.h"},
         "Embree lives behind this one file"},
        {"sim/backends/egl_context.cpp",
         {"sim/backends/", "epoxy/egl.h", "epoxy/gl.h", "dlfcn.h"},
         "EGL lives behind this one file"},
        {"sim/backends/depth_raster.cpp",
         {"sim/backends/", "glm/", "epoxy/gl.h"},
         "OpenGL lives behind this file and the context"},
        {"sim/sensor/",
         {"sim/sensor/", "sim/backends/", "sim/world/", "sim/time.h", "sim/random.h", "glm/"},
         "a sensor does not care where its world was read from"},
        {"daemon/", {anything}, ""},
        {"daemon/link/",
         {"daemon/", "protocol/", "sim/fnv1a.h", "sim/random.h", "sim/time.h", "boost/", "spdlog/",
          "asm/termbits.h", "fcntl.h", "linux/", "netinet/", "stdlib.h", "sys/", "termios.h",
          "unistd.h", "pty.h"},
         "a link moves bytes and knows no world"},
        {"daemon/models/",
         {"daemon/models/", "protocol/", "sim/sensor/", "sim/time.h", "sim/world/lidar.h"},
         "models are data"},
        {"tools/", {anything}, ""},
    };
    return all;
}

// What no law above may allow, since nobody at all may include it from there.
struct Ban {
    std::string_view folder;
    std::string_view included;
    std::string_view except;
    std::string_view reason;
};

constexpr std::array bans = {
    Ban{"", "tests/", "-", "nothing that is shipped leans on the tests"},
    Ban{"protocol/", "protocol/client/", "protocol/client/",
        "the scanner's side does not know the host's"},
    Ban{"daemon/", "protocol/client/", "-", "the daemon is the scanner, not a host"},
    Ban{"daemon/", "tools/", "-", "tools stand on the daemon's libraries, not under them"},
    Ban{"tools/", "daemon/device/", "-", "tools talk to the daemon from outside"},
    Ban{"tools/", "daemon/link/", "-", "tools talk to the daemon from outside"},
    Ban{"tools/", "daemon/api/", "-", "tools talk to the daemon from outside"},
    Ban{"tools/", "daemon/http/", "-", "tools talk to the daemon from outside"},
    Ban{"tools/", "daemon/poses/", "-", "tools talk to the daemon from outside"},
    Ban{"tools/", "daemon/world/", "-", "tools talk to the daemon from outside"},
    Ban{"daemon/", "embree", "-", "Embree lives behind sim/backends/embree"},
    Ban{"tools/", "embree", "-", "Embree lives behind sim/backends/embree"},
    Ban{"daemon/", "sdf/", "-", "SDF is read by sim/loaders"},
    Ban{"daemon/", "assimp/", "-", "meshes are read by sim/loaders"},
};

bool is_standard(std::string_view included) {
    return included.find_first_of("./") == std::string_view::npos;
}

/// Empty where the file may include it, else the reason why not.
std::string_view objection(std::string_view path, std::string_view included) {
    for (const Ban& ban : bans) {
        if (path.starts_with(ban.folder) && included.starts_with(ban.included) &&
            !path.starts_with(ban.except))
            return ban.reason;
    }
    const Law* law = nullptr;
    for (const Law& candidate : laws()) {
        const bool closer = law == nullptr || candidate.folder.size() > law->folder.size();
        if (closer && path.starts_with(candidate.folder)) law = &candidate;
    }
    if (law == nullptr) return "its folder has no law yet: give it one";
    const auto fits = [&](std::string_view beginning) { return included.starts_with(beginning); };
    const bool allowed =
        is_standard(included) || std::any_of(law->may_use.begin(), law->may_use.end(), fits);
    return allowed ? "" : law->reason;
}

/// FILE:LINE and what is wrong, for every include that breaks a law and for a file past its budget.
std::vector<std::string> faults_in(const std::string& path, std::string_view text) {
    std::vector<std::string> faults;
    int number = 0;
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(line.size() + 1, text.size()));
        ++number;
        constexpr std::string_view keyword = "#include";
        if (!line.starts_with(keyword)) continue;
        const std::size_t begin = line.find_first_of("\"<");
        const std::size_t end = line.find_last_of("\">");
        if (begin == std::string_view::npos || end <= begin) continue;
        const std::string_view included = line.substr(begin + 1, end - begin - 1);
        const std::string_view reason = objection(path, included);
        if (!reason.empty())
            faults.push_back(path + ":" + std::to_string(number) + ": may not include " +
                             std::string(included) + ": " + std::string(reason));
    }
    const int budget = path.ends_with(".h") ? 150 : 300;
    if (number > budget)
        faults.push_back(path + ": " + std::to_string(number) + " lines; a " +
                         (path.ends_with(".h") ? "header" : "source") + " has at most " +
                         std::to_string(budget));
    return faults;
}

std::string contents(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

class FolderLaws : public ::testing::TestWithParam<const char*> {};

TEST_P(FolderLaws, AreKept) {
    const std::filesystem::path root = SCIPD_SOURCES;
    int files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / GetParam())) {
        const std::string extension = entry.path().extension().string();
        if (extension != ".h" && extension != ".cpp") continue;
        ++files;
        const std::string path = std::filesystem::relative(entry.path(), root).generic_string();
        for (const std::string& fault : faults_in(path, contents(entry.path())))
            ADD_FAILURE() << fault;
    }
    EXPECT_GT(files, 0) << "no sources in " << root / GetParam();
}

INSTANTIATE_TEST_SUITE_P(Of, FolderLaws, ::testing::Values("protocol", "sim", "daemon", "tools"),
                         [](const auto& folder) { return std::string(folder.param); });

// That the laws can be broken at all.

std::vector<std::string> faults(const std::string& path, const std::string& included) {
    return faults_in(path, "// a comment\n#include " + included + "\n");
}

TEST(FolderLawsSelfTest, NameFileAndLineAndLaw) {
    EXPECT_THAT(faults("protocol/session.cpp", "\"sim/time.h\""),
                ElementsAre("protocol/session.cpp:2: may not include sim/time.h: protocol is the "
                            "standard library and "
                            "itself: no I/O, no metres"));
}

TEST(FolderLawsSelfTest, ForbidTheArrowsThatGoBack) {
    EXPECT_THAT(faults("protocol/a.h", "<unistd.h>"), ElementsAre(HasSubstr("standard library")));
    EXPECT_THAT(faults("protocol/a.h", "<boost/asio.hpp>"),
                ElementsAre(HasSubstr("standard library")));
    EXPECT_THAT(faults("protocol/a.h", "\"protocol/client/driver.h\""),
                ElementsAre(HasSubstr("host's")));
    EXPECT_THAT(faults("protocol/client/a.h", "\"daemon/clock.h\""),
                ElementsAre(HasSubstr("standard library")));
    EXPECT_THAT(faults("sim/a.h", "\"protocol/status.h\""), ElementsAre(HasSubstr("neither SCIP")));
    EXPECT_THAT(faults("sim/world/a.h", "\"sim/backends/fan.h\""),
                ElementsAre(HasSubstr("who looks at it")));
    EXPECT_THAT(faults("sim/backends/a.h", "\"sim/sensor/scan.h\""),
                ElementsAre(HasSubstr("know no sensor")));
    EXPECT_THAT(faults("sim/backends/reference.cpp", "<embree3/rtcore.h>"),
                ElementsAre(HasSubstr("know no sensor")));
    EXPECT_THAT(faults("sim/sensor/a.h", "\"sim/loaders/sdf/sdf.h\""),
                ElementsAre(HasSubstr("read from")));
    EXPECT_THAT(faults("sim/loaders/a.h", "<spdlog/spdlog.h>"),
                ElementsAre(HasSubstr("into worlds")));
    EXPECT_THAT(faults("daemon/link/a.h", "\"sim/world/pose.h\""),
                ElementsAre(HasSubstr("knows no world")));
    EXPECT_THAT(faults("daemon/a.h", "\"tests/support/x.h\""), ElementsAre(HasSubstr("the tests")));
    EXPECT_THAT(faults("tools/a.h", "\"daemon/link/tcp_port.h\""),
                ElementsAre(HasSubstr("from outside")));
    EXPECT_THAT(faults("elsewhere/a.h", "\"sim/time.h\""), ElementsAre(HasSubstr("no law yet")));
}

TEST(FolderLawsSelfTest, AllowTheArrowsThatAreDrawn) {
    EXPECT_THAT(faults("protocol/a.h", "<vector>"), IsEmpty());
    EXPECT_THAT(faults("protocol/client/a.h", "\"protocol/checksum.h\""), IsEmpty());
    EXPECT_THAT(faults("protocol/client/a.h", "\"protocol/client/driver.h\""), IsEmpty());
    EXPECT_THAT(faults("sim/backends/embree.cpp", "<embree4/rtcore.h>"), IsEmpty());
    EXPECT_THAT(faults("daemon/device/a.cpp", "\"sim/sensor/scanner.h\""), IsEmpty());
    EXPECT_THAT(faults("daemon/device/a.cpp", "\"protocol/session.h\""), IsEmpty());
}

TEST(FolderLawsSelfTest, CountLines) {
    EXPECT_THAT(faults_in("sim/a.h", std::string(150, '\n')), IsEmpty());
    EXPECT_THAT(faults_in("sim/a.h", std::string(151, '\n')),
                ElementsAre("sim/a.h: 151 lines; a header has at most 150"));
    EXPECT_THAT(faults_in("sim/a.cpp", std::string(300, '\n')), IsEmpty());
    EXPECT_THAT(faults_in("sim/a.cpp", std::string(301, '\n')),
                ElementsAre("sim/a.cpp: 301 lines; a source has at most 300"));
}

}  // namespace
