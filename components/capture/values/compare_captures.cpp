#include "capture/values/compare_captures.hpp"

#include <algorithm>
#include <cstring>
#include <set>

#include "capture/values/layouts.hpp"

namespace coop::capture {
namespace {

bool has_topic(const mcap::Summary& summary, const std::string& topic) {
  return std::ranges::any_of(summary.channels,
                             [&](const auto& channel) { return channel.second.topic == topic; });
}

PayloadDifference as_bytes(mcap::Bytes first, mcap::Bytes second) {
  std::size_t at = 0;
  while (at < first.size() && at < second.size() && first[at] == second[at]) ++at;
  const auto shown = [at](mcap::Bytes bytes) {
    return at < bytes.size() ? std::to_string(static_cast<int>(bytes[at])) : std::string("the end");
  };
  return {"byte " + std::to_string(at), shown(first), shown(second)};
}

bool is_equal(mcap::Bytes a, mcap::Bytes b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size()) == 0);
}

/// Two messages at the same place of a topic in two captures.
class TopicPair {
 public:
  explicit TopicPair(TopicComparison& result) : result_(result) {}

  void compare(std::uint64_t index, const mcap::ReadMessage& a, const mcap::ReadMessage& b) {
    const auto times = std::pair(a.message.log_time, b.message.log_time);
    if (times.first != times.second) {
      if (!result_.time) result_.time = TimeDifference{index, times.first, times.second, 0};
      ++result_.time->messages;
    }
    if (result_.message) return;
    if (auto field = difference(a, b)) {
      result_.message = MessageDifference{index, times.first, times.second, std::move(*field)};
    }
  }

 private:
  std::optional<PayloadDifference> difference(const mcap::ReadMessage& a,
                                              const mcap::ReadMessage& b) {
    const MessageLayout* layout = first_.of(*a.channel, a.schema);
    const MessageLayout* other = second_.of(*b.channel, b.schema);
    if (layout != nullptr && other != nullptr && !(*layout == *other)) {
      const bool same_name = layout->name() == other->name();
      return PayloadDifference{"type", layout->name(),
                               other->name() + (same_name ? " of another definition" : "")};
    }
    if (is_equal(a.message.data, b.message.data)) return std::nullopt;
    if (layout == nullptr || other == nullptr) {
      note(layout == nullptr ? first_.why(*a.channel) : second_.why(*b.channel));
      return as_bytes(a.message.data, b.message.data);
    }
    auto found = first_difference(*layout, a.message.data, b.message.data);
    if (found) return std::move(*found);
    note(found.error().text());
    return as_bytes(a.message.data, b.message.data);
  }

  void note(const std::string& why) { result_.note = "compared as bytes: " + why; }

  TopicComparison& result_;
  Layouts first_;
  Layouts second_;
};

TopicComparison compare_topic(mcap::Reader& first, mcap::Reader& second, const std::string& topic) {
  TopicComparison result{.topic = topic,
                         .in_first = has_topic(first.summary(), topic),
                         .in_second = has_topic(second.summary(), topic)};
  TopicPair pair(result);
  auto in_first = first.messages({.topics = {topic}});
  auto in_second = second.messages({.topics = {topic}});
  auto a = in_first.next();
  auto b = in_second.next();
  while (a || b) {
    if (a && b) pair.compare(result.first_count, *a, *b);
    if (a) {
      ++result.first_count;
      a = in_first.next();
    }
    if (b) {
      ++result.second_count;
      b = in_second.next();
    }
  }
  return result;
}

std::string shortened(const std::string& text) {
  constexpr std::size_t kMost = 120;
  return text.size() <= kMost ? text : text.substr(0, kMost) + "...";
}

}  // namespace

bool TopicComparison::is_same(bool with_times) const {
  return in_first == in_second && first_count == second_count && !message && !(with_times && time);
}

std::string TopicComparison::text() const {
  const auto messages = [](std::uint64_t count) { return std::to_string(count) + " messages"; };
  std::string out = topic + ": ";
  if (!in_second) return out + "only in the first (" + messages(first_count) + ")";
  if (!in_first) return out + "only in the second (" + messages(second_count) + ")";
  out += messages(first_count);
  if (first_count != second_count) out += " and " + messages(second_count);
  if (message) {
    out += "; message " + std::to_string(message->index) + " (" +
           seconds_text(message->first_time) + " s";
    if (message->first_time != message->second_time) {
      out += " and " + seconds_text(message->second_time) + " s";
    }
    out += ") differs: " + message->field.path + ": " + shortened(message->field.first) + " / " +
           shortened(message->field.second);
  } else {
    out +=
        first_count == second_count ? ", the same values" : ", the same values as far as both go";
  }
  if (time) {
    out += "; log times differ in " + messages(time->messages) + ", first in message " +
           std::to_string(time->index) + ": " + seconds_text(time->first_time) + " / " +
           seconds_text(time->second_time) + " s";
  }
  if (!note.empty()) out += " (" + note + ")";
  return out;
}

std::vector<TopicComparison> compare_captures(mcap::Reader& first, mcap::Reader& second,
                                              const std::vector<std::string>& topics) {
  std::set<std::string> names;
  for (const std::string& topic : topics) {
    const std::string name = topic_in_file(first.summary(), topic);
    names.insert(has_topic(first.summary(), name) ? name : topic_in_file(second.summary(), topic));
  }
  if (topics.empty()) {
    for (mcap::Reader* reader : {&first, &second}) {
      for (const auto& [id, channel] : reader->summary().channels) names.insert(channel.topic);
    }
  }
  std::vector<TopicComparison> result;
  result.reserve(names.size());
  for (const std::string& name : names) result.push_back(compare_topic(first, second, name));
  return result;
}

}  // namespace coop::capture
