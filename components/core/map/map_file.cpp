#include "core/map/map_file.hpp"

#include <array>
#include <cmath>
#include <cstdio>

#include "core/atomic_file.hpp"
#include "core/config/config.hpp"
#include "core/config/error.hpp"

namespace coop::map {
namespace {

constexpr std::uint16_t kOccupiedPixel = 0;
constexpr std::uint16_t kFreePixel = 254;
constexpr std::uint16_t kUnknownPixel = 205;

std::int8_t trinary(double darkness, const MapMetadata& metadata) {
  if (darkness > metadata.occupied_thresh) return kOccupied;
  if (darkness < metadata.free_thresh) return kFree;
  return kUnknown;
}

std::int8_t scaled(double darkness, const MapMetadata& metadata) {
  if (darkness > metadata.occupied_thresh) return kOccupied;
  if (darkness < metadata.free_thresh) return kFree;
  const double span = metadata.occupied_thresh - metadata.free_thresh;
  const double ratio = span > 0.0 ? (darkness - metadata.free_thresh) / span : 0.0;
  return static_cast<std::int8_t>(std::lround(1.0 + 98.0 * ratio));
}

std::int8_t occupancy(std::uint16_t pixel, int max_value, const MapMetadata& metadata) {
  if (metadata.mode == "raw") return pixel <= 100 ? static_cast<std::int8_t>(pixel) : kUnknown;
  const double brightness = static_cast<double>(pixel) / max_value;
  const double darkness = metadata.negate != 0 ? brightness : 1.0 - brightness;
  return metadata.mode == "scale" ? scaled(darkness, metadata) : trinary(darkness, metadata);
}

std::string number_text(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.9g", value);
  return text.data();
}

}  // namespace

void MapMetadata::describe(config::Fields& fields) {
  static constexpr std::array<std::string_view, 3> kModes{"trinary", "scale", "raw"};
  fields.text("image", image, {.help = "image file, beside this file or absolute"});
  fields.choice("mode", mode, kModes, {.help = "how a pixel becomes occupancy"});
  fields.number("resolution", resolution,
                {.unit = "m", .help = "side of a pixel", .min = 1e-4, .max = 100.0});
  fields.numbers("origin", origin,
                 {.unit = "m, m, rad", .help = "lower left corner; yaw must be 0"});
  fields.integer("negate", negate, {.help = "1: white is occupied", .min = 0, .max = 1});
  fields.number("occupied_thresh", occupied_thresh,
                {.help = "occupied above this darkness", .min = 0.0, .max = 1.0});
  fields.number("free_thresh", free_thresh,
                {.help = "free below this darkness", .min = 0.0, .max = 1.0});
}

void MapMetadata::validate() const {
  if (image.empty()) throw config::Error("image: expected the name of an image file");
  if (origin.size() != 3) throw config::Error("origin: expected three numbers: x, y, yaw");
  if (origin[2] != 0.0)
    throw config::Error("origin: a map turned by a yaw other than 0 is not supported");
  if (free_thresh > occupied_thresh)
    throw config::Error("free_thresh: expected at most occupied_thresh");
}

OccupancyGrid to_grid(const GreyImage& image, const MapMetadata& metadata) {
  OccupancyGrid grid(
      {image.width, image.height, metadata.resolution, {metadata.origin[0], metadata.origin[1]}},
      kUnknown);
  for (int row = 0; row < image.height; ++row) {
    for (int x = 0; x < image.width; ++x) {
      const auto pixel =
          image.pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
                       static_cast<std::size_t>(x)];
      grid[{x, image.height - 1 - row}] = occupancy(pixel, image.max_value, metadata);
    }
  }
  return grid;
}

GreyImage to_image(const OccupancyGrid& grid) {
  GreyImage image{grid.geometry.width, grid.geometry.height, 255, {}};
  image.pixels.reserve(grid.geometry.size());
  for (int y = grid.geometry.height - 1; y >= 0; --y) {
    for (int x = 0; x < grid.geometry.width; ++x) {
      const std::int8_t value = grid[{x, y}];
      image.pixels.push_back(value < 0     ? kUnknownPixel
                             : value >= 65 ? kOccupiedPixel
                             : value <= 25 ? kFreePixel
                                           : kUnknownPixel);
    }
  }
  return image;
}

OccupancyGrid load_map(const std::filesystem::path& yaml_path) {
  const auto document = config::Document::load(yaml_path);
  MapMetadata metadata;
  try {
    document.read(metadata);
  } catch (const config::Error& error) {
    const std::string message = error.what();
    if (message.find(yaml_path.string()) != std::string::npos) throw;
    throw config::Error(yaml_path.string() + ": " + message);  // validate() knows no file
  }
  const std::filesystem::path image_path = yaml_path.parent_path() / metadata.image;
  return to_grid(parse_pgm(read_file(image_path), image_path.string()), metadata);
}

std::filesystem::path stem_of(const std::filesystem::path& path) {
  std::filesystem::path stem = path;
  if (stem.extension() == ".yaml" || stem.extension() == ".pgm") stem.replace_extension();
  return stem;
}

void save_map(const OccupancyGrid& grid, const std::filesystem::path& path) {
  const std::string stem = stem_of(path).string();
  const auto with_suffix = [&](const char* suffix) { return std::filesystem::path(stem + suffix); };
  MapMetadata metadata;
  metadata.image = with_suffix(".pgm").filename().string();
  metadata.resolution = grid.geometry.resolution;
  metadata.origin = {grid.geometry.origin.x(), grid.geometry.origin.y(), 0.0};
  // The darkness of an unknown pixel, 50 / 255, must not count as free when the map is read again.
  metadata.free_thresh = 0.196;
  write_file_atomically(
      with_suffix(".pgm"),
      to_pgm(to_image(grid), "occupancy grid, " + number_text(metadata.resolution) + " m a pixel"));
  write_file_atomically(with_suffix(".yaml"), config::to_yaml(metadata));
}

}  // namespace coop::map
