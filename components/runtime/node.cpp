#include "runtime/node.hpp"

#include <vector>

#include "coop_msgs/msg/ComponentStatus.h"
#include "runtime/health_reporter.hpp"
#include "runtime/transform_topics.hpp"

namespace coop::runtime {
namespace {

/// From here on a system clock that is set back is a jump for the component as well.
constexpr Duration kStepBack = std::chrono::seconds(1);

/// How long a program that ends waits, in all, for readers that have missed its last messages.
constexpr std::chrono::milliseconds kLastWords{500};

/// Takes from a reader and calls back.
class Subscription : public InputSource {
 public:
  Subscription(Transport& transport, Executor& executor, const std::string& topic,
               const MessageType& type, Qos qos, Attention attention,
               std::function<void(const Sample&)> callback)
      : callback_(std::move(callback)),
        reader_(transport.create_reader(topic, type, qos, [&executor] { executor.wake(); })) {
    if (attention == Attention::kPatient) reader_->be_patient();
  }

  bool handle_one() override {
    Sample sample;
    if (!reader_->take(sample)) return false;
    callback_(sample);
    return true;
  }

 private:
  std::function<void(const Sample&)> callback_;
  std::unique_ptr<Reader> reader_;
};

}  // namespace

struct Node::Impl {
  Options options;
  Transport& transport;
  const Clock& clock;
  Executor& executor;
  Logger log;
  std::unique_ptr<HealthReporter> health;
  std::vector<std::unique_ptr<Subscription>> subscriptions;
  std::unique_ptr<TransformListener> listener;
  std::unique_ptr<TransformPublisher> transform_publisher;
  /// Their last message must arrive: nobody repeats it once the program is gone.
  std::vector<std::weak_ptr<Writer>> lasting_writers;
  std::vector<std::function<void()>> stop_callbacks;
  std::vector<std::function<void()>> jump_callbacks;
  std::optional<TimeLead> lead;
  std::optional<Pacing> pacing;
  RoundCondition round_condition;
  bool wants_to_end = false;
  int exit_code = 0;

  Impl(const Options& wanted, Transport& carrier, const Clock& time, Executor& runner)
      : options(wanted),
        transport(carrier),
        clock(time),
        executor(runner),
        log(wanted.name, time, wanted.log_dir, wanted.verbose ? Level::kDebug : Level::kInfo) {}

  void run_due_steps() {
    const Duration lost_before = pacing->lost();
    const int due = pacing->due(clock.now());
    for (int i = 0; i < due; ++i) lead->step();
    if (pacing->lost() > lost_before && log.is_due("lag", std::chrono::seconds(10))) {
      log.warning("cannot keep up: {:.1f} s lost so far", to_seconds(pacing->lost()));
    }
  }

  void deliver_last_words() {
    const auto limit = Executor::Wall::now() + kLastWords;
    for (const std::weak_ptr<Writer>& known : lasting_writers) {
      const auto writer = known.lock();
      if (!writer) continue;
      const Duration left = std::max(limit - Executor::Wall::now(), Executor::Wall::duration(0));
      if (!writer->wait_for_acknowledgments(left)) {
        log.warning("a reader has not acknowledged everything of the last messages");
        return;
      }
    }
  }

