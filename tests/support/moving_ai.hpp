#pragma once
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "core/search/grid_planner.hpp"

/// Maps and scenarios of the MovingAI benchmark (Sturtevant 2012).
namespace coop::test {

/// '.' and 'G' are free; cells of 1 m.
inline Grid<Cost> read_moving_ai_map(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string word;
  int width = 0;
  int height = 0;
  while (file >> word && word != "map") {
    if (word == "height") file >> height;
    if (word == "width") file >> width;
  }
  Grid<Cost> costs({width, height, 1.0, {0.0, 0.0}}, kLethalCost);
  for (int y = 0; y < height; ++y) {
    file >> word;
    for (int x = 0; x < width; ++x) {
      const char c = word[static_cast<std::size_t>(x)];
      if (c == '.' || c == 'G') costs[{x, y}] = kFreeCost;
    }
  }
  return costs;
}

struct Scenario {
  Cell start;
  Cell goal;
  double length = 0.0;     ///< of the optimal path
  double tolerance = 0.0;  ///< how exactly the file states it
};

/// The scenario files round to six digits, some to two decimals, and some lengths were summed in
/// single precision.
inline double tolerance_of(const std::string& number) {
  const std::size_t point = number.find('.');
  const double decimals =
      point == std::string::npos ? 0.0 : static_cast<double>(number.size() - point - 1);
  return 0.5 * std::pow(10.0, -std::max(2.0, decimals)) + 5e-6 * std::stod(number);
}

inline std::vector<Scenario> read_scenarios(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);  // the version
  std::vector<Scenario> scenarios;
  while (std::getline(file, line)) {
    std::istringstream fields(line);
    std::string bucket, map, length;
    int width = 0;
    int height = 0;
    Scenario scenario;
    fields >> bucket >> map >> width >> height >> scenario.start.x >> scenario.start.y >>
        scenario.goal.x >> scenario.goal.y >> length;
    if (!fields) continue;
    scenario.length = std::stod(length);
    scenario.tolerance = tolerance_of(length);
    scenarios.push_back(scenario);
  }
  return scenarios;
}

}  // namespace coop::test
