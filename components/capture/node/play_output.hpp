#pragma once
#include <memory>
#include <string>
#include <vector>

#include "capture/traffic/play_list.hpp"
#include "runtime/node.hpp"

namespace coop::capture {

/// Writers for the channels of a capture.
class PlayOutput {
 public:
  virtual ~PlayOutput() = default;
  /// Makes the writers of these channels, in this order.
  virtual void open(const std::vector<PlayChannel>& channels,
                    const std::vector<std::size_t>& order) = 0;
  /// False where a reader is too slow, or the bytes are no message.
  virtual bool write(const PlayMessage& message) = 0;
  /// Every reader that is there is matched, and somebody reads these topics (shown names).
  [[nodiscard]] virtual bool is_matched(const std::vector<std::string>& topics) = 0;
  /// Until all reliable readers have everything.
  virtual void wait_for_acknowledgments(Duration timeout) = 0;
};

/// With the policies that were recorded; `reliable`: nothing may be lost.
[[nodiscard]] std::unique_ptr<PlayOutput> make_wire_output(runtime::Node& node, bool reliable);
/// Through the component's own transport, in lockstep.
[[nodiscard]] std::unique_ptr<PlayOutput> make_lockstep_output(runtime::Node& node);

}  // namespace coop::capture
