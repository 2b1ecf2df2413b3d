#include "launcher/session.hpp"

#include <unistd.h>

#include <csignal>
#include <cstring>
#include <fstream>
#include <iostream>

#include "launcher/component_check.hpp"
#include "launcher/compose.hpp"
#include "launcher/control_server.hpp"
#include "launcher/dds_base.hpp"
#include "launcher/dds_health.hpp"
#include "launcher/display.hpp"
#include "launcher/process_table.hpp"
#include "launcher/process_usage.hpp"
#include "launcher/run_folder.hpp"
#include "launcher/service_notifier.hpp"
#include "launcher/system_lock.hpp"
#include "runtime/dds_transport.hpp"
#include "runtime/security_keys.hpp"

namespace coop::launcher {
namespace {

/// A system that already runs is heard within this time: matching takes 24-34 ms, and
/// component_status is latched.
constexpr std::chrono::milliseconds kListen{400};
/// Among the participants, and in the folder of keys.
constexpr const char* kLauncherName = "launcher";

/// Of the table, and of the measurement of processor use.
constexpr std::chrono::milliseconds kRefresh{500};

Instant now() {
  return std::chrono::steady_clock::now();
}

double seconds_since(Instant begin) {
  return std::chrono::duration<double>(now() - begin).count();
}

void check_all(const Plan& plan) {
  const std::vector<std::string> refusals = check_components(plan);
  if (refusals.empty()) return;
  std::string text = refusals.front();
  for (std::size_t i = 1; i < refusals.size(); ++i) text += "\n" + refusals[i];
  throw config::Error(text);
}

/// One running system: the supervisor and everything that feeds it events.
class Session {
 public:
  Session(const UpOptions& options, const Launch& launch, const Plan& plan, RunFolder& folder,
          HealthSource& health, Base* base, SignalFile& signals)
      : options_(options),
        launch_(launch),
        folder_(folder),
        health_(health),
        signals_(signals),
        display_(make_display(stdout, options.quiet)),
        event_log_(folder.path() / "launcher.log"),
        processes_(loop_, folder.logs(),
                   [this](const std::string& name, std::string_view data) {
                     display_->output(name, data);
                   }),
        supervisor_(
            plan, processes_,
            [this](const std::string& name, const std::string& text) { report(name, text); }, base),
        control_(loop_, launch.robot, launch.domain,
                 [this](const ControlRequest& request) { return handle(request); }) {
    loop_.watch(signals_.fd(), [this] { take_signals(); });
    loop_.watch(health_.wake_fd(), [this] { take_heartbeats(); });
  }

  void watch_mission(runtime::Transport& transport) {
    mission_.emplace(transport);
    loop_.watch(mission_->wake_fd(), [this] { take_mission_end(); });
  }
  void answer_for(SystemLock& lock) { lock.serve(loop_); }

  Outcome run() {
    report("", "starting " + system_name(launch_.robot, launch_.domain) + ", " +
                   folder_.path().string());
    supervisor_.start(now());
    while (!supervisor_.done()) {
      loop_.run_once(next_deadline());
      supervisor_.tick(now());
      check_milestones();
      service_.tick(supervisor_.required_are_up(), now());
      if (supervisor_.shutting_down()) service_.stopping();
      if (now() >= next_refresh_) {
        display_->refresh(
            view());  // also where nothing is drawn: processor use is measured between two views
        next_refresh_ = now() + kRefresh;
      }
    }
    Outcome outcome = supervisor_.outcome();
    display_->refresh(view());
    display_->end();
    report("", "stopped: " + outcome.reason);
    return outcome;
  }

 private:
  [[nodiscard]] std::optional<Instant> next_deadline() const {
    // Also woken when nothing is due, so that a pause of our own is noticed as one.
    Instant next = std::min(next_refresh_, supervisor_.next_deadline().value_or(Instant::max()));
    if (options_.timeout && !supervisor_.shutting_down()) next = std::min(next, time_limit());
    return next;
  }

