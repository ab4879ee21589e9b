// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/ros/database.h"

#include <filesystem>
#include <system_error>

#include <sqlite3.h>

#include "sim/recording/compression/compression.h"
#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

/// Steps of the library's virtual machine between two looks at what is left. A row takes ten to
/// thirty steps, and at least ten bytes of the file.
constexpr int steps_of_round = 1'000'000;
constexpr std::int64_t least_rounds = 10;
constexpr std::int64_t bytes_of_round = 200'000;

/// Size in bytes; 0: there is no such file.
std::uintmax_t size_of(const std::string& path) {
    std::error_code error;
    const auto size = std::filesystem::file_size(path, error);
    return error ? 0 : size;
}

/// "file:PATH?mode=ro". SQLite would make a -shm file beside one in WAL mode: it needs none where
/// the recorder has closed the file, and none without locks where the recorder was killed.
std::string uri_of(InputFile& file) {
    constexpr std::size_t write_version = 18;  // offset in the file's header; 2: in WAL mode
    const std::string path = file.path().string();
    std::string uri = "file:";
    for (const char byte : path)
        uri += byte == '%'   ? "%25"
               : byte == '?' ? "%3f"
               : byte == '#' ? "%23"
                             : std::string(1, byte);
    uri += "?mode=ro";
    const auto version = file.read(write_version, 1);
    if (!version || *version != "\x02") return uri;
    if (size_of(path + "-wal") == 0) return uri + "&immutable=1";
    return size_of(path + "-shm") == 0 ? uri + "&vfs=unix-none" : uri;
}

int open_file(InputFile& file, sqlite3** database) {
    const std::string uri = uri_of(file);
    const int flags = SQLITE_OPEN_READONLY | SQLITE_OPEN_URI;
    const int opened = sqlite3_open_v2(uri.c_str(), database, flags, nullptr);
    if (opened != SQLITE_OK) return opened;
    sqlite3_db_config(*database, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
    if (!uri.ends_with("unix-none")) return opened;
    // Keeps the index of the -wal file in memory.
    return sqlite3_exec(*database, "PRAGMA locking_mode=EXCLUSIVE", nullptr, nullptr, nullptr);
}

int open_memory(std::string& bytes, sqlite3** database) {
    const int opened =
        sqlite3_open_v2(":memory:", database, SQLITE_OPEN_READWRITE | SQLITE_OPEN_MEMORY, nullptr);
    if (opened != SQLITE_OK) return opened;
    auto* const data = reinterpret_cast<unsigned char*>(bytes.data());
    const auto size = static_cast<sqlite3_int64>(bytes.size());
    return sqlite3_deserialize(*database, "main", data, size, size, SQLITE_DESERIALIZE_READONLY);
}

void distrust(sqlite3* database, std::int64_t* rounds_left) {
    sqlite3_db_config(database, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_db_config(database, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    sqlite3_limit(database, SQLITE_LIMIT_LENGTH, static_cast<int>(largest_block));
    const auto end_of_rounds = [](void* left) {
        return --*static_cast<std::int64_t*>(left) < 0 ? 1 : 0;
    };
    sqlite3_progress_handler(database, steps_of_round, end_of_rounds, rounds_left);
}

}  // namespace

void Rows::Close::operator()(sqlite3_stmt* statement) const {
    sqlite3_finalize(statement);
}

void Database::Close::operator()(sqlite3* database) const {
    sqlite3_close(database);
}

Rows::Rows(sqlite3* database, const std::string& question) : database_(database) {
    sqlite3_stmt* statement = nullptr;
    sqlite3_prepare_v2(database, question.c_str(), -1, &statement, nullptr);
    statement_.reset(statement);
}

Expected<bool> Rows::next() {
    // Nothing to step through: the question does not fit the file, and the library says why.
    if (!statement_) return refuse(printable(sqlite3_errmsg(database_)));
    const int result = sqlite3_step(statement_.get());
    if (result == SQLITE_ROW) return true;
    if (result == SQLITE_DONE) return false;
    return refuse(printable(sqlite3_errmsg(database_)));
}

void Rows::bind(std::int64_t value) {
    sqlite3_reset(statement_.get());
    sqlite3_bind_int64(statement_.get(), 1, value);
}

std::int64_t Rows::number(int column) const {
    return sqlite3_column_int64(statement_.get(), column);
}

std::string_view Rows::bytes(int column) const {
    const auto* const data =
        static_cast<const char*>(sqlite3_column_blob(statement_.get(), column));
    const int size = sqlite3_column_bytes(statement_.get(), column);
    return data == nullptr ? std::string_view{} : std::string_view(data, size);
}

Expected<> Database::check_table(const std::string& name) {
    Rows kinds = ask("SELECT type, (SELECT count(*) FROM pragma_table_xinfo('" + name +
                     "') WHERE hidden) FROM pragma_table_list WHERE schema = 'main' AND name = '" +
                     name + "'");
    const auto row = kinds.next();
    if (!row) return tl::unexpected(row.error());
    if (!*row) return refuse("no such table: " + name);
    if (kinds.bytes(0) == "table" && kinds.number(1) == 0) return {};
    return refuse("its " + name + " are no plain table, but a view or computed");
}

Expected<Database> Database::open(InputFile& file) {
    Database opened;
    sqlite3* database = nullptr;
    int result = SQLITE_OK;
    if (file.path().empty()) {
        auto bytes = file.read(0, file.size());
        if (!bytes) return tl::unexpected(bytes.error());
        opened.bytes_ = std::make_unique<std::string>(std::move(*bytes));
        result = open_memory(*opened.bytes_, &database);
    } else {
        result = open_file(file, &database);
    }
    opened.database_.reset(database);
    if (result != SQLITE_OK) return file.refuse(sqlite3_errstr(result));
    const auto rounds = static_cast<std::int64_t>(file.size()) / bytes_of_round + least_rounds;
    opened.rounds_left_ = std::make_unique<std::int64_t>(rounds);
    distrust(database, opened.rounds_left_.get());
    return opened;
}

}  // namespace scipd::sim
