#include "sequencer/egg_tracks.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace coop::sequencer {

void EggTracksConfig::describe(config::Fields& fields) {
  fields.integer("confirm_after", confirm_after,
                 {.help = "sightings until an egg counts", .min = 1, .max = 100});
  fields.number("gate", gate,
                {.help = "squared Mahalanobis distance of a match", .min = 1, .max = 100});
  fields.number("max_distance", max_distance,
                {.unit = "m", .help = "farther sightings are another egg", .min = 0.01, .max = 2});
  fields.number("merge_distance", merge_distance,
                {.unit = "m", .help = "nearer tracks are one egg", .min = 0, .max = 1});
  fields.number("min_stddev", min_stddev,
                {.unit = "m", .help = "no sighting is trusted more", .min = 0.001, .max = 1});
  fields.number("growth", growth,
                {.unit = "m/sqrt(s)", .help = "certainty lost while unseen", .min = 0, .max = 1});
  fields.number("min_score", min_score,
                {.help = "weaker detections are ignored", .min = 0, .max = 1});
  fields.number("forget_after", forget_after,
                {.unit = "s", .help = "life of an unconfirmed track", .min = 0.1, .max = 3600});
  fields.integer(
      "again_after", again_after,
      {.help = "pictures in a row with an egg where one was picked, until it is a new one",
       .min = 1,
       .max = 1000});
  fields.section("view", view);
}

double EggTrack::stddev() const {
  return std::sqrt(
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(covariance, Eigen::EigenvaluesOnly)
          .eigenvalues()
          .maxCoeff());
}

void EggTracks::grow(Time now) {
  if (last_update_ != Time{} && now > last_update_) {
    const double variance = config_.growth * config_.growth * to_seconds(now - last_update_);
    for (EggTrack& track : tracks_) track.covariance += variance * Eigen::Matrix2d::Identity();
  }
  last_update_ = now;
}

std::vector<Sighting> to_sightings(const std::vector<Detection>& detections,
                                   std::string_view class_id, const Pose3& camera_in_map) {
  std::vector<Sighting> sightings;
  for (const Detection& detection : detections) {
    if (detection.class_id != class_id) continue;
    const Eigen::Vector3d place = camera_in_map * detection.position;
    const Eigen::Matrix3d covariance =
        camera_in_map.linear() * detection.covariance * camera_in_map.linear().transpose();
    sightings.push_back({place.head<2>(), covariance.topLeftCorner<2, 2>(), detection.score});
  }
  return sightings;
}

EggTrack* EggTracks::match(const Sighting& sighting, const Eigen::Matrix2d& noise) {
  EggTrack* best = nullptr;
  double best_distance = config_.gate;
  for (EggTrack& track : tracks_) {
    if (track.replaced) continue;
    const Eigen::Vector2d gap = sighting.egg_in_map - track.egg_in_map;
    if (gap.norm() > config_.max_distance) continue;
    const Eigen::Matrix2d total = track.covariance + noise;
    const double squared = gap.dot(total.inverse() * gap);
    if (squared < best_distance) {
      best_distance = squared;
      best = &track;
    }
  }
  return best;
}

EggTrack& EggTracks::add(const Sighting& sighting, const Eigen::Matrix2d& noise) {
  EggTrack track;
  track.id = config_.name + std::to_string(next_id_++);
  track.egg_in_map = sighting.egg_in_map;
  track.covariance = noise;
  return tracks_.emplace_back(std::move(track));
}

void EggTracks::take(const Sighting& sighting, Time stamp) {
  if (sighting.score < config_.min_score || !sighting.egg_in_map.allFinite()) return;
  const Eigen::Matrix2d noise =
      sighting.covariance + config_.min_stddev * config_.min_stddev * Eigen::Matrix2d::Identity();
  EggTrack* track = match(sighting, noise);
  if (track == nullptr) {
    track = &add(sighting, noise);
  } else if (track->picked) {
    if (stamp <= track->picked_at) return;  // its echo
    if (track->seen_in_row + 1 >= config_.again_after) {
      track->replaced = true;
      track = &add(sighting, noise);
      track->confirmed = true;
    }
  } else {
    const Eigen::Matrix2d gain = track->covariance * (track->covariance + noise).inverse();
    track->egg_in_map += gain * (sighting.egg_in_map - track->egg_in_map);
    track->covariance = (Eigen::Matrix2d::Identity() - gain) * track->covariance;
  }
  track->sightings += 1;
  track->last_seen = stamp;
  track->confirmed = track->confirmed || track->sightings >= config_.confirm_after;
}

/// Pictures in a row with each egg, and without it.
void EggTracks::count(const Picture& picture) {
  for (EggTrack& track : tracks_) {
    if (track.last_seen == picture.stamp) {
      track.seen_in_row += 1;
      track.unseen_in_row = 0;
    } else if (picture.view &&
               picture.view->shows(track.egg_in_map, track.stddev(), config_.view)) {
      track.unseen_in_row += 1;
      track.seen_in_row = 0;
    } else if (picture.stamp - track.last_seen > seconds(config_.forget_after)) {
      track.seen_in_row = 0;
    }
  }
}

void EggTracks::update(const Picture& picture) {
  pictures_ += 1;
  grow(picture.stamp);
  for (const Sighting& sighting : picture.sightings) take(sighting, picture.stamp);
  count(picture);
  merge_close();
  std::erase_if(tracks_, [&](const EggTrack& track) {
    return !track.confirmed && picture.stamp - track.last_seen > seconds(config_.forget_after);
  });
}

void EggTracks::merge_close() {
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    for (std::size_t j = tracks_.size() - 1; j > i; --j) {
      EggTrack& older = tracks_[i];
      const EggTrack& newer = tracks_[j];
      const double gap = (older.egg_in_map - newer.egg_in_map).norm();
      // A confirmed track is never merged away: the mission may be on its way to it.
      if (older.picked || newer.picked || newer.confirmed || gap > config_.merge_distance) continue;
      older.sightings += newer.sightings;
      older.last_seen = std::max(older.last_seen, newer.last_seen);
      tracks_.erase(tracks_.begin() + static_cast<std::ptrdiff_t>(j));
    }
  }
}

void EggTracks::mark_picked(const std::string& id, Time now) {
  for (EggTrack& track : tracks_) {
    if (track.id != id) continue;
    track.picked = true;
    track.picked_at = now;
    track.seen_in_row = 0;
    track.unseen_in_row = 0;
  }
}

void EggTracks::restore(EggTrack track) {
  const std::string digits = track.id.substr(std::min(config_.name.size(), track.id.size()));
  if (!digits.empty() && std::ranges::all_of(digits, [](char c) { return c >= '0' && c <= '9'; })) {
    next_id_ = std::max(next_id_, std::stoi(digits) + 1);
  }
  track.confirmed = true;
  std::erase_if(tracks_, [&](const EggTrack& known) { return known.id == track.id; });
  tracks_.push_back(std::move(track));
}

const EggTrack* EggTracks::find(const std::string& id) const {
  const auto found = std::ranges::find(tracks_, id, &EggTrack::id);
  return found == tracks_.end() ? nullptr : &*found;
}

}  // namespace coop::sequencer
