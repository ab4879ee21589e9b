// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/file/plain_file.h"

#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "sim/loaders/file/allowed_folder.h"
#include "sim/loaders/file/load_error.h"
#include "sim/takes_long.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

std::string reason(int error) {
    return std::generic_category().message(error);
}

Expected<> check_mode(mode_t mode) {
    if (S_ISREG(mode)) return {};
    if (S_ISDIR(mode)) return refuse("is a directory");
    if (S_ISFIFO(mode)) return refuse("is a FIFO");
    if (S_ISSOCK(mode)) return refuse("is a socket");
    return refuse("is a device");
}

File stream_of(int descriptor, const char* mode) {
    File file{fdopen(descriptor, mode)};
    if (file) return file;
    close(descriptor);
    throw std::runtime_error("cannot be read: " + reason(errno));
}

}  // namespace

Expected<> check_plain_file(const fs::path& path) {
    if (const auto allowed = check_allowed(path); !allowed) return allowed;
    struct stat status = {};
    if (stat(path.c_str(), &status) == 0) return check_mode(status.st_mode);
    if (errno == ENOENT || errno == ENOTDIR) return refuse("no such file");
    return refuse("cannot be accessed: " + reason(errno));
}

File open_file(const fs::path& path) {
    takes_long();
    if (const auto plain = check_plain_file(path); !plain)
        throw std::runtime_error(plain.error().why);
    const int descriptor = open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (descriptor < 0) throw std::runtime_error("cannot be read: " + reason(errno));
    File file = stream_of(descriptor, "rb");
    // Somebody may have put something else there meanwhile.
    const fs::path opened = "/proc/self/fd/" + std::to_string(descriptor);
    if (const auto allowed = check_allowed(opened); !allowed)
        throw std::runtime_error(allowed.error().why);
    struct stat status = {};
    fstat(descriptor, &status);
    if (const auto plain = check_mode(status.st_mode); !plain)
        throw std::runtime_error(plain.error().why);
    return file;
}

std::string beginning_of(const fs::path& path) {
    constexpr std::size_t enough = 4096;
    if (!check_plain_file(path)) return {};
    std::string text(enough, ' ');
    text.resize(std::fread(text.data(), 1, text.size(), open_file(path).get()));
    return text;
}

int memory_descriptor() {
    constexpr int first = 4;
    int descriptor = memfd_create("scipd", MFD_CLOEXEC);
    if (descriptor >= 0 && descriptor < first) {
        const int low = std::exchange(descriptor, fcntl(descriptor, F_DUPFD_CLOEXEC, first));
        close(low);
    }
    if (descriptor < 0) throw std::runtime_error("cannot make a memory file: " + reason(errno));
    return descriptor;
}

File memory_file() {
    return stream_of(memory_descriptor(), "w+");
}

std::string read_file(const fs::path& path, std::uintmax_t most_bytes, const std::string& wanted) {
    const auto refuse = [&](const std::string& why) {
        throw LoadError({path.string() + ": " + why + "; " + wanted});
    };
    std::string bytes;
    try {
        const File file = open_file(path);
        // Files in /proc report a size of 0 and read as empty.
        struct stat status = {};
        fstat(fileno(file.get()), &status);
        const auto size = static_cast<std::uintmax_t>(status.st_size);
        if (size > most_bytes)
            refuse("is larger than " + std::to_string(most_bytes >> 20U) + " MiB");
        bytes.resize(size);
        bytes.resize(std::fread(bytes.data(), 1, bytes.size(), file.get()));
        if (std::ferror(file.get()) != 0) refuse("cannot be read");
    } catch (const LoadError&) {
        throw;
    } catch (const std::runtime_error& why) {
        refuse(why.what());
    }
    return bytes;
}

std::string read_text(const fs::path& path, std::uintmax_t most_bytes, const std::string& wanted) {
    std::string text = read_file(path, most_bytes, wanted);
    // These are the byte order marks of UTF-16. No UTF-8 begins so.
    if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
        throw LoadError({path.string() + ": is in UTF-16; save it as UTF-8"});
    return text;
}

}  // namespace scipd::sim
