#pragma once
#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "runtime/executor.hpp"
#include "runtime/raw_participant.hpp"

namespace coop::capture {

/// Listens to every topic that is wanted, as its writers come and go: finds them, makes readers
/// that ask for just what is offered, and hands their samples on. No writer ever waits for it.
///
/// Writers of one topic may offer different things: then the topic has several readers, and each
/// sample is taken from the one that fits its writer.
class TrafficTap : public runtime::InputSource {
 public:
  struct Listener {
    /// Which writers are heard; asked once each, on the executor.
    std::function<bool(const runtime::DiscoveredEndpoint&)> wants;
    /// A writer that is heard from now on; the answer is given with its samples. On the executor.
    std::function<const void*(const runtime::DiscoveredEndpoint&)> on_writer;
    /// On the thread that received it, one at a time. Must be quick.
    std::function<void(const void* writer, const runtime::RawSample&)> on_sample;
    /// A writer that was heard is gone. On the executor.
    std::function<void(const void* writer)> on_gone;
    /// Something cannot be heard, for people. On the executor.
    std::function<void(const std::string&)> on_problem;
  };

  /// `wake`: from any thread, when handle_one() has something to do.
  TrafficTap(const runtime::DdsOptions& options, std::function<void()> wake, Listener listener);

  /// On the executor: takes in news of discovery.
  bool handle_one() override;
  /// Whether samples of all these writers (by id) arrive from now on, leaving out those that are
  /// not wanted.
  [[nodiscard]] bool hears_all(const std::vector<std::string>& writers) const;
  /// Whether somebody's samples on this topic (on the wire) arrive, or its writers are not wanted.
  [[nodiscard]] bool hears_topic(const std::string& topic) const;
  [[nodiscard]] int writers() const { return static_cast<int>(routes_.size()); }

 private:
  /// What a reader is made for: topic, type, reliable, transient_local.
  using ReaderKey = std::tuple<std::string, std::string, bool, bool>;
  struct Route {
    const ReaderKey* reader = nullptr;
    const void* writer = nullptr;
    std::string id;
  };
  struct DiscoveredTopic {
    std::string id;
    std::string topic;
  };
  struct Early {
    const ReaderKey* reader;
    runtime::RawSample sample;
  };
  void take(const runtime::DiscoveryEvent& event);
  void add(const runtime::DiscoveredEndpoint& endpoint);
  void receive(const ReaderKey* reader, runtime::RawSample&& sample);
  [[nodiscard]] bool is_heard(const runtime::EndpointId& id, const Route& route) const;

  std::string partition_;
  Listener listener_;
  std::atomic<bool> has_news_ = false;
  std::function<void()> wake_;
  mutable std::mutex mutex_;
  std::map<runtime::EndpointId, Route> routes_;
  std::vector<Early> early_;  ///< of writers that discovery has not told of yet
  std::map<runtime::EndpointId, DiscoveredTopic> unwanted_;
  std::set<std::string> complained_;
  runtime::RawParticipant participant_;
  std::map<ReaderKey, std::unique_ptr<runtime::RawReader>> readers_;
};

}  // namespace coop::capture
