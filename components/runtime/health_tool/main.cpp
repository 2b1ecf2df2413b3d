// `coop health`: what components say of themselves, without taking part in DDS. Made for the health
// checks of containers: milliseconds, and an exit code.
#include <signal.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <set>

#include "core/health_file.hpp"

namespace {

using coop::FoundHealth;
using coop::Liveness;

/// Not 2, which container engines keep for themselves, nor anything above 125.
constexpr int kExitNotReady = 3;
constexpr int kExitWrongUsage = 64;

struct Question {
  std::string component;
  std::optional<int> domain;
  std::optional<std::string> robot;
  bool strict = false;
};

bool is_alive(pid_t pid) {
  return ::kill(pid, 0) == 0 || errno == EPERM;
}

/// 0: it does its work; degraded components do, as far as they can.
int exit_code(Liveness liveness, bool strict) {
  switch (liveness) {
    case Liveness::kReady:
      return 0;
    case Liveness::kDegraded:
      return strict ? kExitNotReady : 0;
    case Liveness::kStarting:
    case Liveness::kStopping:
      return kExitNotReady;
    case Liveness::kStale:
      return 4;
    case Liveness::kAbsent:
      return 5;
  }
  return 1;
}

int say(const FoundHealth& found, const Question& question) {
  const std::int64_t now = coop::boot_time();
  const Liveness liveness = coop::judge_health(found.note, now, is_alive(found.note.pid));
  std::printf("%s: %s", found.component.c_str(), std::string(to_string(liveness)).c_str());
  if (liveness == Liveness::kStale) {
    std::printf(": silent for %.1f s, was %s", 1e-9 * static_cast<double>(now - found.note.stamp),
                found.note.state.c_str());
  } else if (liveness == Liveness::kAbsent) {
    std::printf(": no process %d", static_cast<int>(found.note.pid));
  } else if (!found.note.reason.empty()) {
    std::printf(": %s", found.note.reason.c_str());
  }
  std::printf("\n");
  return exit_code(liveness, question.strict);
}

int answer(const Question& question) {
  std::vector<FoundHealth> found = coop::find_health(question.domain, question.robot);
  std::set<std::string> systems;
  if (!question.component.empty()) {
    std::erase_if(found,
                  [&](const FoundHealth& one) { return one.component != question.component; });
  }
  for (const FoundHealth& one : found) systems.insert(one.system);
  if (found.empty()) {
    std::printf("%s: absent\n", question.component.empty() ? "all" : question.component.c_str());
    return exit_code(Liveness::kAbsent, question.strict);
  }
  if (systems.size() > 1) {
    std::fprintf(stderr, "health: several systems run (domain or domain-robot:");
    for (const std::string& system : systems) std::fprintf(stderr, " %s", system.c_str());
    std::fprintf(stderr, "); choose with --domain and --robot\n");
    return kExitWrongUsage;
  }
  int worst = 0;
  for (const FoundHealth& one : found) worst = std::max(worst, say(one, question));
  return worst;
}

}  // namespace

int main(int argc, char** argv) {
  Question question;
  CLI::App app{
      "What a component (all of them without NAME) says of itself. Exit code 0: ready or degraded; "
      "3: starting or stopping; 4: stale, it has been silent for 1.3 s; 5: absent; 64: wrong usage",
      "health"};
  app.add_option("name", question.component, "name of the component");
  app.add_option("--domain", question.domain, "DDS domain")->check(CLI::Range(0, 232));
  app.add_option("--robot", question.robot, "name of the robot");
  app.add_flag("--strict", question.strict, "degraded counts as not ready");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    return app.exit(problem) == 0 ? 0 : kExitWrongUsage;
  }
  return answer(question);
}
