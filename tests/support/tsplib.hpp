#pragma once
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "sequencer/cost_matrix.hpp"

namespace coop::test {

/// Distances of a TSPLIB file of type EUC_2D: rounded to whole numbers, as its optima are stated
/// (Reinelt 1995, TSPLIB 95). Throws std::runtime_error.
inline sequencer::CostMatrix load_tsplib(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  bool is_euclidean = false;
  while (std::getline(file, line) && line.find("NODE_COORD_SECTION") == std::string::npos) {
    if (line.find("EUC_2D") != std::string::npos) is_euclidean = true;
  }
  struct Place {
    double x, y;
  };
  std::vector<Place> places;
  while (std::getline(file, line)) {
    std::istringstream words(line);
    int number = 0;
    Place place{};
    if (!(words >> number >> place.x >> place.y)) break;
    places.push_back(place);
  }
  if (!is_euclidean || places.empty()) {
    throw std::runtime_error(path.string() + ": no TSPLIB file of type EUC_2D");
  }
  sequencer::CostMatrix costs(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t j = 0; j < places.size(); ++j) {
      costs.at(i, j) =
          std::floor(std::hypot(places[i].x - places[j].x, places[i].y - places[j].y) + 0.5);
    }
  }
  return costs;
}

}  // namespace coop::test