  [[nodiscard]] Instant time_limit() const {
    return begin_ + std::chrono::milliseconds(static_cast<long>(*options_.timeout * 1e3));
  }

  void check_milestones() {
    if (!were_ready_ && supervisor_.all_ready()) {
      were_ready_ = true;
      report("", "all " + std::to_string(supervisor_.view().size()) + " components ready");
    }
    if (options_.until == "ready" && supervisor_.all_ready()) {
      supervisor_.shut_down({kExitOk, "all components were ready"}, now());
    }
    if (options_.timeout && now() >= time_limit()) {
      supervisor_.shut_down(
          {kExitTimeout, "not done within the time limit of " +
                             std::to_string(static_cast<long>(*options_.timeout)) + " s"},
          now());
    }
  }

  void report(const std::string& component, const std::string& text) {
    const double at = seconds_since(begin_);
    event_log_ << event_line(at, component, text) << std::endl;
    display_->event(at, component, text);
  }

  void take_signals() {
    while (const auto number = signals_.take()) {
      if (*number == SIGCHLD) continue;
      if (supervisor_.shutting_down() && *number == SIGINT) {
        report("", "killing what is left");
        supervisor_.kill_all();
      }
      supervisor_.shut_down({kExitOk, sigdescr_np(*number)}, now());
    }
    for (const auto& exit : processes_.reap()) supervisor_.on_exit(exit.pid, exit.status, now());
  }

  void take_heartbeats() {
    for (const Heartbeat& heartbeat : health_.take()) supervisor_.on_heartbeat(heartbeat, now());
    if (const auto why = health_.mended()) report("", *why);
  }

  void take_mission_end() {
    const auto end = mission_->take();
    if (!end) return;
    const std::string detail = end->detail.empty() ? "" : ": " + end->detail;
    supervisor_.shut_down(end->success ? Outcome{kExitOk, "mission done" + detail}
                                       : Outcome{kExitMissionFailed, "mission failed" + detail},
                          now());
  }

  ControlReply handle(const ControlRequest& request) {
    ControlReply reply;
    Result<void> result;
    if (request.verb == "ps") {
      reply.system = view();
    } else if (request.verb == "restart") {
      result = supervisor_.restart(request.name, now());
    } else if (request.verb == "stop") {
      result = supervisor_.stop(request.name, now());
    } else if (request.verb == "start") {
      result = supervisor_.start(request.name, now());
    } else if (request.verb == "down") {
      supervisor_.shut_down({kExitOk, "asked to"}, now());
    } else {
      result = fail("no verb '" + request.verb + "'");
    }
    if (!result) {
      reply.ok = false;
      reply.error = result.error();
    }
    return reply;
  }

  [[nodiscard]] SystemView view() {
    SystemView system{.robot = launch_.robot,
                      .domain = launch_.domain,
                      .launcher = getpid(),
                      .launch_file = launch_.file.string(),
                      .run_folder = folder_.path().string(),
                      .uptime = seconds_since(begin_),
                      .rows = {}};
    for (const ComponentView& component : supervisor_.view()) {
      Row row{.name = component.name,
              .state = std::string(name_of(component.state)),
              .pid = component.pid,
              .uptime = component.pid != 0 ? seconds_since(component.since) : 0.0,
              .restarts = component.restarts,
              .detail = component.detail};
      if (const auto usage =
              component.pid != 0 ? meter_.sample(component.pid, now()) : std::nullopt) {
        row.cpu = usage->cpu;
        row.resident = usage->resident;
      }
      system.rows.push_back(std::move(row));
    }
    return system;
  }

