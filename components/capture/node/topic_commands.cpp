#include "capture/node/topic_commands.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <iostream>
#include <map>
#include <optional>

#include "capture/node/topic_list.hpp"
#include "capture/schema/definitions.hpp"
#include "capture/schema/message_text.hpp"
#include "capture/traffic/topic_names.hpp"
#include "capture/traffic/topic_statistics.hpp"
#include "conversions/time.hpp"
#include "coop_msgs/msg/SaveCapture.h"
#include "coop_msgs/msg/SaveCaptureResult.h"
#include "core/config/config.hpp"
#include "runtime/dds_transport.hpp"
#include "runtime/node.hpp"

namespace coop::capture {
namespace {

constexpr auto kPatience = std::chrono::seconds(3);

std::string with_slash(const std::string& topic) {
  return topic.starts_with('/') ? topic : "/" + topic;
}

/// Says once on stderr that a topic has no writer, and what it could have been.
void complain_when_silent(ToolLoop& loop, const TopicListener& listener, const std::string& topic) {
  loop.executor().call_at(runtime::Executor::Wall::now() + kPatience, [&listener, topic] {
    if (listener.has_writers()) return;
    const std::vector<std::string> names(listener.known_topics().begin(),
                                         listener.known_topics().end());
    const auto near = config::nearest_name(with_slash(topic), names);
    std::cerr << "nobody writes " << topic << " yet; waits"
              << (near.empty() ? "" : " (did you mean " + std::string(near) + "?)") << std::endl;
  });
}

auto named(const std::string& topic) {
  return [topic](const std::string& name) { return name == topic || name == with_slash(topic); };
}

/// Prints messages of types that are known, and what can be said of others.
class Printer {
 public:
  explicit Printer(const TopicArguments& arguments) : arguments_(arguments) {
    options_.max_elements =
        arguments.max_elements == 0 ? options_.max_elements : arguments.max_elements;
  }

  void print(const HeardSample& heard) {
    const auto& bytes = heard.sample.bytes;
    std::string out;
    if (const MessageLayout* layout = layout_of(heard.writer->topic.type)) {
      const auto done = arguments_.options.json
                            ? append_json(*layout, std::as_bytes(std::span(bytes)), options_, out)
                            : append_yaml(*layout, std::as_bytes(std::span(bytes)), options_, out);
      if (!done) std::cerr << "no such message: " << done.error().text() << '\n';
    } else {
      out = arguments_.options.json
                ? fmt::format(R"({{"type": {}, "bytes": {}}})",
                              json_text(shown_type(heard.writer->topic.type)), bytes.size())
                : fmt::format("{} bytes of {}", bytes.size(), shown_type(heard.writer->topic.type));
    }
    std::cout << out << (out.ends_with('\n') ? "" : "\n")
              << (arguments_.options.json ? "" : "---\n") << std::flush;
  }

 private:
  const MessageLayout* layout_of(const std::string& dds_type) {
    auto [entry, is_new] = layouts_.try_emplace(dds_type);
    if (is_new) {
      const std::string type = shown_type(dds_type);
      if (const auto definition = ros2msg_definition(type)) {
        entry->second.emplace(type, *definition);
      }
    }
    return entry->second ? &*entry->second : nullptr;
  }

