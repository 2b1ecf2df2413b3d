#pragma once
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/time.hpp"

namespace coop::capture {

/// The tree of frames as tf and tf_static tell it, for people: who publishes each, how often, and
/// what is wrong with it.
class FrameTree {
 public:
  struct Frame {
    std::string parent;
    std::set<std::string> publishers;
    std::uint64_t count = 0;
    bool is_static = false;
    Time stamp{};    ///< of the newest transform
    Time first{};    ///< arrival of the first
    Time arrival{};  ///< of the newest

    /// Hz; 0 where it is static or came once.
    [[nodiscard]] double rate() const;
  };

  void add(const std::string& parent, const std::string& child, bool is_static, Time stamp,
           Time arrival, const std::string& publisher);

  /// By child.
  [[nodiscard]] const std::map<std::string, Frame>& frames() const { return frames_; }
  /// Frames that are nobody's child.
  [[nodiscard]] std::vector<std::string> roots() const;
  [[nodiscard]] std::vector<std::string> children_of(const std::string& parent) const;
  /// Several roots, two publishers of one frame, two parents, a frame above itself.
  [[nodiscard]] std::vector<std::string> complaints() const;
  /// One line a frame, indented. Ages are told at `now`.
  [[nodiscard]] std::string text(Time now) const;

 private:
  void draw(const std::string& frame, const std::string& indent, Time now,
            std::set<std::string>& drawn, std::string& out) const;

  std::map<std::string, Frame> frames_;
  std::map<std::string, std::set<std::string>> parents_;  ///< all ever told of a child
};

}  // namespace coop::capture
