#pragma once
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/pose.hpp"
#include "core/result.hpp"
#include "core/time.hpp"

namespace coop {

/// Why a transform cannot be told.
enum class TransformError {
  kUnknownFrame,  ///< nobody ever told of one of the frames
  kNotConnected,  ///< the frames have no common ancestor
  kNotYet,        ///< the stamp lies after the newest sample: may come
  kTooOld,        ///< the stamp lies before the oldest sample kept: will not come
};
[[nodiscard]] std::string_view to_string(TransformError error);

/// Tree of frames with a short history of each, looked up at a stamp and interpolated (position
/// linear, orientation slerp). Absence is an error result, never identity and never "the latest".
/// Not thread-safe: belongs to one executor.
class TransformBuffer {
 public:
  /// Samples older than `history` behind the newest of their frame are dropped.
  explicit TransformBuffer(Duration history = std::chrono::seconds(15)) : history_(history) {}

  /// `child_in_parent` at `stamp`. A stamp far (over the history) before the newest of that frame
  /// means that time was set back: the frame's history starts anew. Smaller steps back, as real
  /// loggers make, are sorted in.
  void insert(std::string_view parent, std::string_view child, Time stamp,
              const Pose3& child_in_parent);
  /// Holds at all times.
  void insert_static(std::string_view parent, std::string_view child, const Pose3& child_in_parent);

  /// source_in_target at `stamp`: takes points of `source` to `target`.
  [[nodiscard]] Result<Pose3, TransformError> lookup(std::string_view target,
                                                     std::string_view source, Time stamp) const;

  /// The newest stamp at which lookup() answers, Time::max() where all between is static.
  [[nodiscard]] Result<Time, TransformError> newest_stamp(std::string_view target,
                                                          std::string_view source) const;

  /// Forgets all but the static transforms (after a jump of the clock).
  void clear_history();

 private:
  struct Sample {
    Time stamp;
    Eigen::Vector3d translation;
    Eigen::Quaterniond rotation;
  };
  struct Frame {
    std::string name;
    int parent = -1;
    bool is_static = false;
    std::deque<Sample> samples;
  };

  int frame_index(std::string_view name);
  [[nodiscard]] int find(std::string_view name) const;
  [[nodiscard]] Result<std::pair<std::vector<int>, std::vector<int>>, TransformError> chains(
      std::string_view target, std::string_view source) const;
  [[nodiscard]] static Result<Pose3, TransformError> sample_at(const Frame& frame, Time stamp);

  Duration history_;
  std::vector<Frame> frames_;
  std::unordered_map<std::string, int> index_;
};

/// Where `source` is now, as far as is known: its newest pose in `target`, on the floor. Nothing
/// where it is unknown or older than `max_age` at `now`. The stamp is at most `now`, also where the
/// transform holds longer.
[[nodiscard]] std::optional<StampedPose2> newest_pose(const TransformBuffer& transforms,
                                                      std::string_view target,
                                                      std::string_view source, Time now,
                                                      Duration max_age = Duration::max());

}  // namespace coop