  const TopicArguments& arguments_;
  TextOptions options_;
  std::map<std::string, std::optional<MessageLayout>> layouts_;
};

std::string size_text(double bytes) {
  if (bytes >= 1e6) return fmt::format("{:.2f} MB", bytes / 1e6);
  if (bytes >= 1e3) return fmt::format("{:.2f} kB", bytes / 1e3);
  return fmt::format("{:.0f} B", bytes);
}

std::string spread_text(const Spread& spread, double scale, const char* unit) {
  return fmt::format("mean {:.3f}, least {:.3f}, most {:.3f}, deviation {:.3f} {}",
                     spread.mean * scale, spread.least * scale, spread.most * scale,
                     spread.deviation * scale, unit);
}

std::string spread_json(const Spread& spread) {
  return fmt::format(R"({{"mean": {}, "least": {}, "most": {}, "deviation": {}}})", spread.mean,
                     spread.least, spread.most, spread.deviation);
}

std::string measured(const TopicStatistics& statistics, const std::string& what, bool json) {
  const auto flow = statistics.flow();
  const auto delay = statistics.delay();
  if (!flow || (what == "delay" && !delay)) return json ? "{}" : "no messages yet";
  if (json) {
    if (what == "delay") return fmt::format(R"({{"delay": {}}})", spread_json(*delay));
    return fmt::format(R"({{"rate": {}, "bytes_per_second": {}, "period": {}, "size": {}}})",
                       flow->rate, flow->bytes_per_second, spread_json(flow->period),
                       spread_json(flow->size));
  }
  if (what == "delay") return "under way: " + spread_text(*delay, 1e3, "ms");
  if (what == "bw") {
    return fmt::format("{}/s; a message: mean {}, least {}, most {}",
                       size_text(flow->bytes_per_second), size_text(flow->size.mean),
                       size_text(flow->size.least), size_text(flow->size.most));
  }
  return fmt::format("{:.2f} Hz; between two: {} ({} messages)", flow->rate,
                     spread_text(flow->period, 1e3, "ms"), flow->window);
}

}  // namespace

int list_topics(const TopicArguments& arguments) {
  ToolLoop loop;
  TopicList list(arguments.options.robot);
  runtime::RawParticipant participant(arguments.options.dds("topic"),
                                      [&loop] { loop.executor().wake(); });
  loop.executor().call_at(runtime::Executor::Wall::now() + seconds(arguments.wait),
                          [&loop] { loop.finish(); });
  loop.run();
  for (const auto& event : participant.take_events()) list.take(event);
  std::cout << (arguments.options.json ? list.json() : list.text());
  return 0;
}

int echo_topic(const TopicArguments& arguments) {
  ToolLoop loop;
  Printer printer(arguments);
  std::int64_t left = arguments.count;
  const TopicListener listener(loop, arguments.options.dds("topic"), named(arguments.topic),
                               [&](const HeardSample& heard) {
                                 if (arguments.count > 0 && left-- <= 0) return;
                                 printer.print(heard);
                                 if (arguments.count > 0 && left == 0) loop.finish();
                               });
  complain_when_silent(loop, listener, arguments.topic);
  loop.run();
  return 0;
}

int measure_topic(const TopicArguments& arguments, const std::string& what) {
  ToolLoop loop;
  TopicStatistics statistics(arguments.window);
  const TopicListener listener(
      loop, arguments.options.dds("topic"), named(arguments.topic), [&](const HeardSample& heard) {
        statistics.add(heard.sample.reception_time, heard.sample.bytes.size(),
                       heard.sample.reception_time - heard.sample.source_time);
      });
  complain_when_silent(loop, listener, arguments.topic);
  std::int64_t left = arguments.count;
  loop.executor().add_wall_timer(std::chrono::seconds(1), [&] {
    if (statistics.messages() < 2) return;
    std::cout << measured(statistics, what, arguments.options.json) << std::endl;
    if (arguments.count > 0 && --left == 0) loop.finish();
  });
  loop.run();
  return 0;
}

int save_captures(const TopicArguments& arguments) {
  ToolLoop loop;
  runtime::DdsTransport transport(arguments.options.dds("snapshot"));
  const auto writer = transport.create_writer(
      "save_capture", runtime::message_type<coop_msgs::msg::SaveCapture>(), runtime::Qos::kEvent);
  const auto reader = transport.create_reader(
      "save_capture_result", runtime::message_type<coop_msgs::msg::SaveCaptureResult>(),
      runtime::Qos::kEvent, [&loop] { loop.executor().wake(); });
  coop_msgs::msg::SaveCapture order;
  order.request_id(fmt::format("{}-{}", ::getpid(), to_nanoseconds(loop.now())));
  order.reason(arguments.topic);
  const Time begun = loop.now();
  bool asked = false;
  int code = 1;
  loop.executor().add_wall_timer(std::chrono::milliseconds(20), [&] {
    if (!asked && writer->matched_readers() > 0 && reader->matched_writers() > 0) {
      order.header(conversions::to_header(loop.now(), ""));
      asked = writer->write(&order);
    }
    runtime::Sample sample;
    while (reader->take(sample)) {
      const auto& result =
          *static_cast<const coop_msgs::msg::SaveCaptureResult*>(sample.message.get());
      if (result.request_id() != order.request_id()) continue;
      (result.success() ? std::cout << result.path() << '\n' : std::cerr << "not written: ")
          << result.detail() << '\n';
      code = result.success() ? 0 : 1;
      loop.finish();
    }
    if (loop.now() - begun > seconds(arguments.snapshot_wait)) {
      std::cerr << (asked ? "the recorder does not answer\n" : "no recorder is running\n");
      loop.finish();
    }
  });
  loop.run();
  return code;
}

}  // namespace coop::capture
