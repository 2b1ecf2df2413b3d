#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/config/fields.hpp"
#include "core/time.hpp"

namespace coop::sequencer {

struct EggTracksConfig {
  int confirm_after = 3;       ///< sightings until an egg counts
  double gate = 9.21;          ///< squared Mahalanobis distance of a match: 99 % of two dimensions
  double max_distance = 0.30;  ///< m, farther sightings are never the same egg
  double merge_distance = 0.10;     ///< m, nearer tracks are one egg
  double min_stddev = 0.02;         ///< m, no sighting is trusted more: error of localisation
  double growth = 0.002;            ///< m/sqrt(s), what an egg's place loses in certainty unseen
  double min_score = 0.3;           ///< weaker detections are ignored
  double forget_after = 20.0;       ///< s without sighting until an unconfirmed track is dropped
  double absorb_after_pick = 15.0;  ///< s in which sightings at a picked egg's place are its echo

  void describe(config::Fields& fields);
};

/// A sighting, projected onto the floor of the map.
struct Sighting {
  Eigen::Vector2d egg_in_map{0, 0};
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< m^2
  double score = 1.0;
};

struct EggTrack {
  std::string id;
  Eigen::Vector2d egg_in_map{0, 0};
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();
  int sightings = 0;
  bool confirmed = false;
  bool picked = false;
  Time last_seen{};
  Time picked_at{};

  [[nodiscard]] double stddev() const;  ///< m, of the worse direction
};

/// Eggs lie still: each track is a Kalman filter of a constant position. Sightings are matched
/// nearest first within a gate, tracks that come close are merged, picked ones absorb their echo
/// for a while and then let a new egg in their place count anew.
class EggTracks {
 public:
  explicit EggTracks(const EggTracksConfig& config) : config_(config) {}

  void update(const std::vector<Sighting>& sightings, Time now);
  void mark_picked(const std::string& id, Time now);
  /// Takes in an egg known from before (a journal).
  void restore(EggTrack track);

  [[nodiscard]] const std::vector<EggTrack>& tracks() const { return tracks_; }
  [[nodiscard]] const EggTrack* find(const std::string& id) const;

 private:
  void grow(Time now);
  [[nodiscard]] EggTrack* match(const Sighting& sighting, const Eigen::Matrix2d& noise, Time now);
  void merge_close();

  EggTracksConfig config_;
  std::vector<EggTrack> tracks_;
  Time last_update_{};
  int next_id_ = 1;
};

}  // namespace coop::sequencer
