#include "sweep/node/slurm_engine.hpp"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <iostream>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "core/atomic_file.hpp"
#include "sweep/results.hpp"

namespace coop::sweep {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// Slurm's own default of MaxArraySize is 1001. More runs are made one job after the other.
constexpr std::size_t kMostTasks = 1000;
/// A look at the folder costs a request for each run on a network file system.
constexpr std::chrono::seconds kLook{1};
/// Slurm gives cancelled tasks 30 s (KillWait) before it kills them.
constexpr std::chrono::seconds kCancelLimit{60};
constexpr std::chrono::milliseconds kCancelPause{1000};
constexpr int kRoundMs = 100;

fs::path need(const std::string& program) {
  fs::path found = find_in_path(program);
  if (found.empty()) {
    throw std::runtime_error("--engine slurm: no program '" + program +
                             "'; it needs a machine with Slurm's commands (Debian: slurm-client)");
  }
  return found;
}

bool have_all_results(const Sweep& sweep, const std::vector<Run>& runs) {
  return std::ranges::all_of(
      runs, [&](const Run& run) { return fs::exists(result_file(sweep.folder, run)); });
}

}  // namespace

SlurmEngine::SlurmEngine(SlurmEngineOptions options)
    : options_(std::move(options)),
      sbatch_(need("sbatch")),
      squeue_(need("squeue")),
      scancel_(need("scancel")) {}

void SlurmEngine::make(const Sweep& sweep, const std::vector<Run>& runs, const Watcher& watch) {
  if (runs.empty()) return;
  folder_ = sweep.folder / "slurm";
  fs::create_directories(folder_);
  cancel_left_behind(job_name(sweep.folder));
  std::vector<Run> waiting = runs;
  while (!waiting.empty()) {
    const auto end = waiting.begin() + static_cast<long>(std::min(waiting.size(), kMostTasks));
    const std::vector<Run> these(waiting.begin(), end);
    waiting.erase(waiting.begin(), end);
    submit(sweep, these);
    if (!wait_for(sweep, these, watch)) {
      cancel(number_);
      return;
    }
    const std::vector<Run> again = to_make_again(sweep, these);
    waiting.insert(waiting.end(), again.begin(), again.end());
  }
}

std::string SlurmEngine::ask(const std::vector<std::string>& words) const {
  const std::string program = fs::path(words.front()).filename().string();
  const Answer answer = Command(words, folder_ / (program + ".out")).wait();
  if (answer.code == 0) return answer.text;
  // Most of its messages begin with its name.
  const std::string line = answer.line();
  throw std::runtime_error(line.starts_with(program) ? line : program + ": " + line);
}

void SlurmEngine::submit(const Sweep& sweep, const std::vector<Run>& runs) {
  ArrayJob job{.name = job_name(sweep.folder),
               .command = options_.task,
               .runs = {},
               .side_by_side = options_.side_by_side,
               .folder = folder_,
               .working_folder = fs::current_path()};
  for (const Run& run : runs) {
    fs::remove(result_file(sweep.folder, run));
    job.runs.push_back(run.number);
  }
  const fs::path script = folder_ / "array.sh";
  write_file_atomically(script, batch_script(job));
  std::vector<std::string> words = sbatch_arguments(job, sweep.config, script);
  words.insert(words.begin(), sbatch_.string());
  const std::string answer = ask(words);
  const auto number = job_number(answer);
  if (!number) throw std::runtime_error("sbatch: no number of a job in its answer: " + answer);
  number_ = *number;
  job_.emplace(squeue_, number_, folder_ / "squeue.out", options_.pause);
}

bool SlurmEngine::wait_for(const Sweep& sweep, const std::vector<Run>& runs, const Watcher& watch) {
  auto next_look = Clock::now();
  while (!job_->is_over()) {
    if (!watch()) return false;
    job_->look();
    if (Clock::now() < next_look) continue;
    next_look = Clock::now() + kLook;
    if (have_all_results(sweep, runs)) break;
  }
  return true;
}

void SlurmEngine::cancel(const std::string& number) {
  const Answer answer = Command({scancel_.string(), number}, folder_ / "scancel.out").wait();
  std::cout << "\ncancelling Slurm job " << number << std::endl;
  if (answer.code != 0) std::cerr << "sweep: scancel: " << answer.line() << '\n';
  JobWatch job(squeue_, number, folder_ / "squeue.out", std::min(options_.pause, kCancelPause));
  const auto limit = Clock::now() + kCancelLimit;
  while (!job.is_over() && Clock::now() < limit) {
    job.look();
    ::poll(nullptr, 0, kRoundMs);
  }
  if (!job.is_over()) std::cerr << "sweep: tasks are still ending; " << job.text() << '\n';
}

void SlurmEngine::cancel_left_behind(const std::string& name) {
  std::istringstream lines(
      ask({squeue_.string(), "--me", "--noheader", "--name=" + name, "--format=%F"}));
  std::set<std::string> numbers;
  for (std::string line; std::getline(lines, line);) {
    if (const auto number = job_number(line)) numbers.insert(*number);
  }
  for (const std::string& number : numbers) cancel(number);
}

std::vector<Run> SlurmEngine::to_make_again(const Sweep& sweep, const std::vector<Run>& runs) {
  std::vector<Run> again;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (is_finished(sweep.folder, sweep.config, runs[i])) continue;
    if (++failures_[runs[i].number] > sweep.config.slurm.retries) {
      give_up(sweep, runs[i], i);
    } else {
      again.push_back(runs[i]);
    }
  }
  return again;
}

/// A run that has said itself what went wrong has a result already.
void SlurmEngine::give_up(const Sweep& sweep, const Run& run, std::size_t index) const {
  if (fs::exists(result_file(sweep.folder, run))) return;
  const std::string task = fmt::format("{}_{}", number_, index);
  const auto state = job_->state().tasks.find(static_cast<int>(index));
  const fs::path log = folder_ / ("task-" + task + ".log");
  const int tries = failures_.at(run.number);
  RunResult result;
  result.identity = run.identity(sweep.config);
  result.problem =
      fmt::format("no result in {} {}; Slurm task {}: {}; {}", tries, tries == 1 ? "try" : "tries",
                  task, state == job_->state().tasks.end() ? "ended" : state->second,
                  fs::exists(log) ? "its log ends with: " + last_line(log) : "it left no log");
  write_file_atomically(result_file(sweep.folder, run), to_json(result));
}

}  // namespace coop::sweep
