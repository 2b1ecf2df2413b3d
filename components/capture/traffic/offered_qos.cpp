#include "capture/traffic/offered_qos.hpp"

#include <charconv>

namespace coop::capture {
namespace {

/// rmw's way to say "for ever".
constexpr std::int64_t kForeverSeconds = 9223372036;
constexpr std::int64_t kForeverNanoseconds = 854775807;
/// Seconds from which a duration is taken for endless: DDS's own infinity has 2^31 - 1.
constexpr std::int64_t kEndless = 2147483647;

std::string duration_yaml(std::string_view name, Duration duration) {
  const bool endless = duration == Duration::max();
  const std::int64_t whole = endless ? kForeverSeconds : duration.count() / 1'000'000'000;
  const std::int64_t rest = endless ? kForeverNanoseconds : duration.count() % 1'000'000'000;
  return "  " + std::string(name) + ":\n    sec: " + std::to_string(whole) +
         "\n    nsec: " + std::to_string(rest) + "\n";
}

std::string_view trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t\r\"'");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r\"'") - begin + 1);
}

std::int64_t number(std::string_view text, std::int64_t otherwise) {
  std::int64_t value = otherwise;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

/// One line at a time: profiles are flat but for their durations.
class Parser {
 public:
  std::vector<OfferedQos> profiles;

  void line(std::string_view text) {
    const std::string_view content = trimmed(text);
    if (content.starts_with("- ") || content == "-") {
      profiles.emplace_back();
      duration_ = nullptr;
    }
    const std::string_view entry = trimmed(content.starts_with("- ") ? content.substr(2) : content);
    const auto colon = entry.find(':');
    if (colon == std::string_view::npos || profiles.empty()) return;
    set(profiles.back(), trimmed(entry.substr(0, colon)), trimmed(entry.substr(colon + 1)));
  }

 private:
  void set(OfferedQos& qos, std::string_view key, std::string_view value) {
    if (key == "history") {
      qos.history = value == "keep_last"  ? OfferedQos::History::kKeepLast
                    : value == "keep_all" ? OfferedQos::History::kKeepAll
                                          : static_cast<OfferedQos::History>(number(value, 3) & 3);
    } else if (key == "depth") {
      qos.depth = static_cast<int>(number(value, 0));
    } else if (key == "reliability") {
      qos.reliable = value != "2" && value != "best_effort";
    } else if (key == "durability") {
      qos.transient_local = value == "1" || value == "transient_local";
    } else if (key == "liveliness") {
      qos.liveliness = value == "3" || value == "manual_by_topic"
                           ? OfferedQos::Liveliness::kManualByTopic
                           : OfferedQos::Liveliness::kAutomatic;
    } else if (key == "deadline") {
      duration_ = &qos.deadline;
    } else if (key == "lifespan") {
      duration_ = &qos.lifespan;
    } else if (key == "liveliness_lease_duration") {
      duration_ = &qos.liveliness_lease;
    } else if (key == "sec" && duration_ != nullptr) {
      const std::int64_t whole = number(value, kEndless);
      *duration_ = whole >= kEndless ? Duration::max() : Duration(std::chrono::seconds(whole));
    } else if (key == "nsec" && duration_ != nullptr && *duration_ != Duration::max()) {
      *duration_ += std::chrono::nanoseconds(number(value, 0));
    }
  }

  Duration* duration_ = nullptr;
};

}  // namespace

std::string to_yaml(const OfferedQos& qos) {
  return "- history: " + std::to_string(static_cast<int>(qos.history)) +
         "\n  depth: " + std::to_string(qos.depth) +
         "\n  reliability: " + (qos.reliable ? "1" : "2") +
         "\n  durability: " + (qos.transient_local ? "1" : "2") + "\n" +
         duration_yaml("deadline", qos.deadline) + duration_yaml("lifespan", qos.lifespan) +
         "  liveliness: " + std::to_string(static_cast<int>(qos.liveliness)) + "\n" +
         duration_yaml("liveliness_lease_duration", qos.liveliness_lease) +
         "  avoid_ros_namespace_conventions: false";
}

std::vector<OfferedQos> parse_offered_qos(std::string_view yaml) {
  Parser parser;
  while (!yaml.empty()) {
    const auto end = yaml.find('\n');
    parser.line(yaml.substr(0, end));
    if (end == std::string_view::npos) break;
    yaml.remove_prefix(end + 1);
  }
  return std::move(parser.profiles);
}

}  // namespace coop::capture
