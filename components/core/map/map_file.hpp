#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/config/fields.hpp"
#include "core/grid.hpp"
#include "core/map/grey_image.hpp"

namespace coop::map {

/// The YAML half of a map in the format of ROS's map_server.
struct MapMetadata {
  std::string image;         ///< beside the YAML file, or absolute
  double resolution = 0.05;  ///< m a pixel
  std::vector<double> origin{0, 0,
                             0};  ///< x m, y m of the image's lower left corner; yaw rad, must be 0
  int negate = 0;                 ///< 1: white is occupied
  double occupied_thresh = 0.65;  ///< occupied above this
  double free_thresh = 0.25;      ///< free below this
  std::string mode = "trinary";   ///< trinary, scale or raw
  void describe(config::Fields& fields);
  void validate() const;  ///< throws config::Error
};

/// Occupancy from an image as map_server does. With p the darkness of the pixel in [0, 1]
/// (brightness if negate): trinary: p > occupied_thresh is 100, p < free_thresh is 0, else unknown.
/// scale: between the thresholds linear from 1 to 99. raw: the pixel's value up to 100, above it
/// unknown.
[[nodiscard]] OccupancyGrid to_grid(const GreyImage& image, const MapMetadata& metadata);
/// Trinary image of a grid: 0 where occupied (>= 65 %), 254 where free (<= 25 %), 205 elsewhere.
[[nodiscard]] GreyImage to_image(const OccupancyGrid& grid);

/// Reads YAML and image. Throws config::Error (YAML: file, line, key), std::system_error (file
/// missing) or MapError.
[[nodiscard]] OccupancyGrid load_map(const std::filesystem::path& yaml_path);

/// The path without a trailing `.yaml` or `.pgm`.
[[nodiscard]] std::filesystem::path stem_of(const std::filesystem::path& path);

/// Writes `stem`.pgm and then `stem`.yaml, each atomically: who finds the YAML finds the image.
/// `path` is the stem, or either file. Throws std::system_error.
void save_map(const OccupancyGrid& grid, const std::filesystem::path& path);

}  // namespace coop::map
