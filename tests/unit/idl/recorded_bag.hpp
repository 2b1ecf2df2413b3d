#pragma once
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "support/shared_data.hpp"
#include "unit/idl/cdr_sample.hpp"

namespace coop::test {

/// A recording of a real robot: laser, odometry and transforms of a TurtleBot with a Neato scanner.
inline std::optional<std::filesystem::path> recorded_bag() {
  return shared_data("ros2/bags/macfirst_floor_take_2/macfirst_floor_take_2_0.db3");
}

/// The serialised samples of all topics of a type ("sensor_msgs/msg/LaserScan") in an rosbag2 file,
/// in order.
inline std::vector<Bytes> samples_of(const std::filesystem::path& bag, const std::string& type) {
  sqlite3* database = nullptr;
  const std::string address = "file:" + bag.string() + "?immutable=1";
  EXPECT_EQ(
      sqlite3_open_v2(address.c_str(), &database, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr),
      SQLITE_OK);
  sqlite3_stmt* query = nullptr;
  EXPECT_EQ(sqlite3_prepare_v2(database,
                               "select data from messages join topics on topic_id = topics.id "
                               "where type = ? order by messages.id",
                               -1, &query, nullptr),
            SQLITE_OK);
  sqlite3_bind_text(query, 1, type.c_str(), -1, SQLITE_TRANSIENT);
  std::vector<Bytes> samples;
  while (sqlite3_step(query) == SQLITE_ROW) {
    const auto* data = static_cast<const std::uint8_t*>(sqlite3_column_blob(query, 0));
    samples.emplace_back(data, data + sqlite3_column_bytes(query, 0));
  }
  sqlite3_finalize(query);
  sqlite3_close(database);
  return samples;
}

}  // namespace coop::test
