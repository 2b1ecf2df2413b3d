#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/grid.hpp"
#include "core/pose.hpp"

/// Exact overlap of what stands on the floor: convex outlines, discs, and the squares of a grid's
/// occupied cells. Touching without overlap is no contact.
namespace coop::simulator {

/// Vertices of a convex outline placed at a pose.
void place(std::span<const Eigen::Vector2d> outline, const Pose2& pose,
           std::vector<Eigen::Vector2d>& placed);

/// Separating axes: the cell's sides and the outline's edges.
[[nodiscard]] bool outline_hits_grid(std::span<const Eigen::Vector2d> outline,
                                     const OccupancyGrid& grid);

/// Distance of a point from the convex, counter-clockwise outline, 0 within it.
[[nodiscard]] double distance_to_outline(std::span<const Eigen::Vector2d> outline,
                                         const Eigen::Vector2d& point);

[[nodiscard]] bool disc_hits_grid(const Eigen::Vector2d& center, double radius,
                                  const OccupancyGrid& grid);

/// Whether every cell that the disc touches is known to be free.
[[nodiscard]] bool disc_is_free(const Eigen::Vector2d& center, double radius,
                                const OccupancyGrid& grid);

}  // namespace coop::simulator
