#pragma once
#include <string>

#include "capture/node/tool.hpp"

namespace coop::capture {

struct TopicArguments {
  ToolOptions options;
  std::string topic;
  double wait = 1.0;            ///< s
  double snapshot_wait = 10.0;  ///< s
  std::int64_t count = 0;       ///< 0: until Ctrl-C
  std::size_t max_elements = 20;
  std::size_t window = 1000;
};

/// Each answers the exit code.
int list_topics(const TopicArguments& arguments);
int echo_topic(const TopicArguments& arguments);
/// `what`: hz, bw or delay.
int measure_topic(const TopicArguments& arguments, const std::string& what);
int save_captures(const TopicArguments& arguments);

}  // namespace coop::capture
