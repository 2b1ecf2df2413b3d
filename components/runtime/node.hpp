#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/random.hpp"
#include "core/time.hpp"
#include "core/transform_buffer.hpp"
#include "runtime/executor.hpp"
#include "runtime/log.hpp"
#include "runtime/options.hpp"
#include "runtime/pacing.hpp"
#include "runtime/transport.hpp"

namespace coop_msgs::msg {
class LockstepRoster;
}

namespace coop::runtime {

/// Writes messages of one topic. Lives within the component that advertised it.
template <class Message>
class Publisher {
 public:
  Publisher() = default;
  explicit Publisher(std::shared_ptr<Writer> writer) : writer_(std::move(writer)) {}
  /// False when a reliable reader is too slow and the history is full.
  bool publish(const Message& message) { return writer_->write(&message); }
  /// For messages that are dear to make: is anybody listening?
  [[nodiscard]] bool has_subscribers() const { return writer_->matched_readers() > 0; }
  [[nodiscard]] int subscribers() const { return writer_->matched_readers(); }
  /// True when every reliable reader has acknowledged everything; waits for it, by wall time.
  bool wait_for_acknowledgments(Duration timeout) {
    return writer_->wait_for_acknowledgments(timeout);
  }

 private:
  std::shared_ptr<Writer> writer_;
};

/// Identity of the writer of the message being handled, for callbacks that must tell writers apart.
struct MessageInfo {
  std::string_view writer;
  std::uint64_t sequence = 0;
};

enum class Health { kStarting, kReady, kDegraded, kStopping, kFinished };
[[nodiscard]] std::string_view to_string(Health health);

/// How soon a sample must be handled.
///  - kAtOnce: the component acts on it.
///  - kPatient: the callback only keeps it, for what the component does at its own times. In
///  lockstep
///    the component is not given a turn for its sake alone, which spares most of the turns.
enum class Attention { kAtOnce, kPatient };

/// The front door of the runtime: what a component sees of the world. All callbacks run on one
/// thread, one at a time.
class Node {
 public:
  Node(const Options& options, Transport& transport, const Clock& clock, Executor& executor);
  ~Node();
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  template <class Message>
  [[nodiscard]] Publisher<Message> advertise(const std::string& topic, Qos qos) {
    return Publisher<Message>(create_writer(topic, message_type<Message>(), qos));
  }

  /// The callback takes (const Message&) or (const Message&, const MessageInfo&).
  template <class Message, class Callback>
  void subscribe(const std::string& topic, Qos qos, Callback callback,
                 Attention attention = Attention::kAtOnce) {
    add_subscription(topic, message_type<Message>(), qos, attention,
                     [callback = std::move(callback)](const Sample& sample) mutable {
                       const auto& message = *static_cast<const Message*>(sample.message.get());
                       if constexpr (std::is_invocable_v<Callback&, const Message&>) {
                         callback(message);
                       } else {
                         callback(message, MessageInfo{sample.writer, sample.sequence});
                       }
                     });
  }

  /// By the component's clock; first call one period from now.
  void every(Duration period, std::function<void()> callback);
  /// The same at the multiples of `period` on the clock.
  void every_aligned(Duration period, std::function<void()> callback);

  /// For the one program that is the master of time: its world makes steps at the pace wanted, or,
  /// in lockstep, when everybody is done with the step before. Called once, in the constructor.
  void lead_time(TimeLead lead);
  [[nodiscard]] const std::optional<TimeLead>& time_lead() const;

  /// System time, or the time of /clock with --sim-time: Time{} until its first message.
  [[nodiscard]] Time now() const;
  /// The number stream of one purpose within this component.
  [[nodiscard]] RandomStream random(std::string_view purpose) const;
  [[nodiscard]] Logger& log();
  [[nodiscard]] const Options& options() const;
  [[nodiscard]] const std::string& name() const { return options().name; }

  /// Fed from tf and tf_static; subscribed to at the first call, so call it in the constructor.
  /// `history` counts at that first call: how long samples are kept behind the newest of their
  /// frame.
  [[nodiscard]] const TransformBuffer& transforms(Duration history = std::chrono::seconds(15));
  /// Call it in the constructor where transforms are published only later.
  void advertise_transforms();
  void publish_transform(std::string_view parent, std::string_view child, Time stamp,
                         const Pose3& child_in_parent);
  void publish_transform(std::string_view parent, std::string_view child, Time stamp,
                         const Pose2& child_in_parent);
  /// All static transforms this component published so far travel together, latched.
  void publish_static_transform(std::string_view parent, std::string_view child,
                                const Pose3& child_in_parent);

  /// The runtime reports `ready` when the component's constructor returns. While inputs are missing
  /// or a device fails: degraded with the reason, and back to ready. Repeating the same state costs
  /// nothing.
  void set_ready();
  void set_degraded(const std::string& reason);
  [[nodiscard]] Health health() const;

  /// From within one callback that works for long, often: the heart beats on.
  void keep_alive();

  /// Ends the program with exit code 0 after an orderly stop (a log played to its end).
  void finish(const std::string& reason);
  /// Ends the program with exit code 1 after an orderly stop.
  void fail(const std::string& reason);
  /// Called once when the program stops, after all inputs at hand were handled: last outputs,
  /// files.
  void on_stop(std::function<void()> callback);
  /// Called when the clock was set back (simulator started anew, log looped).
  void on_clock_jump(std::function<void()> callback);

  /// As advertise(), for messages of which only `type` knows what they are; it must outlive the
  /// writer.
  [[nodiscard]] std::shared_ptr<Writer> create_writer(const std::string& topic,
                                                      const MessageType& type, Qos qos);
  /// For programs that handle more than topics: inputs of other kinds, timers of the steady clock.
  [[nodiscard]] Executor& executor();

  /// Whether a lockstep may go on with this roster, for a program that listens without taking part
  /// in the ticks and must not miss a sample.
  using RoundCondition = std::function<bool(const coop_msgs::msg::LockstepRoster& roster)>;
  void hold_rounds_until(RoundCondition condition);
  [[nodiscard]] const RoundCondition& round_condition() const;

  // For the program around the component (run.cpp, test support).
  void set_starting();
  void stop();
  [[nodiscard]] bool wants_to_end() const;
  [[nodiscard]] int exit_code() const;
  void handle_clock_jump();
  /// The system's clock was set by `change`: nothing that runs by it may wait until it is again as
  /// late as it was. Under simulated time nothing does.
  void handle_system_clock_set(Duration change);

 private:
  void add_subscription(const std::string& topic, const MessageType& type, Qos qos,
                        Attention attention, std::function<void(const Sample&)> callback);
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace coop::runtime
