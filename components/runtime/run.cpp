#include "runtime/run.hpp"

#include "conversions/time.hpp"
#include "rosgraph_msgs/msg/Clock.h"
#include "runtime/dds_transport.hpp"
#include "runtime/lockstep/follower.hpp"
#include "runtime/lockstep/master.hpp"
#include "runtime/security_keys.hpp"
#include "runtime/stop_signal.hpp"

namespace coop::runtime {
namespace {

/// How long a world that has come to its end waits for those who still work on its last tick.
constexpr auto kLastTick = std::chrono::seconds(5);

config::Document load_document(const Options& options) {
  config::Document document =
      options.config.empty() ? config::Document() : config::Document::load(options.config);
  for (const std::string& setting : options.settings) document.set(setting);
  return document;
}

/// The clock was moved, for the first time or back.
void set_clock(Node& node, ManualClock& clock, Time time) {
  const Time before = clock.now();
  clock.set(time);
  if (before == Time{} || time < before) node.handle_clock_jump();
}

/// Follows /clock. Steps of the clock wake the executor by themselves (they are inputs).
class ClockFollower {
 public:
  ClockFollower(Node& node, ManualClock& clock) {
    node.subscribe<rosgraph_msgs::msg::Clock>(
        "clock", Qos::kEvent, [&node, &clock](const rosgraph_msgs::msg::Clock& message) {
          const auto time = conversions::from_msg(message);
          if (time) set_clock(node, clock, *time);
        });
  }
};

void run_until_stopped(Executor& executor, Node& node, Transport& transport) {
  ClockSettings settings;
  while (!StopSignal::requested() && !node.wants_to_end()) {
    const Duration change = settings.change(SystemClock().now(), Executor::Wall::now());
    if (change != Duration{0}) node.handle_system_clock_set(change);
    if (const auto why = transport.mend()) node.log().warning("{}", *why);
    executor.wait_and_run(std::chrono::milliseconds(500));
  }
}

/// By system time or the topic clock.
int run_freely(const Options& options, const Program& program, const config::Document& document,
               Transport& transport) {
  const SystemClock system_clock;
  ManualClock sim_clock;
  const Clock& clock = options.sim_time ? static_cast<const Clock&>(sim_clock)
                                        : static_cast<const Clock&>(system_clock);
  Executor executor(clock);
  const StopSignal stop(executor);
  Node node(options, transport, clock, executor);
  node.set_starting();
  std::unique_ptr<ClockFollower> follower;
  if (options.sim_time) follower = std::make_unique<ClockFollower>(node, sim_clock);
  const std::shared_ptr<void> component = program.start(node, document);
  if (node.health() == Health::kStarting) node.set_ready();
  run_until_stopped(executor, node, transport);
  node.stop();
  return node.exit_code();
}

int follow_lockstep(const Options& options, const Program& program,
                    const config::Document& document, Transport& carrier,
                    LockstepTransport& transport) {
  ManualClock clock;
  Executor executor(clock);
  const StopSignal stop(executor);
  LockstepFollower follower(executor, carrier, transport, options.name);
  Node node(options, transport, clock, executor);
  node.set_starting();
  const std::shared_ptr<void> component = program.start(node, document);
  if (node.health() == Health::kStarting) node.set_ready();
  follower.hold_until(node.round_condition());
  follower.join(node.log(), [&](Time time) { set_clock(node, clock, time); });
  run_until_stopped(executor, node, transport);
  node.stop();
  follower.leave();
  return node.exit_code();
}

int lead_lockstep(const Options& options, const Program& program, const config::Document& document,
                  Transport& carrier, LockstepTransport& transport) {
  ManualClock clock;
  Executor executor(clock);
  const StopSignal stop(executor);
  LockstepMaster master(executor, carrier, transport, options.name, options.members);
  Node node(options, transport, clock, executor);
  node.set_starting();
  const std::shared_ptr<void> component = program.start(node, document);
  if (!node.time_lead())
    throw std::runtime_error("in lockstep it needs --sim-time: it is no master of time");
  if (node.health() == Health::kStarting) node.set_ready();
  TimeLead lead = *node.time_lead();
  lead.step = [&clock, step = std::move(lead.step)] {
    const Time reached = step();
    clock.set(reached);
    return reached;
  };
  master.start(node, lead);
  run_until_stopped(executor, node, transport);
  const auto patience = Executor::Wall::now() + kLastTick;
  while (!master.finish() && !StopSignal::requested() && Executor::Wall::now() < patience) {
    executor.wait_and_run(std::chrono::milliseconds(10));
  }
  node.stop();
  return node.exit_code();
}

int run_component(const Options& options, const Program& program, const config::Document& document,
                  const DdsSettings& settings) {
  DdsTransport carrier({.domain = options.domain,
                        .participant_name = options.name,
                        .partition = options.robot,
                        .reliable_streams = options.reliable_streams,
                        .complete = options.lockstep,
                        .settings = settings});
  if (!options.lockstep) return run_freely(options, program, document, carrier);
  std::optional<SampleTrace> trace;
  if (options.trace) trace.emplace(options.run_dir, options.name);
  LockstepTransport transport(carrier, options.name, trace ? &*trace : nullptr);
  return options.sim_time ? follow_lockstep(options, program, document, carrier, transport)
                          : lead_lockstep(options, program, document, carrier, transport);
}

}  // namespace

int run_program(int argc, const char* const* argv, const Program& program) {
  int exit_code = 0;
  const auto options = parse_options(argc, argv, program.name, program.description, exit_code);
  if (!options) return exit_code;
  try {
    if (options->mode == Options::Mode::kPrintTable) {
      std::cout << program.print_table();
      return 0;
    }
    const config::Document document = load_document(*options);
    const DdsSettings settings = read_dds_settings_of(options->name, options->dds);
    program.check(document);
    if (options->mode == Options::Mode::kCheck) return 0;
    if (options->mode == Options::Mode::kPrintConfig) {
      std::cout << program.print_config(document);
      return 0;
    }
    return run_component(*options, program, document, settings);
  } catch (const std::exception& problem) {
    std::cerr << options->name << ": " << problem.what() << '\n';
    return 1;
  }
}

}  // namespace coop::runtime
