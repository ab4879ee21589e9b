// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A file of SQLite that is only read, and may be hostile: it runs nothing of its own, and all that
// is asked takes at most as long as its size allows. No -wal or -shm file is made beside it. Of one
// owner; any thread.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "sim/expected.h"
#include "sim/recording/file/input_file.h"

struct sqlite3;
struct sqlite3_stmt;

namespace scipd::sim {

/// The rows of a question.
class Rows {
  public:
    Rows(sqlite3* database, const std::string& question);

    /// Goes on to the next row; false: there is none. The fault is the library's own words.
    [[nodiscard]] Expected<bool> next();

    /// For the first ? of the question; the rows begin anew.
    void bind(std::int64_t value);

    [[nodiscard]] std::int64_t number(int column) const;
    /// Until next() is called.
    [[nodiscard]] std::string_view bytes(int column) const;

  private:
    struct Close {
        void operator()(sqlite3_stmt* statement) const;
    };

    sqlite3* database_;
    std::unique_ptr<sqlite3_stmt, Close> statement_;
};

class Database {
  public:
    [[nodiscard]] static Expected<Database> open(InputFile& file);

    [[nodiscard]] Rows ask(const std::string& question) { return {database_.get(), question}; }
    /// Refuses a name of a view, and a table with columns that are computed.
    [[nodiscard]] Expected<> check_table(const std::string& name);

  private:
    struct Close {
        void operator()(sqlite3* database) const;
    };

    std::unique_ptr<std::string> bytes_;         ///< of a file in memory
    std::unique_ptr<std::int64_t> rounds_left_;  ///< of the library's virtual machine
    std::unique_ptr<sqlite3, Close> database_;
};

}  // namespace scipd::sim
