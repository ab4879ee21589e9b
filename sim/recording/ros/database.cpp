// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/ros/database.h"

#include <sqlite3.h>

#include "sim/recording/compression/compression.h"
#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

/// The most steps of the library's virtual machine that one row may take; a plain one takes ten.
constexpr int most_operations = 10'000'000;

int open_file(const InputFile& file, sqlite3** database) {
    return sqlite3_open_v2(file.path().c_str(), database, SQLITE_OPEN_READONLY, nullptr);
}

int open_memory(std::string& bytes, sqlite3** database) {
    const int opened =
        sqlite3_open_v2(":memory:", database, SQLITE_OPEN_READWRITE | SQLITE_OPEN_MEMORY, nullptr);
    if (opened != SQLITE_OK) return opened;
    auto* const data = reinterpret_cast<unsigned char*>(bytes.data());
    const auto size = static_cast<sqlite3_int64>(bytes.size());
    return sqlite3_deserialize(*database, "main", data, size, size, SQLITE_DESERIALIZE_READONLY);
}

void distrust(sqlite3* database) {
    sqlite3_db_config(database, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_db_config(database, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    sqlite3_limit(database, SQLITE_LIMIT_LENGTH, static_cast<int>(largest_block));
    const auto stop = [](void*) { return 1; };
    sqlite3_progress_handler(database, most_operations, stop, nullptr);
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

std::int64_t Rows::number(int column) const {
    return sqlite3_column_int64(statement_.get(), column);
}

std::string_view Rows::bytes(int column) const {
    const auto* const data =
        static_cast<const char*>(sqlite3_column_blob(statement_.get(), column));
    const int size = sqlite3_column_bytes(statement_.get(), column);
    return data == nullptr ? std::string_view{} : std::string_view(data, size);
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
    distrust(database);
    return opened;
}

}  // namespace scipd::sim