  TransformPublisher& broadcaster(Node& node) {
    if (!transform_publisher) transform_publisher = std::make_unique<TransformPublisher>(node);
    return *transform_publisher;
  }
};

Node::Node(const Options& options, Transport& transport, const Clock& clock, Executor& executor)
    : impl_(std::make_unique<Impl>(options, transport, clock, executor)) {
  impl_->health = std::make_unique<HealthReporter>(
      impl_->options,
      create_writer("component_status", message_type<coop_msgs::msg::ComponentStatus>(),
                    Qos::kHeartbeat));
  executor.add_wall_timer(std::chrono::milliseconds(500), [this] { impl_->health->beat(); });
}

Node::~Node() {
  for (const auto& subscription : impl_->subscriptions) {
    impl_->executor.remove_source(*subscription);
  }
}

std::shared_ptr<Writer> Node::create_writer(const std::string& topic, const MessageType& type,
                                            Qos qos) {
  std::shared_ptr<Writer> writer = impl_->transport.create_writer(topic, type, qos);
  if (qos == Qos::kStateLatched || qos == Qos::kEvent) impl_->lasting_writers.push_back(writer);
  return writer;
}

void Node::add_subscription(const std::string& topic, const MessageType& type, Qos qos,
                            Attention attention, std::function<void(const Sample&)> callback) {
  impl_->subscriptions.push_back(std::make_unique<Subscription>(
      impl_->transport, impl_->executor, topic, type, qos, attention, std::move(callback)));
  impl_->executor.add_source(*impl_->subscriptions.back());
}

void Node::every(Duration period, std::function<void()> callback) {
  impl_->executor.add_timer(period, std::move(callback));
}

void Node::every_aligned(Duration period, std::function<void()> callback) {
  impl_->executor.add_timer(period, std::move(callback), true);
}

void Node::lead_time(TimeLead lead) {
  if (options().sim_time) {
    throw std::runtime_error(
        "the master of time cannot follow a clock: start it without --sim-time");
  }
  impl_->lead = std::move(lead);
  if (options().lockstep) return;
  impl_->pacing.emplace(impl_->lead->rate, impl_->lead->period);
  every(impl_->pacing->period(), [this] { impl_->run_due_steps(); });
}

const std::optional<TimeLead>& Node::time_lead() const {
  return impl_->lead;
}

Time Node::now() const {
  return impl_->clock.now();
}

RandomStream Node::random(std::string_view purpose) const {
  return {impl_->options.seed, impl_->options.name + "/" + std::string(purpose)};
}

Logger& Node::log() {
  return impl_->log;
}
const Options& Node::options() const {
  return impl_->options;
}

const TransformBuffer& Node::transforms(Duration history) {
  if (!impl_->listener) impl_->listener = std::make_unique<TransformListener>(*this, history);
  return impl_->listener->buffer();
}

void Node::advertise_transforms() {
  impl_->broadcaster(*this).advertise_moving();
}

void Node::publish_transform(std::string_view parent, std::string_view child, Time stamp,
                             const Pose3& child_in_parent) {
  impl_->broadcaster(*this).publish(
      {stamp, std::string(parent), std::string(child), child_in_parent});
}

void Node::publish_transform(std::string_view parent, std::string_view child, Time stamp,
                             const Pose2& child_in_parent) {
  publish_transform(parent, child, stamp, to_pose3(child_in_parent));
}

void Node::publish_static_transform(std::string_view parent, std::string_view child,
                                    const Pose3& child_in_parent) {
  impl_->broadcaster(*this).publish_static(
      {now(), std::string(parent), std::string(child), child_in_parent});
}

void Node::set_starting() {
  const std::string problem = impl_->health->leave_file(impl_->options);
  if (!problem.empty()) impl_->log.warning("no state for `coop health`: {}", problem);
}
void Node::set_ready() {
  impl_->health->report(Health::kReady, "");
}

void Node::set_degraded(const std::string& reason) {
  const bool is_new = health() != Health::kDegraded || impl_->health->detail() != reason;
  if (is_new) impl_->log.warning("degraded: {}", reason);
  impl_->health->report(Health::kDegraded, reason);
}

void Node::keep_alive() {
  impl_->health->beat_if_due();
}

Health Node::health() const {
  return impl_->health->health();
}

void Node::finish(const std::string& reason) {
  if (impl_->wants_to_end) return;
  impl_->log.info("finished: {}", reason);
  impl_->health->report(Health::kFinished, reason);
  impl_->wants_to_end = true;
}

void Node::fail(const std::string& reason) {
  if (impl_->wants_to_end) return;
  impl_->log.error("{}", reason);
  impl_->health->report(Health::kStopping, reason);
  impl_->exit_code = 1;
  impl_->wants_to_end = true;
}

void Node::on_stop(std::function<void()> callback) {
  impl_->stop_callbacks.push_back(std::move(callback));
}

void Node::on_clock_jump(std::function<void()> callback) {
  impl_->jump_callbacks.push_back(std::move(callback));
}

void Node::handle_clock_jump() {
  impl_->executor.on_clock_jump();
  if (impl_->listener) impl_->listener->clear();
  for (const auto& callback : impl_->jump_callbacks) callback();
}

void Node::handle_system_clock_set(Duration change) {
  if (!impl_->clock.is_system()) return;
  impl_->log.warning("the system's clock was set by {:.2f} s", to_seconds(change));
  if (impl_->pacing) impl_->pacing->restart();
  // What is stamped after a small step back still sorts into what was before.
  if (change <= -kStepBack) {
    handle_clock_jump();
  } else {
    impl_->executor.on_clock_jump();
  }
}

void Node::stop() {
  if (health() != Health::kFinished) impl_->health->report(Health::kStopping, "");
  impl_->executor.run_inputs();
  for (const auto& callback : impl_->stop_callbacks) callback();
  impl_->stop_callbacks.clear();
  impl_->deliver_last_words();
}

Executor& Node::executor() {
  return impl_->executor;
}

void Node::hold_rounds_until(RoundCondition condition) {
  impl_->round_condition = std::move(condition);
}

const Node::RoundCondition& Node::round_condition() const {
  return impl_->round_condition;
}

bool Node::wants_to_end() const {
  return impl_->wants_to_end;
}
int Node::exit_code() const {
  return impl_->exit_code;
}

}  // namespace coop::runtime
