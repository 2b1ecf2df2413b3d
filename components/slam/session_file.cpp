#include "slam/session_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <type_traits>

#include "core/hash.hpp"

namespace coop::slam {
namespace {

constexpr std::string_view kFormat = "coop slam session 1\n";
constexpr int kFarthestCell = 1 << 20;  // from the origin: 52 km of cells of 5 cm
constexpr std::uint64_t kMostDirectorySlots = 1 << 22;

template <class Value>
void put(std::string& bytes, const Value& value) {
  static_assert(std::is_arithmetic_v<Value>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}
void put(std::string& bytes, const Pose2& pose) {
  for (const double number : {pose.x, pose.y, pose.yaw}) put(bytes, number);
}
void put(std::string& bytes, Time stamp) {
  put(bytes, to_nanoseconds(stamp));
}

/// Takes values from the front; one that goes beyond the end is zero, and is_whole() then says no.
class Source {
 public:
  explicit Source(std::string_view bytes) : rest_(bytes) {}

  template <class Value>
  Value take() {
    Value value{};
    const std::string_view part = take_bytes(sizeof value);
    if (whole_) std::memcpy(&value, part.data(), sizeof value);
    return value;
  }
  Pose2 take_pose() {
    const auto x = take<double>();
    const auto y = take<double>();
    const auto yaw = take<double>();
    whole_ = whole_ && std::isfinite(x) && std::isfinite(y) && std::isfinite(yaw);
    return {x, y, yaw};
  }
  Time take_stamp() { return Time(Duration(take<std::int64_t>())); }
  std::string_view take_bytes(std::size_t count) {
    whole_ = whole_ && count <= rest_.size();
    if (!whole_) return {};
    const std::string_view part = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return part;
  }
  [[nodiscard]] bool is_whole() const { return whole_; }
  [[nodiscard]] bool is_empty() const { return rest_.empty(); }

 private:
  std::string_view rest_;
  bool whole_ = true;
};

void put(std::string& bytes, Cell corner, const Tile& tile) {
  put(bytes, corner.x);
  put(bytes, corner.y);
  for (const MapCell& cell : tile.cells) {
    put(bytes, cell.visits);
    if (!cell.is_known()) continue;
    put(bytes, cell.hits);
    if (cell.hits == 0) continue;
    put(bytes, cell.mean_x);
    put(bytes, cell.mean_y);
  }
}

void take_cells(Source& source, Tile& tile) {
  for (MapCell& cell : tile.cells) {
    cell.visits = source.take<std::uint16_t>();
    if (!cell.is_known()) continue;
    cell.hits = source.take<std::uint16_t>();
    if (cell.hits == 0) continue;
    cell.mean_x = source.take<float>();
    cell.mean_y = source.take<float>();
  }
}

bool take_map(Source& source, TileMap& map) {
  const auto count = source.take<std::uint64_t>();
  Cell low{};
  Cell high{};
  for (std::uint64_t i = 0; i < count && source.is_whole(); ++i) {
    Cell corner;
    corner.x = source.take<int>();
    corner.y = source.take<int>();
    if (std::abs(corner.x) > kFarthestCell || std::abs(corner.y) > kFarthestCell) return false;
    low = {std::min(low.x, corner.x), std::min(low.y, corner.y)};
    high = {std::max(high.x, corner.x), std::max(high.y, corner.y)};
    const auto columns = static_cast<std::uint64_t>((high.x - low.x) >> kTileShift) + 1;
    const auto rows = static_cast<std::uint64_t>((high.y - low.y) >> kTileShift) + 1;
    if (columns * rows > kMostDirectorySlots) return false;
    take_cells(source, map.writable_tile_at(corner));
  }
  return source.is_whole();
}

}  // namespace

std::vector<StampedPose2> track_of(const Session& session) {
  std::vector<StampedPose2> base_in_track;
  for (const TrajectoryNode& node : session.nodes)
    base_in_track.push_back({node.stamp, node.base_in_odom});
  if (session.nodes.empty() || session.nodes.back().stamp < session.base_in_track.stamp)
    base_in_track.push_back(session.base_in_track);
  return base_in_track;
}

std::string to_bytes(const Session& session) {
  std::string content;
  put(content, session.map.resolution());
  put(content, session.base_in_track.stamp);
  put(content, session.base_in_track.pose);
  put(content, session.odom_in_track);
  put(content, static_cast<std::uint64_t>(session.odometry_source.size()));
  content += session.odometry_source;
  put(content, static_cast<std::uint64_t>(session.nodes.size()));
  for (const TrajectoryNode& node : session.nodes) {
    put(content, node.stamp);
    put(content, node.base_in_odom);
    put(content, node.base_in_map);
  }
  put(content, static_cast<std::uint64_t>(session.map.tile_count()));
  session.map.for_each_tile([&](Cell corner, const Tile& tile) { put(content, corner, tile); });
  std::string bytes(kFormat);
  put(bytes, fnv1a(content));
  return bytes + content;
}

Result<Session> parse_session(std::string_view bytes) {
  if (!bytes.starts_with(kFormat)) return fail("is no session of this format");
  bytes.remove_prefix(kFormat.size());
  Source source(bytes);
  const auto checksum = source.take<std::uint64_t>();
  if (!source.is_whole() || checksum != fnv1a(bytes.substr(sizeof checksum)))
    return fail("is cut or altered");
  Session session;
  const auto resolution = source.take<double>();
  if (!(resolution >= 1e-3 && resolution <= 10.0)) return fail("holds impossible numbers");
  session.map = TileMap(resolution);
  session.base_in_track.stamp = source.take_stamp();
  session.base_in_track.pose = source.take_pose();
  session.odom_in_track = source.take_pose();
  session.odometry_source = source.take_bytes(source.take<std::uint64_t>());
  const auto nodes = source.take<std::uint64_t>();
  for (std::uint64_t i = 0; i < nodes && source.is_whole(); ++i) {
    TrajectoryNode node;
    node.stamp = source.take_stamp();
    node.base_in_odom = source.take_pose();
    node.base_in_map = source.take_pose();
    session.nodes.push_back(node);
  }
  if (!take_map(source, session.map) || !source.is_empty() || session.nodes.empty())
    return fail("holds impossible numbers");
  return session;
}

}  // namespace coop::slam
