#pragma once
#include <deque>
#include <mutex>
#include <string_view>

#include "capture/mcap/records.hpp"

namespace coop::mcap {

/// The schemas and channels of a capture, in the order of their ids: grows, never changes. Any
/// thread may call.
class Definitions {
 public:
  /// The id of the schema (channel) that is just this, added if it is new. Throws
  /// std::length_error beyond 65535 of them.
  std::uint16_t schema(std::string_view name, std::string_view encoding, std::string_view data);
  std::uint16_t channel(std::uint16_t schema_id, std::string_view topic,
                        std::string_view message_encoding,
                        const std::map<std::string, std::string>& metadata);

  struct View {
    std::vector<const Schema*> schemas;
    std::vector<const Channel*> channels;
  };
  /// All after the first so many.
  [[nodiscard]] View after(std::size_t schemas, std::size_t channels) const;

 private:
  mutable std::mutex mutex_;
  std::deque<Schema> schemas_;  // deque: addresses stay
  std::deque<Channel> channels_;
};

}  // namespace coop::mcap
