#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "sweep/statistics.hpp"

namespace coop::sweep {

/// Values over named places, joined by a line, each with its interval.
struct Series {
  std::string name;
  std::vector<Estimate> values;  ///< one for each place; count 0: a gap
};

struct LinePlot {
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<std::string> places;  ///< along x; numbers lie where they belong, else evenly
  std::vector<Series> series;
};

/// Points around a rectangle, drawn to one scale in both directions.
struct ScatterPlot {
  struct Group {
    std::string name;
    std::string colour;  ///< as SVG has it
    std::vector<Eigen::Vector2d> points;
  };
  std::string title;
  std::string x_label;
  std::string y_label;
  Eigen::Vector2d half_box{0, 0};  ///< rectangle around the origin
  std::vector<Group> groups;
};

struct BarPlot {
  struct Bar {
    std::string name;
    double value = 0.0;
  };
  std::string title;
  std::string x_label;
  std::vector<Bar> bars;
};

/// Each a whole SVG document.
[[nodiscard]] std::string draw(const LinePlot& plot);
[[nodiscard]] std::string draw(const ScatterPlot& plot);
[[nodiscard]] std::string draw(const BarPlot& plot);

/// Round numbers that divide the range from `low` to `high` into at most `most` parts, both ends
/// covered. high > low.
[[nodiscard]] std::vector<double> ticks_for(double low, double high, int most);

}  // namespace coop::sweep
