#include "capture/node/play_output.hpp"

#include <algorithm>
#include <map>

#include "capture/node/wire.hpp"

namespace coop::capture {
namespace {

/// Bags of ROS 2 have one channel for all writers of a latched topic: each of them had a last word.
constexpr int kLatchedDepth = 100;

class WireOutput : public PlayOutput {
 public:
  WireOutput(runtime::Node& node, bool reliable)
      : reliable_(reliable),
        participant_(raw_options(node.options()),
                     [&executor = node.executor()] { executor.wake(); }) {}

  void open(const std::vector<PlayChannel>& channels,
            const std::vector<std::size_t>& order) override {
    writers_.resize(channels.size());
    for (const std::size_t i : order) {
      const PlayChannel& channel = channels[i];
      runtime::WireQos qos = wire_qos(channel.qos);
      if (qos.transient_local && channel.writer.empty()) qos.depth = kLatchedDepth;
      if (reliable_ && !qos.transient_local) qos.reliable = qos.keep_all = true;
      writers_[i] = {wire_topic(channel.topic),
                     participant_.create_writer(
                         {wire_topic(channel.topic), channel.dds_type, channel.keyed}, qos)};
    }
  }
  bool write(const PlayMessage& message) override {
    participant_.mend();
    return writers_[message.channel].writer->write(message.bytes);
  }
  bool is_matched(const std::vector<std::string>& topics) override {
    for (const auto& event : participant_.take_events()) {
      if (event.endpoint.is_writer) continue;
      int& count = readers_[event.endpoint.topic.name];
      if (event.kind == runtime::DiscoveryEvent::Kind::kFound) ++count;
      if (event.kind == runtime::DiscoveryEvent::Kind::kLost) --count;
    }
    return std::ranges::all_of(writers_,
                               [&](const Open& open) {
                                 const auto known = readers_.find(open.topic);
                                 return known == readers_.end() ||
                                        open.writer->matched_readers() >= known->second;
                               }) &&
           std::ranges::all_of(topics, [&](const std::string& topic) {
             return std::ranges::any_of(writers_, [&](const Open& open) {
               return open.topic == wire_topic(topic) && open.writer->matched_readers() > 0;
             });
           });
  }
  void wait_for_acknowledgments(Duration timeout) override {
    for (const Open& open : writers_) open.writer->wait_for_acknowledgments(timeout);
  }

 private:
  struct Open {
    std::string topic;
    std::unique_ptr<runtime::RawWriter> writer;
  };
  bool reliable_;
  runtime::RawParticipant participant_;
  std::vector<Open> writers_;
  std::map<std::string, int> readers_;
};

class LockstepOutput : public PlayOutput {
 public:
  explicit LockstepOutput(runtime::Node& node) : node_(node) {}

  void open(const std::vector<PlayChannel>& channels,
            const std::vector<std::size_t>& order) override {
    writers_.resize(channels.size());
    for (const std::size_t i : order) {
      const PlayChannel& channel = channels[i];
      const auto qos = channel.qos.transient_local ? runtime::Qos::kStateLatched
                       : channel.qos.reliable      ? runtime::Qos::kEvent
                                                   : runtime::Qos::kSensorStream;
      types_.push_back(std::make_unique<runtime::RawMessageType>(channel.dds_type, channel.keyed));
      // The component's transport puts the prefix before the name itself.
      writers_[i] = node_.create_writer(channel.topic.substr(1), *types_.back(), qos);
    }
  }
  bool write(const PlayMessage& message) override {
    return writers_[message.channel]->write(&message.bytes);
  }
  bool is_matched(const std::vector<std::string>&) override { return true; }
  void wait_for_acknowledgments(Duration) override {}

 private:
  runtime::Node& node_;
  std::vector<std::unique_ptr<runtime::RawMessageType>> types_;
  std::vector<std::shared_ptr<runtime::Writer>> writers_;
};

}  // namespace

std::unique_ptr<PlayOutput> make_wire_output(runtime::Node& node, bool reliable) {
  return std::make_unique<WireOutput>(node, reliable);
}

std::unique_ptr<PlayOutput> make_lockstep_output(runtime::Node& node) {
  return std::make_unique<LockstepOutput>(node);
}

}  // namespace coop::capture
