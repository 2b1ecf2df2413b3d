#pragma once
#include <map>
#include <memory>
#include <string>

#include "capture/mcap/reader.hpp"
#include "capture/schema/message_layout.hpp"

namespace coop::capture {

/// The layouts of a file's channels, made from the definitions that the file carries.
class Layouts {
 public:
  /// Null where the channel cannot be decoded: why() then says the reason.
  [[nodiscard]] const MessageLayout* of(const mcap::Channel& channel, const mcap::Schema* schema);
  [[nodiscard]] const std::string& why(const mcap::Channel& channel) const;

 private:
  struct Entry {
    std::unique_ptr<MessageLayout> layout;
    std::string why;
  };
  std::map<std::uint16_t, Entry> entries_;  // by channel id
};

/// Seconds with nine digits: "12.000000003".
[[nodiscard]] std::string seconds_text(mcap::Nanoseconds time);

/// Topics may be named without their leading slash: the file's own name for one, or the name as it
/// is where the file has none such.
[[nodiscard]] std::string topic_in_file(const mcap::Summary& summary, const std::string& name);

}  // namespace coop::capture
