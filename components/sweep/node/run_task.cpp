#include "sweep/node/run_task.hpp"

#include <fmt/format.h>

#include "core/atomic_file.hpp"
#include "sweep/node/command.hpp"
#include "sweep/results.hpp"

namespace coop::sweep {
namespace {

/// The launcher's own limit, after which it stops the system in order; ours is a little later.
constexpr std::chrono::seconds kGrace{30};

std::vector<std::string> launcher_command(const Sweep& sweep, const Run& run, int domain,
                                          const std::filesystem::path& folder) {
  std::vector<std::string> command{(sweep.places.programs / "launcher").string(),
                                   "up",
                                   sweep.config.launch,
                                   "--quiet",
                                   "--domain",
                                   std::to_string(domain),
                                   "--seed",
                                   std::to_string(run.seed),
                                   "--timeout",
                                   fmt::format("{}", sweep.config.timeout),
                                   "--run-dir",
                                   (folder / "system").string()};
  for (const std::string& setting : run.settings) {
    command.emplace_back("--set");
    command.push_back(setting);
  }
  return command;
}

}  // namespace

RunTask::RunTask(const Sweep& sweep, const Run& run, int domain)
    : sweep_(sweep),
      run_(run),
      folder_(run_folder(sweep.folder, run)),
      begun_(std::chrono::steady_clock::now()) {
  std::filesystem::remove_all(folder_);
  std::filesystem::create_directories(folder_);
  launcher_.emplace(launcher_command(sweep, run, domain, folder_), folder_ / "launcher.log");
}

bool RunTask::poll() {
  if (!launcher_) return true;
  const auto code = launcher_->poll();
  if (code) {
    conclude(*code);
    launcher_.reset();
    return true;
  }
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begun_;
  if (spent.count() > sweep_.config.timeout + static_cast<double>(kGrace.count())) {
    out_of_time_ = true;
    launcher_->kill_group();
  }
  return false;
}

void RunTask::stop() {
  launcher_.reset();
}

void RunTask::conclude(int exit_code) {
  RunResult result;
  result.identity = run_.identity(sweep_.config);
  result.wall_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
  const auto table = folder_ / "system" / "latest" / sweep_.config.table;
  const std::string changed =
      shown_differences(sweep_.inputs, find_inputs(sweep_.config, sweep_.places));
  if (exit_code != 0) {
    result.problem =
        fmt::format("the launcher ended with exit code {}{}: {}", exit_code,
                    out_of_time_ ? ", out of time" : "", last_line(folder_ / "launcher.log"));
  } else if (!changed.empty()) {
    result.problem = "inputs changed while it ran: " + changed;
  } else if (!std::filesystem::exists(table)) {
    result.problem = "no " + sweep_.config.table + " in the run's folder";
  } else {
    try {
      const std::string text = read_file(table);
      (void)parse_csv(text);
      write_file_atomically(table_file(sweep_.folder, run_), text);
      result.success = true;
    } catch (const std::exception& problem) {
      result.problem = sweep_.config.table + ": " + problem.what();
    }
  }
  write_file_atomically(result_file(sweep_.folder, run_), to_json(result));
}

}  // namespace coop::sweep
