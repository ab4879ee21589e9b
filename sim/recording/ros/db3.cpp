// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <algorithm>
#include <bit>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include <sqlite3.h>

#include "sim/recording/compression/compression.h"
#include "sim/recording/file/byte_reader.h"
#include "sim/recording/ros/bags.h"
#include "sim/recording/ros/laser_recording.h"
#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

constexpr std::string_view zstd_magic{"\x28\xB5\x2F\xFD", 4};
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

/// Bytes that a file lacks at its end, by its header (sqlite.org/fileformat2.html, 1.3).
std::uint64_t missing_of(InputFile& file) {
    constexpr std::size_t header_size = 100;
    const auto header = file.read(0, header_size);
    if (!header || header->size() < header_size) return 0;
    ByteReader page_size(std::string_view(*header).substr(16), std::endian::big);
    ByteReader pages(std::string_view(*header).substr(28), std::endian::big);
    const auto told = page_size.number<std::uint16_t>();
    const std::uint64_t size = told == 1 ? 65536 : told;
    const std::uint64_t whole = size * pages.number<std::uint32_t>();
    return whole > file.size() ? whole - file.size() : 0;
}

struct CloseSqlite {
    void operator()(sqlite3* database) const { sqlite3_close(database); }
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};

/// The rows of a question.
class Rows {
  public:
    Rows(sqlite3* database, const std::string& question) : database_(database) {
        sqlite3_stmt* statement = nullptr;
        sqlite3_prepare_v2(database, question.c_str(), -1, &statement, nullptr);
        statement_.reset(statement);
    }

    /// Goes on to the next row; false: there is none. The fault is the library's own words.
    [[nodiscard]] Expected<bool> next() {
        // Without a statement the question does not fit the file, and the library says why.
        const int result = statement_ ? sqlite3_step(statement_.get()) : SQLITE_ERROR;
        if (result == SQLITE_ROW || result == SQLITE_DONE) return result == SQLITE_ROW;
        return refuse(printable(sqlite3_errmsg(database_)));
    }
    /// For the first ? of the question; the rows begin anew.
    void bind(std::int64_t value) {
        sqlite3_reset(statement_.get());
        sqlite3_bind_int64(statement_.get(), 1, value);
    }

    [[nodiscard]] std::int64_t number(int column) const {
        return sqlite3_column_int64(statement_.get(), column);
    }
    /// Until next() is called.
    [[nodiscard]] std::string_view bytes(int column) const {
        const auto* const data =
            static_cast<const char*>(sqlite3_column_blob(statement_.get(), column));
        const int size = sqlite3_column_bytes(statement_.get(), column);
        return data == nullptr ? std::string_view{} : std::string_view(data, size);
    }

  private:
    sqlite3* database_;
    std::unique_ptr<sqlite3_stmt, CloseSqlite> statement_;
};

/// The file may be hostile: it runs nothing of its own, and all that is asked takes at most as long
/// as its size allows. No -wal or -shm file is made beside it.
class Db3 final : public LaserRecording {
  public:
    explicit Db3(InputFile file) : LaserRecording("db3", std::move(file)) {}

    /// Reads the topics, before the first message.
    Expected<> open() {
        if (const int opened = open_database(); opened != SQLITE_OK)
            return file_.refuse(sqlite3_errstr(opened));
        const std::uint64_t missing = missing_of(file_);
        distrust(missing > 0);
        if (const auto read = read_topics(); !read)
            return file_.refuse("is no bag of rosbag2: " + read.error().why);
        // Without an index of the times the library sorts the rows, but without their data.
        messages_ = ask(missing == 0 ? "SELECT rowid, topic_id, timestamp FROM messages "
                                       "WHERE timestamp >= ? ORDER BY timestamp, rowid"
                                     : "SELECT rowid, topic_id, timestamp FROM messages "
                                       "NOT INDEXED WHERE timestamp >= ?");
        if (missing > 0)
            warn(file_.name() + ": lacks " + std::to_string(missing) +
                 " bytes at its end; the messages that are there are read");
        messages_->bind(std::numeric_limits<std::int64_t>::min());
        data_ = ask("SELECT data FROM messages WHERE rowid = ?");
        return {};
    }

    void skip_ahead(std::chrono::nanoseconds since_first) override {
        const auto log_ns = begin_ns_.value_or(0) + since_first.count();
        if (begin_ns_ && log_ns > log_ns_) messages_->bind(log_ns);
    }

  private:
    Rows ask(const std::string& question) { return {database_.get(), question}; }

