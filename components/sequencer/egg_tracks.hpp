#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/config/fields.hpp"
#include "core/detection.hpp"
#include "core/pose.hpp"
#include "core/time.hpp"
#include "sequencer/camera_view.hpp"

namespace coop::sequencer {

struct EggTracksConfig {
  std::string name = "egg";    ///< of what is tracked: ids are this and a number; not configured
  int confirm_after = 3;       ///< sightings until an egg counts
  double gate = 9.21;          ///< squared Mahalanobis distance of a match: 99 % of two dimensions
  double max_distance = 0.30;  ///< m, farther sightings are never the same egg
  double merge_distance = 0.10;  ///< m, nearer tracks are one egg
  double min_stddev = 0.02;      ///< m, no sighting is trusted more: error of localisation
  double growth = 0.002;         ///< m/sqrt(s), what an egg's place loses in certainty unseen
  double min_score = 0.3;        ///< weaker detections are ignored
  double forget_after = 20.0;    ///< s without sighting until an unconfirmed track is dropped
  int again_after = 5;  ///< pictures in a row with an egg where one was picked: there is a new one
  CameraViewConfig view;

  void describe(config::Fields& fields);
};

/// A sighting, projected onto the floor of the map.
struct Sighting {
  Eigen::Vector2d egg_in_map{0, 0};
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< m^2
  double score = 1.0;
};

/// Detections of that class, in the camera's frame, as sightings in the map.
[[nodiscard]] std::vector<Sighting> to_sightings(const std::vector<Detection>& detections,
                                                 std::string_view class_id,
                                                 const Pose3& camera_in_map);

/// One picture.
struct Picture {
  Time stamp{};
  std::vector<Sighting> sightings;
  std::optional<CameraView> view;  ///< nothing: not known what the picture shows
};

struct EggTrack {
  std::string id;
  Eigen::Vector2d egg_in_map{0, 0};
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();
  int sightings = 0;
  bool confirmed = false;
  int seen_in_row = 0;    ///< pictures; those that do not show its place are left out
  int unseen_in_row = 0;  ///< pictures that show its place without it
  bool picked = false;
  bool replaced = false;  ///< picked, and another egg lies in its place
  Time last_seen{};       ///< stamp of the picture
  Time picked_at{};

  [[nodiscard]] double stddev() const;  ///< m, of the worse direction
};

/// Eggs lie still: each track is a Kalman filter of a constant position. Sightings are matched
/// nearest first within a gate, tracks that come close are merged.
///
/// The place of a picked egg stays a track. Pictures of before the end of the pick are its echo and
/// count for nothing. An egg seen there in later pictures is a new one (laid anew, or the arm lost
/// it) when `again_after` of them in a row have it; a picture that shows the empty place begins the
/// row anew. So neither a late picture nor a flicker makes an egg, and none is lost for good.
class EggTracks {
 public:
  explicit EggTracks(const EggTracksConfig& config) : config_(config) {}

  /// Pictures in the order of their stamps.
  void update(const Picture& picture);
  void mark_picked(const std::string& id, Time now);
  /// Takes in an egg known from before (a journal).
  void restore(EggTrack track);

  [[nodiscard]] const std::vector<EggTrack>& tracks() const { return tracks_; }
  [[nodiscard]] int pictures() const { return pictures_; }  ///< taken in
  [[nodiscard]] const EggTrack* find(const std::string& id) const;

 private:
  void grow(Time now);
  [[nodiscard]] EggTrack* match(const Sighting& sighting, const Eigen::Matrix2d& noise);
  EggTrack& add(const Sighting& sighting, const Eigen::Matrix2d& noise);
  void take(const Sighting& sighting, Time stamp);
  void count(const Picture& picture);
  void merge_close();

  EggTracksConfig config_;
  std::vector<EggTrack> tracks_;
  Time last_update_{};
  int next_id_ = 1;
  int pictures_ = 0;
};

}  // namespace coop::sequencer
