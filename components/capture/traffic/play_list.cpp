#include "capture/traffic/play_list.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

namespace coop::capture {
namespace {

Time from_mcap(mcap::Nanoseconds time) {
  return Time(Duration(static_cast<std::int64_t>(time)));
}

mcap::Nanoseconds to_mcap(Time time) {
  return static_cast<mcap::Nanoseconds>(to_nanoseconds(time));
}

/// These belong to the run that was recorded, not to what it sensed: heartbeats, and the lockstep's
/// own talk.
bool is_of_the_run(std::string_view topic) {
  return topic == "/component_status" || topic.starts_with("/lockstep_") ||
         topic.starts_with("/save_capture");
}

std::vector<std::filesystem::path> captures_at(const std::filesystem::path& path) {
  if (!std::filesystem::is_directory(path)) return {path};
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(path)) {
    if (entry.path().extension() == ".mcap") files.push_back(entry.path());
  }
  if (files.empty()) throw std::invalid_argument(path.string() + ": no captures (*.mcap) in it");
  std::ranges::sort(files);
  return files;
}

std::pair<std::string, std::string> split_remap(const std::string& remap) {
  constexpr std::string_view kBecomes = ":=";
  const auto at = remap.find(kBecomes);
  if (at == std::string::npos || at == 0 || at + kBecomes.size() == remap.size()) {
    throw std::invalid_argument("remap: expected FROM:=TO, found '" + remap + "'");
  }
  const auto with_slash = [](const std::string& name) {
    return name.starts_with('/') ? name : "/" + name;
  };
  return {with_slash(remap.substr(0, at)), with_slash(remap.substr(at + kBecomes.size()))};
}

/// What several offers of one channel come to.
OfferedQos merged(const std::vector<OfferedQos>& offers) {
  OfferedQos all = offers.empty() ? OfferedQos{} : offers.front();
  int depth = 0;
  for (const OfferedQos& offer : offers) {
    all.reliable = all.reliable && offer.reliable;
    all.transient_local = all.transient_local || offer.transient_local;
    depth += std::max(offer.depth, 1);
  }
  all.depth = std::max(depth, 1);
  return all;
}

std::string value_of(const std::map<std::string, std::string>& metadata, const char* key) {
  const auto found = metadata.find(key);
  return found == metadata.end() ? std::string() : found->second;
}

}  // namespace

void PlaySelection::validate() const {
  topics.validate();
  for (const std::string& entry : remap) (void)split_remap(entry);
  if (start < 0.0) throw std::invalid_argument("start: expected seconds, not less than 0");
  if (duration < 0.0) throw std::invalid_argument("duration: expected seconds, not less than 0");
}

PlayList::PlayList(const std::filesystem::path& path, const PlaySelection& selection) {
  selection.validate();
  for (const auto& file : captures_at(path)) {
    files_.push_back({.reader = std::make_unique<mcap::Reader>(file), .channels = {}});
    was_cut_ = was_cut_ || !files_.back().reader->summary().complete;
    add_channels(files_.back(), selection);
  }
  if (channels_.empty()) throw std::invalid_argument(path.string() + ": no topic is selected");
  set_range(selection);
  rewind();
}

void PlayList::add_channels(File& file, const PlaySelection& selection) {
  const mcap::Summary& summary = file.reader->summary();
  for (const auto& [id, recorded] : summary.channels) {
    PlayChannel channel;
    channel.recorded_topic = recorded.topic;
    channel.topic = recorded.topic;
    channel.component = value_of(recorded.metadata, "component");
    channel.writer = value_of(recorded.metadata, "writer");
    if (is_of_the_run(channel.topic) || !selection.topics.wants(channel.topic)) continue;
    if (std::ranges::find(selection.without, channel.component) != selection.without.end()) {
      continue;
    }
    for (const std::string& remap : selection.remap) {
      const auto [from, to] = split_remap(remap);
      if (from == channel.topic) {
        channel.topic = to;
        break;
      }
    }
    const mcap::Schema* schema = summary.schema_of(recorded);
    channel.dds_type = value_of(recorded.metadata, "dds_type");
    if (channel.dds_type.empty() && schema != nullptr) channel.dds_type = dds_type(schema->name);
    if (channel.dds_type.empty()) continue;  // nobody could read it
    channel.keyed = value_of(recorded.metadata, "keyed") == "true";
    channel.qos = merged(parse_offered_qos(value_of(recorded.metadata, "offered_qos_profiles")));
    // The parts of a split capture have the same channels.
    const auto known = std::ranges::find_if(channels_, [&](const PlayChannel& other) {
      return other.topic == channel.topic && other.writer == channel.writer &&
             other.dds_type == channel.dds_type;
    });
    file.channels[id] = static_cast<std::size_t>(known - channels_.begin());
    if (known == channels_.end()) channels_.push_back(std::move(channel));
  }
}

