#pragma once
#include <cstdint>
#include <numbers>
#include <string_view>

/// Sizes of what stands in a simulated world. The simulator, the lidar's and the camera's
/// simulation backends share them, so that what is seen is what is touched.
namespace coop::world {

/// Height of every occupied cell of the world's grid (walls, nest boxes, posts), m. Laser and
/// camera see them as blocks.
inline constexpr double kObstacleHeight = 0.60;
/// Height of an animal, a vertical cylinder, m.
inline constexpr double kAnimalHeight = 0.40;

/// Height of a heap of manure, m: no obstacle for laser or wheels.
inline constexpr double kHeapHeight = 0.04;

/// A duck egg is an ellipsoid of revolution that lies on its side: its long axis is horizontal.
/// Half axes in metres; mean of Pekin duck eggs, 62 mm x 45 mm.
inline constexpr double kEggHalfLength = 0.031;
inline constexpr double kEggHalfWidth = 0.0225;

/// Direction of the long axis of the egg of that name, radians in [0, pi): fixed by the name, so
/// that everybody who draws or touches the egg agrees without a field on the wire.
[[nodiscard]] constexpr double egg_heading(std::string_view id) {
  std::uint32_t hash = 2166136261U;  // FNV-1a
  for (const char c : id) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
  return std::numbers::pi * static_cast<double>(hash % 1024U) / 1024.0;
}

}  // namespace coop::world