  const UpOptions& options_;
  const Launch& launch_;
  RunFolder& folder_;
  HealthSource& health_;
  SignalFile& signals_;
  const Instant begin_ = now();
  std::unique_ptr<Display> display_;
  std::ofstream event_log_;
  EventLoop loop_;
  ProcessTable processes_;
  Supervisor supervisor_;
  ControlServer control_;
  ServiceNotifier service_{begin_};
  UsageMeter meter_;
  std::optional<MissionWatch> mission_;
  Instant next_refresh_ = begin_;
  bool were_ready_ = false;
};

/// Throws where a component of this name already lives on the domain, wherever it was started.
void refuse_strangers(HealthSource& health, const Plan& plan, Instant until) {
  EventLoop loop;
  std::vector<Heartbeat> heard;
  loop.watch(health.wake_fd(), [&] {
    for (Heartbeat& heartbeat : health.take()) heard.push_back(std::move(heartbeat));
  });
  while (now() < until) loop.run_once(until);
  for (const Heartbeat& heartbeat : heard) {
    const bool gone =
        heartbeat.health == Health::kStopping || heartbeat.health == Health::kFinished;
    for (const PlannedComponent& component : plan.components) {
      if (gone || component.name != heartbeat.component) continue;
      throw InUse(system_name(plan.robot, plan.domain) + " is in use: a component '" +
                  heartbeat.component + "' already runs there, pid " +
                  std::to_string(heartbeat.pid) + " on " + heartbeat.host +
                  "; choose another domain with --domain");
    }
  }
}

}  // namespace

Outcome run_system(const UpOptions& options) {
  const Places places = Places::of_this_program();
  const Launch launch = load_launch(find_launch_file(options.file, places), options.overrides);
  RunFolder folder(launch.run_dir);
  const Plan plan = make_plan(launch, places, folder.path());
  // What is wrong with all keys is said once.
  const auto dds = runtime::read_dds_settings_of(kLauncherName, plan.dds.assignments());
  // Before the middleware starts its threads, so that none of them takes a signal.
  SignalFile signals{SIGINT, SIGTERM, SIGHUP, SIGCHLD};
  auto lock = SystemLock::acquire(launch.robot, launch.domain);
  if (!lock) throw InUse(lock.error());
  runtime::DdsTransport transport({.domain = launch.domain,
                                   .participant_name = kLauncherName,
                                   .partition = launch.robot,
                                   .reliable_streams = launch.reliable_streams,
                                   .settings = dds});
  DdsHealth health(transport);
  // In lockstep a message from outside would change the run, and no real base runs in it.
  std::optional<DdsBase> base;
  if (!launch.lockstep) base.emplace(transport);
  const Instant listen_until = now() + kListen;
  check_all(plan);
  refuse_strangers(health, plan, listen_until);
  folder.keep();
  std::ofstream(folder.path() / "launch.yaml") << config::to_yaml(launch);
  Session session(options, launch, plan, folder, health, base ? &*base : nullptr, signals);
  session.answer_for(*lock);
  if (options.until == "mission-done") session.watch_mission(transport);
  return session.run();
}

void check_system(const UpOptions& options) {
  const Places places = Places::of_this_program();
  const Launch launch = load_launch(find_launch_file(options.file, places), options.overrides);
  // Nothing is written into a run folder by a check, so there need not be one.
  const Plan plan = make_plan(launch, places, std::filesystem::path(launch.run_dir) / "check");
  (void)runtime::read_dds_settings_of(kLauncherName, plan.dds.assignments());
  check_all(plan);
}

std::string compose_system(const UpOptions& options, const std::string& override_name) {
  const Places places = Places::of_this_program();
  const auto file = find_launch_file(options.file, places);
  const Plan plan = make_plan(load_launch(file, options.overrides), places, ImagePlaces().run);
  const auto from_share =
      std::filesystem::canonical(file).lexically_relative(std::filesystem::canonical(places.share));
  std::string title = from_share.string().starts_with("..") ? file.string() : from_share.string();
  for (const std::string& setting : options.overrides) title += " --set " + setting;
  return override_name.empty() ? compose_file(plan, places, title)
                               : compose_override(plan, override_name, title);
}

}  // namespace coop::launcher
