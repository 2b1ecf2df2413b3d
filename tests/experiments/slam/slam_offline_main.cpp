// slam_offline LOG.clf [-o DIR] [--relations FILE] [--particles N] [--seed S] [--threads T]
//              [--interpolate-odometry] [--config FILE] [--set key=value]...
// Maps a CARMEN log without any middleware, for measurements. DIR gets map.pgm, map.yaml,
// trajectory.txt and the poses at the scans used: scan_odometry.txt and scan_poses.txt.
#include <chrono>
#include <exception>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "core/atomic_file.hpp"
#include "core/carmen/carmen_log.hpp"
#include "core/config/config.hpp"
#include "core/map/map_file.hpp"
#include "experiments/slam/relations.hpp"
#include "slam/particle_filter.hpp"
#include "slam/trajectory_file.hpp"

namespace {

using namespace coop;

struct Arguments {
  std::string log;
  std::string folder;
  std::string relations;
  std::uint64_t seed = 1;
  int threads = 2;
  bool interpolate_odometry = false;  ///< the scans' own odometry is ignored
  config::Document document;
};

Arguments parse(int argc, char** argv) {
  Arguments arguments;
  std::vector<std::string> assignments;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const auto value = [&] {
      if (++i >= argc) throw std::runtime_error("expected a value after " + word);
      return std::string(argv[i]);
    };
    if (word == "-o")
      arguments.folder = value();
    else if (word == "--relations")
      arguments.relations = value();
    else if (word == "--seed")
      arguments.seed = std::stoull(value());
    else if (word == "--interpolate-odometry")
      arguments.interpolate_odometry = true;
    else if (word == "--threads")
      arguments.threads = std::stoi(value());
    else if (word == "--particles")
      assignments.push_back("particles=" + value());
    else if (word == "--set")
      assignments.push_back(value());
    else if (word == "--config")
      arguments.document = config::Document::load(value());
    else if (arguments.log.empty() && word[0] != '-')
      arguments.log = word;
    else
      throw std::runtime_error("unknown argument " + word);
  }
  if (arguments.log.empty())
    throw std::runtime_error(
        "usage: slam_offline LOG.clf [-o DIR] [--relations FILE] [--particles N] [--seed S] "
        "[--threads T] [--interpolate-odometry] [--config FILE] [--set key=value]...");
  for (const auto& assignment : assignments) arguments.document.set(assignment);
  return arguments;
}

struct Run {
  std::vector<StampedPose2> odometry;      ///< of ODOM lines
  std::vector<StampedPose2> all_odometry;  ///< and of the lasers' own
  std::size_t scans = 0;
  std::size_t used = 0;
  std::size_t resamplings = 0;
};

Run process(const std::vector<carmen::Record>& records, bool interpolate_odometry,
            slam::ParticleFilter& filter) {
  Run run;
  for (const auto& record : records) {
    if (const auto* odometry = std::get_if<carmen::OdometryRecord>(&record)) {
      run.odometry.push_back({odometry->stamp, odometry->robot_in_odom});
    }
  }
  for (const auto& record : records) {
    if (const auto* odometry = std::get_if<carmen::OdometryRecord>(&record)) {
      run.all_odometry.push_back({odometry->stamp, odometry->robot_in_odom});
    } else if (const auto* laser = std::get_if<carmen::LaserRecord>(&record)) {
      const Pose2 base_in_odom = interpolate_odometry
                                     ? experiments::pose_at(run.odometry, laser->stamp)
                                     : laser->robot_in_odom;
      run.all_odometry.push_back({laser->stamp, base_in_odom});
      const auto outcome =
          filter.update(carmen::to_scan(*laser, "laser_link"), base_in_odom, Pose2{});
      ++run.scans;
      run.used += outcome.used ? 1 : 0;
      run.resamplings += outcome.resampled ? 1 : 0;
    }
  }
  return run;
}

}  // namespace

int main(int argc, char** argv) try {
  Arguments arguments = parse(argc, argv);
  const auto config = arguments.document.read<slam::SlamConfig>();
  auto records = carmen::read_log(arguments.log);
  carmen::sort_by_stamp(records);
  slam::ForkJoin workers(arguments.threads);
  slam::ParticleFilter filter(config, arguments.seed, workers);
  const auto start = std::chrono::steady_clock::now();
  const Run run = process(records, arguments.interpolate_odometry, filter);
  const double took =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const auto nodes = filter.trajectory();
  const double recorded =
      run.all_odometry.empty()
          ? 0.0
          : to_seconds(run.all_odometry.back().stamp - run.all_odometry.front().stamp);
  std::cout << "seed " << arguments.seed << ": " << run.used << " of " << run.scans << " scans, "
            << run.resamplings << " resamplings, " << took << " s, " << recorded / took << " x\n";
  const auto trajectory = slam::interpolate_trajectory(nodes, run.odometry);
  if (!arguments.relations.empty()) {
    const auto relations =
        experiments::parse_relations(read_file(arguments.relations), arguments.relations);
    std::cout << "  odometry stamps:       "
              << to_text(experiments::relations_error(relations, trajectory)) << '\n';
    const auto all = slam::interpolate_trajectory(nodes, run.all_odometry);
    std::cout << "  and the scans' stamps: "
              << to_text(experiments::relations_error(relations, all)) << '\n';
  }
  if (!arguments.folder.empty()) {
    const std::filesystem::path folder = arguments.folder;
    map::save_map(filter.map(), folder / "map");
    write_file_atomically(folder / "trajectory.txt", slam::to_text(trajectory));
    std::vector<StampedPose2> odometry_nodes;
    std::vector<StampedPose2> map_nodes;
    for (const auto& node : nodes) {
      odometry_nodes.push_back({node.stamp, node.base_in_odom});
      map_nodes.push_back({node.stamp, node.base_in_map});
    }
    write_file_atomically(folder / "scan_odometry.txt", slam::to_text(odometry_nodes));
    write_file_atomically(folder / "scan_poses.txt", slam::to_text(map_nodes));
  }
  return 0;
} catch (const std::exception& error) {
  std::cerr << "slam_offline: " << error.what() << '\n';
  return 1;
}
