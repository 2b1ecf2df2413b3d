#include "capture/values/layouts.hpp"

#include <algorithm>

namespace coop::capture {
namespace {

std::unique_ptr<MessageLayout> layout_of(const mcap::Channel& channel, const mcap::Schema* schema) {
  if (channel.message_encoding != "cdr") {
    throw DefinitionError("messages encoded as '" + channel.message_encoding + "', not cdr");
  }
  if (schema == nullptr) throw DefinitionError("no schema");
  if (schema->encoding != "ros2msg") {
    throw DefinitionError("a schema encoded as '" + schema->encoding + "', not ros2msg");
  }
  return std::make_unique<MessageLayout>(schema->name, schema->data);
}

}  // namespace

const MessageLayout* Layouts::of(const mcap::Channel& channel, const mcap::Schema* schema) {
  const auto [entry, is_new] = entries_.try_emplace(channel.id);
  if (is_new) {
    try {
      entry->second.layout = layout_of(channel, schema);
    } catch (const DefinitionError& error) {
      entry->second.why = error.what();
    }
  }
  return entry->second.layout.get();
}

const std::string& Layouts::why(const mcap::Channel& channel) const {
  return entries_.at(channel.id).why;
}

std::string seconds_text(mcap::Nanoseconds time) {
  constexpr mcap::Nanoseconds kSecond = 1'000'000'000;
  const std::string fraction = std::to_string(time % kSecond);
  return std::to_string(time / kSecond) + "." + std::string(9 - fraction.size(), '0') + fraction;
}

std::string topic_in_file(const mcap::Summary& summary, const std::string& name) {
  const auto has = [&](const std::string& topic) {
    return std::ranges::any_of(summary.channels,
                               [&](const auto& channel) { return channel.second.topic == topic; });
  };
  return !has(name) && has("/" + name) ? "/" + name : name;
}

}  // namespace coop::capture
