#pragma once
#include <string>

#include "core/pose.hpp"
#include "core/time.hpp"

namespace coop {

/// Something that was true at a time, expressed in a frame.
template <class T>
struct Stamped {
  Time stamp{};
  std::string frame_id;
  T value{};
};

/// Where a frame lies in its parent at a time.
struct StampedTransform {
  Time stamp{};
  std::string parent;
  std::string child;
  Pose3 child_in_parent = Pose3::Identity();
};

}  // namespace coop
