#include "experiments/chaos/mission_run.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <cmath>
#include <csignal>

namespace coop::chaos {
namespace {

using std::chrono::milliseconds;
using Seconds = std::chrono::duration<double>;

constexpr milliseconds kLook{10};
constexpr milliseconds kAskEvery{50};  ///< `coop ps`
/// What was under way when the fault began arrives within this time.
constexpr milliseconds kUnderWay{30};
/// kSlow: runs for 20 of 100 ms.
constexpr double kTurn = 0.1;
constexpr double kShare = 0.2;
/// s of wall time for which the world may stand still before it is called a hang.
constexpr double kStill = 60.0;
constexpr double kEggsAgree = 10.0;  ///< s of wall time for the last truth to arrive

std::vector<std::string> arguments(const ChaosOptions& options, int number) {
  std::vector<std::string> all{
      "--seed", std::to_string(options.seed * 1000 + static_cast<std::uint64_t>(number)), "--set",
      fmt::format("rate={}", options.rate)};
  for (const std::string& setting : options.settings) {
    all.insert(all.end(), {"--set", setting});
  }
  return all;
}

double seconds_since(Wall::time_point begin) {
  return Seconds(Wall::now() - begin).count();
}

}  // namespace

MissionRun::MissionRun(const ChaosOptions& options, const Ground& ground, int number,
                       std::ostream& log)
    : options_(options),
      ground_(ground),
      number_(number),
      log_(log),
      system_(std::filesystem::path(COOP_SOURCE_DIR) / "config/launch/collect.yaml",
              arguments(options, number)),
      observer_(system_.domain()) {}

void MissionRun::complain(const std::string& what) {
  wrong_.push_back(fmt::format("mission {}, {:.1f} s: {}", number_, observer_.simulated(), what));
  fmt::print(log_, "  WRONG {}\n", wrong_.back());
  log_.flush();
}

bool MissionRun::look_until(const Condition& condition, double limit) {
  const auto begin = Wall::now();
  while (!condition()) {
    if (seconds_since(begin) > limit || system_.launcher().wait(milliseconds(0))) return false;
    observer_.look(kLook);
  }
  return true;
}

void MissionRun::run(FaultPlan& plan, int& left) {
  if (!system_.wait_until_ready(milliseconds(60000))) {
    complain("not ready: " + system_.launcher().output());
    left = 0;
    return;
  }
  const auto view = system_.view();
  if (!view) return complain("the launcher does not answer");
  for (const auto& row : view->rows) names_.push_back(row.name);
  while (left > 0) {
    Fault fault = plan.next();
    if (!wait_for_gap(fault.gap)) break;
    happen(std::move(fault));
    --left;
    if (system_.launcher().wait(milliseconds(0))) break;
  }
  while (!observer_.is_over() && wait_for_gap(10.0)) {
  }
  finish();
}

/// False where there is nothing left to wait for.
bool MissionRun::wait_for_gap(double gap) {
  const double begin = observer_.simulated();
  double newest = begin;
  auto moved = Wall::now();
  bool stands_still = false;
  const bool reached = look_until(
      [&] {
        if (observer_.simulated() > newest) {
          newest = observer_.simulated();
          moved = Wall::now();
        }
        stands_still = seconds_since(moved) > kStill;
        return stands_still || observer_.is_over() || newest >= begin + gap;
      },
      1e6);
  check_world("");
  if (stands_still) complain("time stands still");
  if (newest > options_.mission)
    complain("the mission takes too long: " + observer_.mission().detail());
  return reached && !stands_still && newest <= options_.mission && !observer_.is_over();
}

void MissionRun::begin(const Fault& fault, pid_t pid) {
  switch (fault.kind) {
    case FaultKind::kKill:
      kill(pid, SIGKILL);
      break;
    case FaultKind::kStop:
    case FaultKind::kSlow:
      kill(pid, SIGSTOP);
      break;
    case FaultKind::kLoss:
    case FaultKind::kCut:
      ground_.lose_packets(pid, fault.amount);
      break;
    case FaultKind::kClock:
      observer_.tell_wrong_time(fault.amount);
      break;
    case FaultKind::kDiskFull:
      ground_.fill_disk();
      break;
  }
}

void MissionRun::keep_up(const Fault& fault, pid_t pid, double elapsed) const {
  if (fault.kind != FaultKind::kSlow) return;
  kill(pid, std::fmod(elapsed, kTurn) < kShare * kTurn ? SIGCONT : SIGSTOP);
}

void MissionRun::end(const Fault& fault, pid_t pid) {
  if (fault.kind == FaultKind::kStop || fault.kind == FaultKind::kSlow) kill(pid, SIGCONT);
  if (fault.kind == FaultKind::kLoss || fault.kind == FaultKind::kCut) ground_.restore_network();
  if (fault.kind == FaultKind::kDiskFull) ground_.free_disk();
}

void MissionRun::ask() {
  if (Wall::now() - asked_ < kAskEvery) return;
  asked_ = Wall::now();
  view_ = system_.view();
  if (!view_ || replaced_) return;
  for (const auto& row : view_->rows) {
    const bool is_new = row.name == hit_ && row.pid != 0 && row.pid != hit_pid_;
    if (is_new) replaced_ = observer_.simulated();
  }
}

/// Whether anything tells of the fault: a component of itself, or the launcher of one.
void MissionRun::notice(Incident& incident, pid_t pid, Wall::time_point begin) {
  namespace State = coop_msgs::msg::ComponentStatus_Constants;
  ask();
  if (incident.noticed) return;
  for (const std::string& name : names_) {
    const auto status = observer_.components().status(name);
    if (!status || status->state == State::READY || status->since < begin) continue;
    incident.noticed = Seconds(status->since - begin).count();
    incident.seen = name + ": " + status->detail;
    return;
  }
  if (!view_ || asked_ < begin) return;
  for (const auto& row : view_->rows) {
    const bool is_other = row.name == incident.fault.component && row.pid != pid;
    if (row.state == "ready" && !is_other) continue;
    incident.noticed = seconds_since(begin);
    incident.seen = row.name + " " + (is_other ? "replaced" : row.state);
    return;
  }
}

bool MissionRun::component_is_back(const Incident& incident, pid_t pid, Wall::time_point begin,
                                   Wall::time_point over) {
  const std::string& name = incident.fault.component;
  if (name.empty()) return true;
  if (incident.fault.kind == FaultKind::kKill) {
    const auto status = observer_.components().status(name);
    return status && status->pid != pid &&
           observer_.components().successor_at_work(name, begin).has_value();
  }
  // The planner's costmap is told when it changes: there its heartbeat must do.
  const auto status = observer_.components().status(name);
  const auto work = observer_.components().last_at_work(name);
  return (work && *work > over) || (name == "global_planner" && status && status->heard > over);
}

bool MissionRun::all_well(Wall::time_point since) {
  ask();
  return view_ && asked_ > since && std::ranges::all_of(view_->rows, [](const auto& row) {
           // The recorder tells of what it missed for ten seconds more.
           return row.state == "ready" || (row.name == "record" && row.state == "degraded");
         });
}

void MissionRun::happen(Fault fault) {
  const auto row = system_.row(fault.component);
  const pid_t pid = row ? row->pid : 0;
  if (!fault.component.empty() && pid == 0) return complain(fault.component + " does not run");
  Incident incident{.number = static_cast<int>(incidents_.size()) + 1,
                    .mission = number_,
                    .simulated = observer_.simulated(),
                    .fault = std::move(fault),
                    .noticed = {},
                    .recovered = {},
                    .braking = {},
                    .seen = {},
                    .wrong = {}};
  const Fault& what = incident.fault;
  hit_ = what.component;
  hit_pid_ = pid;
  replaced_.reset();
  observer_.look(milliseconds(0));
  begin(what, pid);
  const auto begin_at = Wall::now();
  (void)look_until([&] { return Wall::now() - begin_at > kUnderWay; }, 1.0);
  const double lost = observer_.simulated();
  (void)look_until(
      [&] {
        const double elapsed = seconds_since(begin_at);
        keep_up(what, pid, elapsed);
        notice(incident, pid, begin_at);
        return elapsed >= what.duration;
      },
      what.duration + 1.0);
  const double lifted = observer_.simulated();
  end(what, pid);
  const auto over = Wall::now();
  const bool recovered = look_until(
      [&] {
        notice(incident, pid, begin_at);
        return component_is_back(incident, pid, begin_at, over) && all_well(over);
      },
      options_.recovery);
  if (recovered) incident.recovered = seconds_since(over);
  if (!recovered) incident.wrong = "does not recover";
  const double found = what.kind == FaultKind::kKill ? observer_.simulated() : lifted;
  judge(incident, lost, std::min(found, replaced_.value_or(found)));
  if (!incident.wrong.empty()) {
    complain(fmt::format("{} {}: {}", name_of(what.kind), what.component, incident.wrong));
  }
  check_world(fmt::format(" after {} {}", name_of(what.kind), what.component));
  fmt::print(log_, "  {:3} {:8.2f} s {:9} {:14} {:5.2f} s noticed {:5.2f} recovered {:5.2f} {}\n",
             incident.number, incident.simulated, name_of(what.kind), what.component, what.duration,
             incident.noticed.value_or(-1), incident.recovered.value_or(-1), incident.seen);
  log_.flush();
  incidents_.push_back(std::move(incident));
}

void MissionRun::judge(Incident& incident, double lost, double found) {
  if (!is_needed_to_drive(incident.fault)) return;
  const Stopping stopping =
      judge_stopping(observer_.motion_since(lost - 0.1), lost, found, clock_error());
  if (!stopping.was_moving || found - lost < kReaction + clock_error()) return;
  incident.braking = stopping.begun_after;
  if (!stopping.is_safe) {
    incident.wrong += fmt::format("{}not braking: {:.2f} s after the loss it still drove",
                                  incident.wrong.empty() ? "" : "; ", stopping.begun_after);
  }
}

void MissionRun::check_world(const std::string& after) {
  if (observer_.truth().collision_count() > collisions_) {
    collisions_ = observer_.truth().collision_count();
    complain("collision" + after);
  }
}

void MissionRun::finish() {
  namespace State = coop_msgs::msg::MissionStatus_Constants;
  summary_ = fmt::format("mission {}: {:.0f} s, {}", number_, observer_.simulated(),
                         observer_.mission().detail());
  const auto ended = system_.launcher().wait(milliseconds(0));
  if (ended) return complain("the launcher has ended: " + system_.launcher().output());
  if (observer_.mission().state() != State::DONE) complain("the mission is not done: " + summary_);
  (void)look_until([&] { return judge_eggs(observer_.mission(), observer_.truth()).empty(); },
                   kEggsAgree);
  for (const std::string& problem : judge_eggs(observer_.mission(), observer_.truth())) {
    complain(problem);
  }
  const std::vector<pid_t> pids = system_.pids();
  const auto status = system_.stop();
  if (!status || status->code != 0 || status->signal != 0)
    complain("the launcher did not end well");
  if (std::ranges::any_of(pids, test::is_alive)) complain("something outlives the system");
  namespace TrueEgg = coop_msgs::msg::SimEgg_Constants;
  const bool left_some = std::ranges::any_of(
      observer_.truth().eggs(), [](const auto& egg) { return egg.state() != TrueEgg::COLLECTED; });
  if ((!wrong_.empty() || left_some) && !options_.out.empty()) {
    std::error_code ignored;
    std::filesystem::copy(system_.folder(), options_.out / fmt::format("mission-{}", number_),
                          std::filesystem::copy_options::recursive, ignored);
  }
}

}  // namespace coop::chaos
