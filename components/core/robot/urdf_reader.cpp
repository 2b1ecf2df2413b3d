#include "core/robot/urdf_reader.hpp"

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <set>

#include "core/config/error.hpp"

namespace coop::robot {
namespace {

/// urdfdom tells what is wrong only to console_bridge's global handler: keep its first error, print
/// nothing.
class FirstError : public console_bridge::OutputHandler {
 public:
  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR && text_.empty()) text_ = text;
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

std::string one_line(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

urdf::ModelInterfaceSharedPtr parse_quietly(const std::string& urdf, std::string& error) {
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  FirstError handler;
  console_bridge::useOutputHandler(&handler);
  urdf::ModelInterfaceSharedPtr model;
  try {
    model = urdf::parseURDF(urdf);
  } catch (const std::exception& exception) {
    error = exception.what();
  }
  console_bridge::restorePreviousOutputHandler();
  if (!handler.text().empty()) error = handler.text();
  error = one_line(error);
  return model;
}

Pose3 to_pose3(const urdf::Pose& pose) {
  Pose3 result = Pose3::Identity();
  result.translation() << pose.position.x, pose.position.y, pose.position.z;
  const urdf::Rotation& q = pose.rotation;
  result.linear() = Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized().toRotationMatrix();
  return result;
}

JointType to_type(const urdf::Joint& joint) {
  switch (joint.type) {
    case urdf::Joint::REVOLUTE:
      return JointType::kRevolute;
    case urdf::Joint::CONTINUOUS:
      return JointType::kContinuous;
    case urdf::Joint::PRISMATIC:
      return JointType::kPrismatic;
    case urdf::Joint::FLOATING:
      return JointType::kFloating;
    case urdf::Joint::PLANAR:
      return JointType::kPlanar;
    default:
      return JointType::kFixed;
  }
}

/// Reads one document; holds the name of the source for messages.
class Reader {
 public:
  Reader(const urdf::ModelInterface& model, const std::string& source)
      : model_(model), source_(source) {}

  UrdfTree read() {
    check_single_parents();
    tree_.name = model_.getName();
    visit(*model_.getRoot());
    if (tree_.links.size() != model_.links_.size()) refuse_detached();
    return std::move(tree_);
  }

 private:
  [[noreturn]] void refuse(const std::string& reason) const {
    throw config::Error(source_ + ": " + reason);
  }

  void check_single_parents() const {
    std::map<std::string, std::string> joint_of_child;
    for (const auto& [name, joint] : model_.joints_) {
      const auto [known, inserted] = joint_of_child.emplace(joint->child_link_name, name);
      if (!inserted) {
        refuse("link '" + joint->child_link_name + "' has two parents: joints '" + known->second +
               "' and '" + name + "'");
      }
    }
  }

  [[noreturn]] void refuse_detached() const {
    std::set<std::string> reached;
    for (const Link& link : tree_.links) reached.insert(link.name);
    for (const auto& [name, link] : model_.links_) {
      if (!reached.contains(name)) {
        refuse("link '" + name + "' is part of a loop that does not hang on the root link '" +
               tree_.links.front().name + "'");
      }
    }
    refuse("the links are no tree");
  }

  void visit(const urdf::Link& link) {
    tree_.links.push_back(to_link(link));
    for (const urdf::JointSharedPtr& joint : link.child_joints) {
      tree_.joints.push_back(to_joint(*joint));
      visit(*model_.getLink(joint->child_link_name));
    }
  }

  [[nodiscard]] Link to_link(const urdf::Link& link) const {
    Link result;
    result.name = link.name;
    for (const urdf::CollisionSharedPtr& part : link.collision_array) {
      if (part == nullptr || part->geometry == nullptr) continue;
      CollisionShape shape;
      shape.in_link = to_pose3(part->origin);
      if (const auto box = std::dynamic_pointer_cast<urdf::Box>(part->geometry)) {
        shape.size << box->dim.x, box->dim.y, box->dim.z;
      } else if (const auto tube = std::dynamic_pointer_cast<urdf::Cylinder>(part->geometry)) {
        shape.kind = CollisionShape::Kind::kCylinder;
        shape.size << 2.0 * tube->radius, 2.0 * tube->radius, tube->length;
      } else {
        continue;
      }
      if (!shape.in_link.matrix().allFinite() || !(shape.size.minCoeff() > 0.0) ||
          !shape.size.allFinite()) {
        refuse("link '" + link.name + "' has a collision shape that is not finite and positive");
      }
      result.collision.push_back(shape);
    }
    return result;
  }

  [[nodiscard]] Joint to_joint(const urdf::Joint& joint) const {
    Joint result;
    result.name = joint.name;
    result.type = to_type(joint);
    result.parent = joint.parent_link_name;
    result.child = joint.child_link_name;
    result.origin = to_pose3(joint.parent_to_joint_origin_transform);
    const bool has_axis = result.type == JointType::kRevolute ||
                          result.type == JointType::kContinuous ||
                          result.type == JointType::kPrismatic;
    if (has_axis) {
      result.axis = Eigen::Vector3d(joint.axis.x, joint.axis.y, joint.axis.z);
      if (!result.axis.allFinite() || result.axis.norm() < 1e-9) {
        refuse("joint '" + joint.name + "' has no axis");
      }
      result.axis.normalize();
    }
    if (joint.limits != nullptr) {
      result.max_velocity = joint.limits->velocity;
      result.max_effort = joint.limits->effort;
      if (result.type == JointType::kRevolute || result.type == JointType::kPrismatic) {
        result.lower = joint.limits->lower;
        result.upper = joint.limits->upper;
        if (!(result.lower <= result.upper)) {
          refuse("joint '" + joint.name + "' has its lower limit above its upper limit");
        }
      }
    }
    if (!result.origin.matrix().allFinite()) {
      refuse("joint '" + joint.name + "' has an origin that is not finite");
    }
    return result;
  }

  const urdf::ModelInterface& model_;
  const std::string& source_;
  UrdfTree tree_;
};

}  // namespace

UrdfTree read_urdf(const std::string& urdf, const std::string& source) {
  if (urdf.find_first_not_of(" \t\r\n") == std::string::npos) {
    throw config::Error(source + ": the file is empty, expected a URDF");
  }
  std::string error;
  const urdf::ModelInterfaceSharedPtr model = parse_quietly(urdf, error);
  if (model == nullptr || model->getRoot() == nullptr) {
    throw config::Error(source + ": " + (error.empty() ? "this is no valid URDF" : error));
  }
  return Reader(*model, source).read();
}

}  // namespace coop::robot
