#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/config/fields.hpp"
#include "core/pose.hpp"
#include "core/result.hpp"
#include "core/time.hpp"

namespace coop {

/// Odometry's pose at a stamp. Between fixes of different pieces odometry was restarted, and how
/// the robot moved meanwhile is not known.
struct OdometryFix {
  OdometryFix() = default;
  /// Implicit: where odometry never restarts, a pose says all.
  OdometryFix(const Pose2& pose, std::uint32_t piece_number = 0)
      : base_in_odom(pose), piece(piece_number) {}

  Pose2 base_in_odom;
  std::uint32_t piece = 0;
};

/// What is no motion but a restart of odometry.
struct OdometryRestart {
  double plausible_speed = 3.0;  ///< m/s and rad/s, nothing moves faster
  double slack = 0.1;            ///< s by which stamps may be wrong

  void describe(config::Fields& fields);
};

/// Odometry by stamp, as if it had never been restarted: where the driver behind it dies and begins
/// again at zero, the new piece is hung onto the end of the old one as though the robot had stood
/// meanwhile. A restart shows in another source of the readings that does not go on where the last
/// one was, or in a step that nothing on wheels can do. The frame "track" is the odom frame of the
/// first piece.
class OdometryTrack {
 public:
  enum class Absence {
    kNotYet,  ///< the stamp lies after the newest reading
    kTooOld,  ///< the stamp lies before the oldest reading: will not come
    kGap,     ///< between two pieces: nobody knows
  };

  /// At most `limit` readings; the older half is thinned to every second one when it is reached.
  explicit OdometryTrack(std::size_t limit = 4'000'000, const OdometryRestart& restart = {})
      : limit_(limit), restart_(restart) {}

  /// Readings that run back in time are sorted in; of equal stamps the later comes behind. One that
  /// is there already, told again by a driver that was restarted, changes nothing. `source`
  /// tells apart who wrote them; empty: not known. Answers whether a new piece began.
  bool insert(const StampedPose2& base_in_odom, std::string_view source = {});

  /// base_in_track at the stamp, interpolated; of readings that bear just this stamp the last.
  [[nodiscard]] Result<OdometryFix, Absence> at(Time stamp) const;

  /// base_in_track, ascending.
  [[nodiscard]] std::span<const StampedPose2> readings() const { return readings_; }
  /// Of the newest piece: takes poses of today's odometry to the track.
  [[nodiscard]] Pose2 odom_in_track() const {
    return pieces_.empty() ? Pose2{} : pieces_.back().odom_in_track;
  }
  [[nodiscard]] const std::string& source() const { return source_; }

  /// Takes up a track that another process left: its poses, and what odom_in_track() and source()
  /// were.
  void resume(std::vector<StampedPose2> base_in_track, const Pose2& odom_in_track,
              std::string_view source);
  void clear();

 private:
  struct Piece {
    Time begin{};
    Pose2 odom_in_track;
  };
  [[nodiscard]] bool begins_anew(const StampedPose2& base_in_odom, std::string_view source) const;
  void begin_piece(const StampedPose2& base_in_odom);
  /// Number of the piece; 0 is the one without an entry in pieces_.
  [[nodiscard]] std::uint32_t piece_at(Time stamp) const;
  void thin();

  std::size_t limit_;
  OdometryRestart restart_;
  std::vector<StampedPose2> readings_;
  std::vector<Piece> pieces_;  ///< from the second on
  std::string source_;
};

}  // namespace coop
