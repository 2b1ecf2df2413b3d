#pragma once
#include <string>
#include <vector>

#include "core/robot/robot_model.hpp"

namespace coop::robot {

/// Links and joints of a URDF, depth first from the root: what RobotModel is built from.
struct UrdfTree {
  std::string name;
  std::vector<Link> links;
  std::vector<Joint> joints;
};

/// Parses and checks. Throws config::Error with one line that starts with `source`.
[[nodiscard]] UrdfTree read_urdf(const std::string& urdf, const std::string& source);

}  // namespace coop::robot
