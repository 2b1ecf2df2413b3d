#pragma once
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "experiments/chaos/fault.hpp"

namespace coop::chaos {

struct ChaosOptions {
  int faults = 200;
  std::uint64_t seed = 1;
  double gap = 18.0;        ///< s of simulated time between two faults, on average
  double rate = 2.0;        ///< of simulated time
  double recovery = 30.0;   ///< s of wall time in which everything must be well again
  double mission = 2400.0;  ///< s of simulated time a mission may take
  /// Who is hit.
  std::vector<std::string> components{"simulator", "lidar_driver",   "camera_driver", "arm_driver",
                                      "amcl",      "global_planner", "dwa",           "sequencer"};
  std::vector<std::string> settings;  ///< further ones for the launcher
  std::filesystem::path out;          ///< faults.csv, report.md and what went wrong
};

/// One fault and what was seen of it.
struct Incident {
  int number = 0;
  int mission = 0;
  double simulated = 0.0;  ///< s
  Fault fault;
  std::optional<double> noticed;    ///< s of wall time until anything told of it
  std::optional<double> recovered;  ///< s of wall time from its end until all is well
  std::optional<double> braking;    ///< s of simulated time, where the robot had to stop and moved
  std::string seen;                 ///< what told of it first
  std::string wrong;                ///< which promise was broken; empty: none
};

struct ChaosResult {
  std::vector<Incident> incidents;
  std::vector<std::string> missions;  ///< one line each
  std::vector<std::string> wrong;     ///< empty: all promises were kept
  double simulated = 0.0;             ///< s, of all missions together
};

/// Missions one after another, with faults, until all have happened and the last mission is over.
[[nodiscard]] ChaosResult run_chaos(const ChaosOptions& options, std::ostream& log);

/// Tables for people, in Markdown.
[[nodiscard]] std::string report_of(const ChaosOptions& options, const ChaosResult& result);
[[nodiscard]] std::string csv_of(const ChaosResult& result);

}  // namespace coop::chaos
