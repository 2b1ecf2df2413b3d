#pragma once
#include <optional>

#include "capture/mcap/reader.hpp"
#include "capture/schema/payload_difference.hpp"

namespace coop::capture {

/// The first message of a topic that is not the same in two captures; messages are counted from 0
/// in the order of log time.
struct MessageDifference {
  std::uint64_t index = 0;
  mcap::Nanoseconds first_time = 0;
  mcap::Nanoseconds second_time = 0;
  PayloadDifference field;
};

struct TimeDifference {
  std::uint64_t index = 0;
  mcap::Nanoseconds first_time = 0;
  mcap::Nanoseconds second_time = 0;
  std::uint64_t messages = 0;  ///< whose log times differ, this one included
};

struct TopicComparison {
  std::string topic;
  std::uint64_t first_count = 0;
  std::uint64_t second_count = 0;
  bool in_first = false;
  bool in_second = false;
  std::string note{};  ///< types that differ, or what cannot be decoded and was compared as bytes
  std::optional<MessageDifference> message{};
  std::optional<TimeDifference> time{};

  /// Times count only where asked for.
  [[nodiscard]] bool is_same(bool with_times) const;
  /// One line for people.
  [[nodiscard]] std::string text() const;
};

/// Compares two captures topic by topic, in the order of their names, message by message; a topic
/// that is in one only is told as such. Throws as the readers do.
[[nodiscard]] std::vector<TopicComparison> compare_captures(mcap::Reader& first,
                                                            mcap::Reader& second,
                                                            const std::vector<std::string>& topics);

}  // namespace coop::capture
