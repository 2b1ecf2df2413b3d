#pragma once
#include <memory>
#include <string>
#include <vector>

#include "coop_msgs/msg/LockstepMark.h"
#include "coop_msgs/msg/LockstepRoster.h"
#include "runtime/lockstep/sample_trace.hpp"
#include "runtime/transport.hpp"

namespace coop::runtime {

/// Puts a gate before every reader of a component and counts what its writers write, so that a
/// component sees exactly the samples of its tick, whatever the network does. All endpoints are
/// made before describe(): one made later would miss what was written before it was matched.
///
/// Heartbeats pass ungated: they tell of processes, by system time.
class LockstepTransport : public Transport {
 public:
  /// `carrier` must keep every sample (DdsOptions::complete). `trace` may be null.
  LockstepTransport(Transport& carrier, std::string component, SampleTrace* trace);
  ~LockstepTransport() override;

  std::unique_ptr<Writer> create_writer(const std::string& topic, const MessageType& type,
                                        Qos qos) override;
  std::unique_ptr<Reader> create_reader(const std::string& topic, const MessageType& type, Qos qos,
                                        std::function<void()> on_data) override;
  [[nodiscard]] std::shared_ptr<void> on_match(std::function<void()> callback) override;

  /// Endpoints of the lockstep itself: matched like all others before a round begins, but neither
  /// gated nor counted.
  std::unique_ptr<Writer> create_control_writer(const std::string& topic, const MessageType& type);
  std::unique_ptr<Reader> create_control_reader(const std::string& topic, const MessageType& type,
                                                std::function<void()> on_data);

  /// Name and endpoints with their present sequence numbers. No endpoint may be made from now on.
  [[nodiscard]] coop_msgs::msg::LockstepMember describe(std::uint64_t incarnation);
  /// Whether every endpoint is matched with all its counterparts of the roster.
  [[nodiscard]] bool is_matched(const coop_msgs::msg::LockstepRoster& roster) const;
  /// The writers of the roster, and no others, are heard in lockstep from now on.
  void adopt(const coop_msgs::msg::LockstepRoster& roster);

  void expect(const coop_msgs::msg::LockstepMark& mark);
  /// Takes in what has arrived; true when all samples expected are there. From a false answer on,
  /// until the next true one, arriving samples wake the component.
  bool collect();
  /// What is waited for, for people.
  [[nodiscard]] std::string missing() const;
  /// Goes on without the samples that are missing: a writer lost sight of this reader for a while.
  void forgo_missing();
  /// Lets the samples of the tick out to the readers.
  void release(std::uint64_t tick);
  /// Topics on which samples came from outside the lockstep since the last call.
  [[nodiscard]] std::vector<std::string> take_outside_topics();
  /// Marks of the writers that have written since the last call.
  [[nodiscard]] std::vector<coop_msgs::msg::LockstepMark> take_published();

 private:
  struct Shared;
  class GatedReader;
  class CountedWriter;
  std::shared_ptr<Shared> shared_;
};

}  // namespace coop::runtime
