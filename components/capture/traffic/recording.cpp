#include "capture/traffic/recording.hpp"

#include <unistd.h>

#include <algorithm>

#include "capture/mcap/ring_folder.hpp"
#include "capture/schema/definitions.hpp"
#include "capture/traffic/topic_names.hpp"

namespace coop::capture {
namespace {

mcap::Nanoseconds to_mcap(Time time) {
  return static_cast<mcap::Nanoseconds>(std::max<std::int64_t>(0, to_nanoseconds(time)));
}

}  // namespace

Recording::Recording(const RecordingOptions& options) : options_(options), writer_(make_writer()) {}

std::unique_ptr<mcap::Writer> Recording::make_writer() const {
  mcap::WriterOptions writer = options_.writer;
  writer.tail = true;
  if (is_ring()) return std::make_unique<mcap::Writer>(ring(), writer);
  std::filesystem::create_directories(options_.path.parent_path());
  return std::make_unique<mcap::Writer>(
      mcap::Series{.path = options_.path,
                   .split_bytes = options_.split_bytes,
                   .split_duration = static_cast<mcap::Nanoseconds>(options_.split_time.count())},
      writer);
}

mcap::Ring Recording::ring() const {
  mcap::Ring ring{.duration = static_cast<mcap::Nanoseconds>(options_.last.count()),
                  .max_bytes = options_.ring_bytes};
  if (options_.rings.empty()) return ring;
  const std::string stem = options_.path.stem().string();
  ring.folder =
      options_.rings / (mcap::RingFolder::kPrefix + stem + "-" + std::to_string(::getpid()));
  ring.origin = std::filesystem::absolute(options_.path).replace_filename(stem + "-killed.mcap");
  ring.said_before = [this](mcap::Nanoseconds begin) {
    return said_before(Time(Duration(static_cast<std::int64_t>(begin))));
  };
  return ring;
}

std::vector<mcap::StoredMessage> Recording::said_before(Time begin) const {
  std::vector<mcap::StoredMessage> said;
  const std::scoped_lock lock(mutex_);
  for (const auto& [channel, account] : accounts_) {
    if (!account.last_word || account.last_word->log_time >= begin) continue;
    const LastWord& word = *account.last_word;
    said.emplace_back(mcap::Message{.channel_id = channel,
                                    .sequence = static_cast<std::uint32_t>(word.sequence),
                                    .log_time = to_mcap(begin),
                                    .publish_time = to_mcap(word.publish_time),
                                    .data = {}},
                      std::as_bytes(std::span(word.bytes)));
  }
  return said;
}

std::uint16_t Recording::add_channel(const WriterInfo& writer) {
  const std::string type = shown_type(writer.dds_type);
  const auto definition = ros2msg_definition(type);
  const std::uint16_t schema = definition ? writer_->add_schema(type, "ros2msg", *definition)
                                          : writer_->add_schema(type, "", "");
  const std::uint16_t channel = writer_->add_channel(schema, writer.topic, "cdr",
                                                     {{"offered_qos_profiles", to_yaml(writer.qos)},
                                                      {"component", writer.component},
                                                      {"writer", writer.id},
                                                      {"dds_type", writer.dds_type},
                                                      {"keyed", writer.keyed ? "true" : "false"}});
  const std::scoped_lock lock(mutex_);
  for (auto& [id, other] : accounts_) {
    // Its program was started again: the last word of the one before counts no longer.
    const bool is_successor = other.topic == writer.topic && other.component == writer.component;
    if (id != channel && is_successor) other.last_word.reset();
  }
  Account& account = accounts_[channel];
  account.topic = writer.topic;
  account.component = writer.component;
  account.is_latched = writer.qos.transient_local;
  return channel;
}

bool Recording::put(std::uint16_t channel, std::uint64_t sequence, Time log_time, Time publish_time,
                    std::span<const std::uint8_t> bytes) {
  return writer_->write({.channel_id = channel,
                         .sequence = static_cast<std::uint32_t>(sequence),
                         .log_time = to_mcap(log_time),
                         .publish_time = to_mcap(publish_time),
                         .data = std::as_bytes(bytes)});
}

bool Recording::write(std::uint16_t channel, std::uint64_t sequence, Time log_time,
                      Time publish_time, std::span<const std::uint8_t> bytes) {
  const bool taken = put(channel, sequence, log_time, publish_time, bytes);
  const std::scoped_lock lock(mutex_);
  Account& account = accounts_.at(channel);
  // What a writer wrote before it was found does not count.
  if (account.last != 0 && sequence > account.last + 1) {
    account.missed += sequence - account.last - 1;
  }
  account.last = std::max(account.last, sequence);
  ++(taken ? account.messages : account.refused);
  if (account.is_latched) {
    account.last_word = {sequence, log_time, publish_time, {bytes.begin(), bytes.end()}};
  }
  newest_ = std::max(newest_, log_time);
  if (begin_ == Time{}) {
    begin_ = log_time;
    if (!is_ring()) repeat_last_words(begin_);
  }
  return taken;
}

void Recording::repeat_last_words(Time begin) {
  for (auto& [channel, account] : accounts_) {
    if (!account.last_word || account.last_word->log_time >= begin) continue;
    LastWord& word = *account.last_word;
    word.log_time = begin;
    put(channel, word.sequence, begin, word.publish_time, word.bytes);
  }
}

void Recording::begin_anew(const std::filesystem::path& path) {
  const std::scoped_lock lock(mutex_);
  writer_->begin_anew(path);
  begin_ = newest_ = Time{};
  for (auto& [channel, account] : accounts_) {
    if (account.last_word) account.last_word->log_time = Time{};
  }
}

void Recording::attach(const std::string& name, const std::string& media_type,
                       std::string_view data, Time now) {
  writer_->attach({.log_time = to_mcap(now),
                   .create_time = to_mcap(now),
                   .name = name,
                   .media_type = media_type,
                   .data = std::as_bytes(std::span(data.data(), data.size()))});
}

void Recording::note(const std::string& name, const std::map<std::string, std::string>& facts) {
  writer_->add({.name = name, .metadata = facts});
}

void Recording::tick(Time now) {
  writer_->close_aged_chunk(to_mcap(now));
}

std::future<std::uint64_t> Recording::save(const std::filesystem::path& path) {
  std::filesystem::create_directories(path.parent_path());
  const std::scoped_lock lock(mutex_);
  repeat_last_words(std::max(begin_, newest_ - options_.last));
  return writer_->snapshot(path);
}

void Recording::close() {
  if (closed_) return;
  closed_ = true;
  if (!is_ring()) {
    std::map<std::string, std::string> facts;
    for (const TopicReport& topic : report()) {
      if (topic.missed > 0) facts[topic.topic + " missed"] = std::to_string(topic.missed);
      if (topic.refused > 0) facts[topic.topic + " refused"] = std::to_string(topic.refused);
    }
    writer_->add({.name = "coop.losses", .metadata = facts}, mcap::Where::kThisFile);
  }
  writer_->close();
}

std::vector<TopicReport> Recording::report() const {
  std::map<std::string, TopicReport> topics;
  const std::scoped_lock lock(mutex_);
  for (const auto& [channel, account] : accounts_) {
    TopicReport& topic = topics[account.topic];
    topic.topic = account.topic;
    topic.messages += account.messages;
    topic.missed += account.missed;
    topic.refused += account.refused;
  }
  std::vector<TopicReport> all;
  all.reserve(topics.size());
  all.reserve(topics.size());
  for (auto& [name, topic] : topics) all.push_back(std::move(topic));
  return all;
}

std::string losses_text(const std::vector<TopicReport>& report) {
  std::string text;
  for (const TopicReport& topic : report) {
    if (topic.missed + topic.refused == 0) continue;
    if (!text.empty()) text += ", ";
    if (topic.missed > 0) text += std::to_string(topic.missed) + " missed";
    if (topic.missed > 0 && topic.refused > 0) text += " and ";
    if (topic.refused > 0) text += std::to_string(topic.refused) + " refused";
    text += " of " + topic.topic;
  }
  return text;
}

}  // namespace coop::capture
