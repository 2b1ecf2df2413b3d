#include "capture/traffic/frame_tree.hpp"

#include <algorithm>
#include <cstdio>

namespace coop::capture {
namespace {

std::string joined(const std::set<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ", ") + name;
  return out;
}

}  // namespace

double FrameTree::Frame::rate() const {
  const double elapsed = to_seconds(arrival - first);
  return is_static || count < 2 || elapsed <= 0.0 ? 0.0 : static_cast<double>(count - 1) / elapsed;
}

void FrameTree::add(const std::string& parent, const std::string& child, bool is_static, Time stamp,
                    Time arrival, const std::string& publisher) {
  Frame& frame = frames_[child];
  if (frame.count == 0) frame.first = arrival;
  frame.parent = parent;
  frame.publishers.insert(publisher);
  frame.is_static = is_static;
  frame.stamp = std::max(frame.stamp, stamp);
  frame.arrival = arrival;
  ++frame.count;
  parents_[child].insert(parent);
}

std::vector<std::string> FrameTree::roots() const {
  std::set<std::string> found;
  for (const auto& [child, frame] : frames_) {
    if (!frames_.contains(frame.parent)) found.insert(frame.parent);
  }
  return {found.begin(), found.end()};
}

std::vector<std::string> FrameTree::children_of(const std::string& parent) const {
  std::vector<std::string> children;
  for (const auto& [child, frame] : frames_) {
    if (frame.parent == parent) children.push_back(child);
  }
  return children;
}

std::vector<std::string> FrameTree::complaints() const {
  std::vector<std::string> out;
  const auto tops = roots();
  if (tops.size() > 1) {
    out.push_back("not one tree: roots " + joined({tops.begin(), tops.end()}));
  }
  for (const auto& [child, frame] : frames_) {
    if (frame.publishers.size() > 1) {
      out.push_back(child + " has several publishers: " + joined(frame.publishers));
    }
    const auto& parents = parents_.at(child);
    if (parents.size() > 1) out.push_back(child + " has several parents: " + joined(parents));
    std::string above = frame.parent;
    for (std::size_t i = 0; i <= frames_.size(); ++i) {
      if (above == child) {
        out.push_back(child + " is above itself");
        break;
      }
      const auto next = frames_.find(above);
      if (next == frames_.end()) break;
      above = next->second.parent;
    }
  }
  return out;
}

void FrameTree::draw(const std::string& frame, const std::string& indent, Time now,
                     std::set<std::string>& drawn, std::string& out) const {
  out += indent + frame;
  const auto found = frames_.find(frame);
  if (found != frames_.end()) {
    const Frame& known = found->second;
    char facts[128];
    if (known.is_static) {
      std::snprintf(facts, sizeof facts, "static");
    } else {
      std::snprintf(facts, sizeof facts, "%.1f Hz, %.2f s old", known.rate(),
                    to_seconds(now - known.arrival));
    }
    out += std::string("  (") + facts + ", by " + joined(known.publishers) + ")";
  }
  out += "\n";
  if (!drawn.insert(frame).second) return;
  for (const std::string& child : children_of(frame)) draw(child, indent + "  ", now, drawn, out);
}

std::string FrameTree::text(Time now) const {
  std::string out;
  std::set<std::string> drawn;
  for (const std::string& root : roots()) draw(root, "", now, drawn, out);
  return out;
}

}  // namespace coop::capture
