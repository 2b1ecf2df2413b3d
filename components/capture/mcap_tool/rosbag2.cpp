#include "capture/mcap_tool/rosbag2.hpp"

#include <sqlite3.h>

#include <algorithm>
#include <set>
#include <stdexcept>

namespace coop::mcap {
namespace {

struct Close {
  void operator()(sqlite3* database) const { sqlite3_close(database); }
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};

/// One file of a bag, read only: not even a lock is left beside it.
class Database {
 public:
  explicit Database(const std::filesystem::path& path) : name_(path.string()) {
    const std::string address =
        "file:" + escaped(std::filesystem::absolute(path).string()) + "?mode=ro&immutable=1";
    sqlite3* database = nullptr;
    const int result = sqlite3_open_v2(address.c_str(), &database,
                                       SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
    database_.reset(database);
    if (result != SQLITE_OK) fail();
  }

  /// Runs a query; `row` is called with each row.
  template <class Row>
  void query(const char* sql, const Row& row) {
    sqlite3_stmt* raw = nullptr;
    if (sqlite3_prepare_v2(database_.get(), sql, -1, &raw, nullptr) != SQLITE_OK) fail();
    const std::unique_ptr<sqlite3_stmt, Close> statement(raw);
    int result = SQLITE_OK;
    while ((result = sqlite3_step(raw)) == SQLITE_ROW) row(raw);
    if (result != SQLITE_DONE) fail();
  }

 private:
  static std::string escaped(const std::string& path) {
    std::string out;
    for (const char c : path) {
      if (c == '%')
        out += "%25";
      else if (c == '?')
        out += "%3f";
      else if (c == '#')
        out += "%23";
      else
        out += c;
    }
    return out;
  }
  [[noreturn]] void fail() const {
    throw std::runtime_error(name_ + ": " + sqlite3_errmsg(database_.get()));
  }

  std::string name_;
  std::unique_ptr<sqlite3, Close> database_;
};

std::string text(sqlite3_stmt* row, int column) {
  const auto* data = reinterpret_cast<const char*>(sqlite3_column_text(row, column));
  return data == nullptr ? std::string() : std::string(data);
}

Bytes blob(sqlite3_stmt* row, int column) {
  const auto* data = static_cast<const std::byte*>(sqlite3_column_blob(row, column));
  return {data, static_cast<std::size_t>(sqlite3_column_bytes(row, column))};
}

std::vector<std::filesystem::path> parts_of(const std::filesystem::path& bag) {
  if (!std::filesystem::is_directory(bag)) return {bag};
  std::vector<std::filesystem::path> parts;
  for (const auto& entry : std::filesystem::directory_iterator(bag)) {
    if (entry.path().extension() == ".db3") parts.push_back(entry.path());
  }
  if (parts.empty()) throw std::runtime_error(bag.string() + ": no *.db3 in this folder");
  // bag_2.db3 before bag_10.db3.
  std::ranges::sort(parts, [](const auto& a, const auto& b) {
    const std::string left = a.filename().string();
    const std::string right = b.filename().string();
    return std::pair(left.size(), left) < std::pair(right.size(), right);
  });
  return parts;
}

class Import {
 public:
  Import(const DefinitionOf& definition_of, Writer& writer)
      : definition_of_(definition_of), writer_(writer) {}

  void part(const std::filesystem::path& path) {
    Database database(path);
    std::map<std::int64_t, std::uint16_t> channel_of_topic;
    database.query("SELECT id, name, type, serialization_format, offered_qos_profiles FROM topics",
                   [&](sqlite3_stmt* row) {
                     channel_of_topic[sqlite3_column_int64(row, 0)] =
                         channel(text(row, 1), text(row, 2), text(row, 3), text(row, 4));
                   });
    database.query("SELECT topic_id, timestamp, data FROM messages ORDER BY timestamp, id",
                   [&](sqlite3_stmt* row) {
                     const auto topic = channel_of_topic.find(sqlite3_column_int64(row, 0));
                     if (topic == channel_of_topic.end()) {
                       throw std::runtime_error(path.string() + ": a message of no topic");
                     }
                     write(topic->second, static_cast<Nanoseconds>(sqlite3_column_int64(row, 1)),
                           blob(row, 2));
                   });
  }

  ImportReport report() {
    report_.unknown_types.assign(unknown_types_.begin(), unknown_types_.end());
    return std::move(report_);
  }

 private:
  std::uint16_t channel(const std::string& topic, const std::string& type,
                        const std::string& encoding, const std::string& qos) {
    const std::optional<std::string> definition = definition_of_(type);
    if (!definition) unknown_types_.insert(type);
    const std::uint16_t schema =
        writer_.add_schema(type, definition ? "ros2msg" : "", definition.value_or(""));
    return writer_.add_channel(schema, topic, encoding, {{"offered_qos_profiles", qos}});
  }

  void write(std::uint16_t channel, Nanoseconds time, Bytes data) {
    writer_.write({channel, sequence_[channel]++, time, time, data});
    ++report_.messages;
  }

  const DefinitionOf& definition_of_;
  Writer& writer_;
  std::map<std::uint16_t, std::uint32_t> sequence_;
  std::set<std::string> unknown_types_;
  ImportReport report_;
};

}  // namespace

ImportReport import_rosbag2(const std::filesystem::path& bag, const DefinitionOf& definition_of,
                            Writer& writer) {
  Import import(definition_of, writer);
  for (const std::filesystem::path& part : parts_of(bag)) import.part(part);
  return import.report();
}

}  // namespace coop::mcap
