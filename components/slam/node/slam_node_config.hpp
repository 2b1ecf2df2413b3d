#pragma once
#include <string>

#include "core/config/fields.hpp"
#include "core/odometry_track.hpp"
#include "slam/particle_filter.hpp"

namespace coop::slam {

struct SlamNodeConfig {
  std::string save_path;    ///< map at exit: <path>.pgm, .yaml, _trajectory.txt; empty: not saved
  int threads = 2;          ///< that share the particles; the result does not depend on it
  double map_period = 1.0;  ///< s between maps
  double transform_period = 0.05;    ///< s between map -> odom
  double transform_tolerance = 0.1;  ///< s that map -> odom is dated ahead
  double scan_timeout = 2.0;         ///< s without a scan until degraded; 0: never
  double odometry_patience =
      2.0;  ///< s a scan waits for its odometry; with reliable streams: for ever
  std::string session = "slam.session";  ///< in the run's folder: map and pose; empty: none
  double session_period = 3.0;           ///< s between two sessions written
  double session_age = 600.0;            ///< s, an older session is not gone on with
  bool resume = true;                    ///< go on from the session that is there
  OdometryRestart odometry_restart;
  SlamConfig slam;

  void describe(config::Fields& fields);
};

}  // namespace coop::slam
