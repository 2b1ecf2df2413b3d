#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <nlohmann/json.hpp>

#include "capture/node/command_line.hpp"
#include "capture/node/tool.hpp"
#include "capture/traffic/frame_tree.hpp"
#include "conversions/geometry.hpp"
#include "core/transform_buffer.hpp"
#include "tf2_msgs/msg/TFMessage.h"

namespace coop::capture {
namespace {

struct TfArguments {
  ToolOptions options;
  double seconds_heard = 2.0;
  std::string parent;
  std::string child;
  std::int64_t count = 0;
};

bool is_tf(const std::string& topic) {
  return topic == "/tf" || topic == "/tf_static";
}

/// Calls back for every transform of a message.
template <class Callback>
void for_each_transform(const HeardSample& heard, Callback callback) {
  tf2_msgs::msg::TFMessage message;
  if (!runtime::from_wire(heard.sample.bytes, message)) return;
  const auto transforms = conversions::from_msg(message);
  if (!transforms) {
    std::cerr << heard.writer->participant << ": " << transforms.error() << '\n';
    return;
  }
  for (const StampedTransform& transform : *transforms) {
    callback(transform, heard.writer->topic.name == "rt/tf_static");
  }
}

std::string tree_json(const FrameTree& tree, Time now) {
  nlohmann::ordered_json frames = nlohmann::ordered_json::array();
  for (const auto& [child, frame] : tree.frames()) {
    frames.push_back({{"frame", child},
                      {"parent", frame.parent},
                      {"static", frame.is_static},
                      {"rate", frame.rate()},
                      {"age", to_seconds(now - frame.arrival)},
                      {"publishers", frame.publishers}});
  }
  return nlohmann::ordered_json{{"frames", frames}, {"complaints", tree.complaints()}}.dump();
}

int show_tree(const TfArguments& arguments) {
  ToolLoop loop;
  FrameTree tree;
  const TopicListener listener(
      loop, arguments.options.dds("tf"), is_tf, [&](const HeardSample& heard) {
        for_each_transform(heard, [&](const StampedTransform& transform, bool is_static) {
          tree.add(transform.parent, transform.child, is_static, transform.stamp,
                   heard.sample.reception_time, heard.writer->participant);
        });
      });
  loop.executor().call_at(runtime::Executor::Wall::now() + seconds(arguments.seconds_heard),
                          [&loop] { loop.finish(); });
  loop.run();
  if (arguments.options.json) {
    std::cout << tree_json(tree, loop.now()) << '\n';
    return 0;
  }
  if (tree.frames().empty()) {
    std::cerr << "no transforms within " << arguments.seconds_heard << " s\n";
    return 1;
  }
  std::cout << tree.text(loop.now());
  for (const std::string& complaint : tree.complaints()) std::cout << "! " << complaint << '\n';
  return 0;
}

std::string pose_text(const Pose3& pose, Time stamp, bool json) {
  const Eigen::Vector3d p = pose.translation();
  const Eigen::Quaterniond q(pose.rotation());
  const double yaw = std::atan2(2.0 * (q.w() * q.z() + q.x() * q.y()),
                                1.0 - 2.0 * (q.y() * q.y() + q.z() * q.z()));
  if (json) {
    return fmt::format(
        R"({{"stamp": {:.9f}, "x": {}, "y": {}, "z": {}, "qx": {}, "qy": {}, "qz": {}, "qw": {}, "yaw": {}}})",
        to_seconds(stamp), p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w(), yaw);
  }
  return fmt::format(
      "at {:.3f}: x {:.3f}, y {:.3f}, z {:.3f} m; quaternion x {:.4f}, y {:.4f}, z {:.4f}, w "
      "{:.4f}; yaw {:.4f} rad",
      to_seconds(stamp), p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w(), yaw);
}

/// The newest transform, whenever there is a newer one.
int echo_transform(const TfArguments& arguments) {
  ToolLoop loop;
  TransformBuffer buffer;
  std::optional<Time> shown;
  std::int64_t left = arguments.count;
  TransformError problem = TransformError::kUnknownFrame;
  const auto show = [&] {
    const auto stamp = buffer.newest_stamp(arguments.parent, arguments.child);
    if (!stamp) problem = stamp.error();
    if (!stamp || shown == *stamp || (arguments.count > 0 && left <= 0)) return;
    // Time::max(): all between is static.
    const auto pose = buffer.lookup(arguments.parent, arguments.child, *stamp);
    if (!pose) return;
    shown = *stamp;
    std::cout << pose_text(*pose, *stamp == Time::max() ? Time{} : *stamp, arguments.options.json)
              << std::endl;
    if (arguments.count > 0 && --left == 0) loop.finish();
  };
  const TopicListener listener(
      loop, arguments.options.dds("tf"), is_tf, [&](const HeardSample& heard) {
        for_each_transform(heard, [&](const StampedTransform& transform, bool is_static) {
          if (is_static) {
            buffer.insert_static(transform.parent, transform.child, transform.child_in_parent);
          } else {
            buffer.insert(transform.parent, transform.child, transform.stamp,
                          transform.child_in_parent);
          }
        });
        show();
      });
  loop.executor().call_at(runtime::Executor::Wall::now() + std::chrono::seconds(3), [&] {
    if (shown) return;
    std::cerr << arguments.child << " in " << arguments.parent << ": " << to_string(problem)
              << "; waits" << std::endl;
  });
  loop.run();
  return 0;
}

}  // namespace
}  // namespace coop::capture

int main(int argc, char** argv) {
  using namespace coop::capture;
  CLI::App app{"looks at the frames of a running system", "tf"};
  app.require_subcommand(1);
  TfArguments arguments;
  int code = 0;
  CLI::App* tree =
      app.add_subcommand("tree", "frames, who publishes them, what is wrong with them");
  arguments.options.describe(*tree);
  tree->add_option("--seconds", arguments.seconds_heard, "listen so long")
      ->check(CLI::Range(0.1, 3600.0));
  tree->callback([&] { code = show_tree(arguments); });
  CLI::App* echo = app.add_subcommand("echo", "where CHILD is in PARENT");
  arguments.options.describe(*echo);
  echo->add_option("parent", arguments.parent, "frame")->required();
  echo->add_option("child", arguments.child, "frame")->required();
  echo->add_option("--count", arguments.count, "end after so many");
  echo->callback([&] { code = echo_transform(arguments); });
  const int parsed = parse_or_exit_code(app, argc, argv);
  return parsed == kGoOn ? code : parsed;
}