void PlayList::set_range(const PlaySelection& selection) {
  Time first = Time::max();
  Time last{};
  for (const File& file : files_) {
    const auto& statistics = file.reader->summary().statistics;
    if (!statistics || statistics->message_count == 0) continue;
    first = std::min(first, from_mcap(statistics->message_start_time));
    last = std::max(last, from_mcap(statistics->message_end_time));
  }
  if (first == Time::max()) throw std::invalid_argument("the capture has no messages");
  begin_ = first + seconds(selection.start);
  end_ = selection.duration > 0.0 ? std::min(last, begin_ + seconds(selection.duration)) : last;
  if (begin_ > last) {
    throw std::invalid_argument("start: the capture is " +
                                std::to_string(to_seconds(last - first)) + " s long");
  }
}

PlayMessage PlayList::copy(const mcap::ReadMessage& message, std::size_t channel) {
  PlayMessage copy;
  copy.channel = channel;
  copy.sequence = message.message.sequence;
  copy.log_time = from_mcap(message.message.log_time);
  const auto* data = reinterpret_cast<const std::uint8_t*>(message.message.data.data());
  copy.bytes.assign(data, data + message.message.data.size());
  return copy;
}

std::vector<PlayMessage> PlayList::latched_before() {
  std::vector<PlayMessage> kept;
  for (File& file : files_) {
    std::set<std::string> topics;
    for (const auto& [id, channel] : file.channels) {
      if (channels_[channel].qos.transient_local) topics.insert(channels_[channel].recorded_topic);
    }
    if (topics.empty()) continue;
    auto cursor =
        file.reader->messages({.end = to_mcap(begin_), .topics = {topics.begin(), topics.end()}});
    while (const auto message = cursor.next()) {
      const auto found = file.channels.find(message->message.channel_id);
      if (found == file.channels.end()) continue;
      if (!channels_[found->second].keyed) {
        std::erase_if(kept, [&](const PlayMessage& old) { return old.channel == found->second; });
      }
      kept.push_back(copy(*message, found->second));
    }
  }
  return kept;
}

std::optional<PlayMessage> PlayList::next() {
  while (file_ < files_.size()) {
    File& file = files_[file_];
    if (!cursor_) {
      cursor_.emplace(file.reader->messages(
          {.start = to_mcap(begin_), .end = to_mcap(end_) + 1, .topics = {}}));
    }
    while (const auto message = cursor_->next()) {
      const auto found = file.channels.find(message->message.channel_id);
      if (found != file.channels.end()) return copy(*message, found->second);
    }
    cursor_.reset();
    ++file_;
  }
  return std::nullopt;
}

void PlayList::rewind() {
  cursor_.reset();
  file_ = 0;
}

std::vector<PlayMessage> PlayList::all_of(const std::string& recorded_topic_pattern) {
  std::vector<PlayMessage> all;
  for (File& file : files_) {
    std::set<std::string> topics;
    for (const auto& [id, channel] : file.reader->summary().channels) {
      if (matches(recorded_topic_pattern, channel.topic)) topics.insert(channel.topic);
    }
    if (topics.empty()) continue;
    auto cursor = file.reader->messages({.topics = {topics.begin(), topics.end()}});
    while (const auto message = cursor.next()) all.push_back(copy(*message, 0));
  }
  return all;
}

}  // namespace coop::capture