    int open_database() {
        sqlite3* database = nullptr;
        int opened = SQLITE_OK;
        if (file_.path().empty()) {
            bytes_ = file_.read(0, file_.size()).value_or("");
            opened = open_memory(bytes_, &database);
        } else {
            opened = open_file(file_, &database);
        }
        database_.reset(database);
        return opened;
    }

    /// The library reads no file that was cut off, but for repair.
    void distrust(bool cut) {
        sqlite3_db_config(database_.get(), SQLITE_DBCONFIG_DEFENSIVE, cut ? 0 : 1, nullptr);
        sqlite3_db_config(database_.get(), SQLITE_DBCONFIG_WRITABLE_SCHEMA, cut ? 1 : 0, nullptr);
        sqlite3_db_config(database_.get(), SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
        sqlite3_limit(database_.get(), SQLITE_LIMIT_LENGTH, static_cast<int>(largest_block));
        rounds_left_ = static_cast<std::int64_t>(file_.size()) / bytes_of_round + least_rounds;
        const auto end_of_rounds = [](void* left) {
            return --*static_cast<std::int64_t*>(left) < 0 ? 1 : 0;
        };
        sqlite3_progress_handler(database_.get(), steps_of_round, end_of_rounds, &rounds_left_);
    }

    /// Refuses a name of a view, and a table with columns that are computed.
    Expected<> check_table(const std::string& name) {
        Rows kinds =
            ask("SELECT type, (SELECT count(*) FROM pragma_table_xinfo('" + name +
                "') WHERE hidden) FROM pragma_table_list WHERE schema = 'main' AND name = '" +
                name + "'");
        const auto row = kinds.next();
        if (!row) return tl::unexpected(row.error());
        if (!*row) return refuse("no such table: " + name);
        if (kinds.bytes(0) == "table" && kinds.number(1) == 0) return {};
        return refuse("its " + name + " are no plain table, but a view or computed");
    }

    Expected<> read_topics() {
        for (const char* const table : {"topics", "messages"}) {
            if (const auto checked = check_table(table); !checked) return checked;
        }
        Rows topics = ask("SELECT id, name, type, serialization_format FROM topics");
        for (;;) {
            const auto row = topics.next();
            if (!row) return tl::unexpected(row.error());
            if (!*row) return {};
            const std::string name(topics.bytes(1));
            const std::string type(topics.bytes(2));
            if (topics.bytes(3) == "cdr")
                add_topic(static_cast<std::uint32_t>(topics.number(0)),
                          {name, type, RosEncoding::cdr});
            else
                leave_out(name, type);
        }
    }

    Next do_next() override {
        while (!is_beyond_reading()) {
            const auto row = messages_->next();
            if (!row)
                lose(file_.refuse("the rest, behind message " + std::to_string(message_) +
                                  ", cannot be read: " + row.error().why));
            if (!row || !*row) return std::nullopt;
            message_ = messages_->number(0);
            // Clamped to a sane clock, so that sums fit.
            log_ns_ = std::clamp<std::int64_t>(messages_->number(2), 0, std::int64_t{1} << 62);
            if (!begin_ns_) begin_ns_ = log_ns_;
            const auto topic = static_cast<std::uint32_t>(messages_->number(1));
            if (!has_topic(topic)) continue;
            auto item = item_of(topic);
            if (item) return std::move(*item);
            lose(file_.refuse("message " + std::to_string(message_) + ": " + item.error().why));
        }
        return std::nullopt;
    }

    Expected<RecordedItem> item_of(std::uint32_t topic) {
        data_->bind(message_);
        const auto row = data_->next();
        if (!row) return tl::unexpected(row.error());
        const HostTime logged{std::chrono::nanoseconds(log_ns_)};
        const std::string_view data = *row ? data_->bytes(0) : std::string_view{};
        return unpack(data.starts_with(zstd_magic) ? "zstd" : "", data, unpack_left_)
            .and_then([&](const std::string& bytes) { return laser_item(topic, logged, bytes); });
    }

    std::string bytes_;             ///< of a file in memory
    std::int64_t rounds_left_ = 0;  ///< of the library's virtual machine
    std::unique_ptr<sqlite3, CloseSqlite> database_;
    std::optional<Rows> messages_;
    std::optional<Rows> data_;
    std::int64_t message_ = 0;              ///< the last one that was met
    std::int64_t log_ns_ = 0;               ///< its log time
    std::optional<std::int64_t> begin_ns_;  ///< log time of the first message
};

}  // namespace

Expected<std::unique_ptr<Recording>> open_db3(InputFile file) {
    auto recording = std::make_unique<Db3>(std::move(file));
    if (const auto opened = recording->open(); !opened) return tl::unexpected(opened.error());
    return recording;
}

}  // namespace scipd::sim
