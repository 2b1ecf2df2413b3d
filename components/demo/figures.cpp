#include "demo/figures.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace coop::demo {
namespace {

ErrorFigures summarize(std::vector<double> errors) {
  if (errors.empty()) return {};
  std::ranges::sort(errors);
  const auto last = static_cast<double>(errors.size() - 1);
  return {std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size()),
          errors[static_cast<std::size_t>(std::lround(0.95 * last))], errors.back()};
}

int count_done(const Record& record) {
  return static_cast<int>(std::ranges::count_if(record.targets, is_done));
}

}  // namespace

Figures compute_figures(const Record& record) {
  Figures figures;
  figures.targets_done = count_done(record);
  figures.targets_failed =
      static_cast<int>(std::ranges::count(record.targets, "failed", &TargetRecord::state));
  const auto& track = record.track;
  if (track.empty()) return figures;
  figures.duration = to_seconds(track.back().stamp - track.front().stamp);
  std::vector<double> position_errors;
  std::vector<double> heading_errors;
  for (std::size_t i = 0; i < track.size(); ++i) {
    const TrackPoint& point = track[i];
    if (i > 0) figures.distance_driven += distance(track[i - 1].truth_in_map, point.truth_in_map);
    position_errors.push_back(distance(point.truth_in_map, point.estimate_in_map));
    heading_errors.push_back(
        std::abs(angle_difference(point.truth_in_map.yaw, point.estimate_in_map.yaw)));
  }
  if (figures.duration > 0) figures.mean_speed = figures.distance_driven / figures.duration;
  figures.position_error = summarize(std::move(position_errors));
  figures.heading_error = summarize(std::move(heading_errors));
  return figures;
}

bool is_success(const Record& record) {
  return record.mission_state == "done" && record.targets_in_world > 0 && record.collisions == 0 &&
         record.targets_taken == record.targets_in_world &&
         count_done(record) == record.targets_in_world;
}

bool is_clean(const Record& record) {
  return record.mission_state == "done" && record.collisions == 0 &&
         record.targets_taken == record.targets_in_world &&
         count_done(record) == static_cast<int>(record.targets.size());
}

}  // namespace coop::demo
