// relations_metric TRAJECTORY RELATIONS: error of a trajectory file by the relations metric.
#include <exception>
#include <iostream>

#include "core/atomic_file.hpp"
#include "experiments/slam/relations.hpp"
#include "slam/trajectory_file.hpp"

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::cerr << "usage: relations_metric TRAJECTORY RELATIONS\n";
    return 2;
  }
  const auto trajectory = coop::slam::parse_trajectory(coop::read_file(argv[1]), argv[1]);
  const auto relations = coop::experiments::parse_relations(coop::read_file(argv[2]), argv[2]);
  if (trajectory.empty()) throw std::runtime_error(std::string(argv[1]) + ": holds no pose");
  std::cout << to_text(coop::experiments::relations_error(relations, trajectory)) << '\n';
  return 0;
} catch (const std::exception& error) {
  std::cerr << "relations_metric: " << error.what() << '\n';
  return 1;
}
