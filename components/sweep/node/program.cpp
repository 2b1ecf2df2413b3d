#include "sweep/node/program.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <iostream>

#include "core/config/config.hpp"
#include "runtime/clock.hpp"
#include "runtime/executor.hpp"
#include "runtime/stop_signal.hpp"
#include "sweep/node/local_engine.hpp"
#include "sweep/report.hpp"

namespace coop::sweep {
namespace {

using Wall = std::chrono::steady_clock;
constexpr auto kRound = std::chrono::milliseconds(100);
constexpr int kStopped = 130;

/// A path, or the name of a sweep that comes with Coop: config/sweeps/weights.yaml, weights.
std::filesystem::path find_sweep_file(const std::string& wanted) {
  std::vector<std::filesystem::path> tried{wanted};
  auto folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  for (; folder != folder.root_path(); folder = folder.parent_path()) {
    for (const char* share : {"", "share/coop"}) {
      tried.push_back(folder / share / wanted);
      tried.push_back(folder / share / "config" / "sweeps" / (wanted + ".yaml"));
    }
  }
  for (const auto& path : tried) {
    if (std::filesystem::is_regular_file(path)) return path;
  }
  throw config::Error("no sweep file '" + wanted + "'");
}

std::string shown_time(double seconds) {
  const auto whole = static_cast<long>(seconds);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

/// done/total and when it will be over, from the mean time of a run in this call.
class Progress {
 public:
  Progress(std::size_t total, std::size_t done) : total_(total), before_(done) {}

  void show(std::size_t done) {
    const bool is_terminal = ::isatty(STDOUT_FILENO) == 1;
    const auto now = Wall::now();
    const bool changed = done != shown_;
    if (!changed && (!is_terminal || now - last_ < std::chrono::seconds(1))) return;
    last_ = now;
    shown_ = done;
    const double spent = std::chrono::duration<double>(now - begun_).count();
    std::string line = fmt::format("{} of {} runs, {}", done, total_, shown_time(spent));
    if (done > before_) {
      const double left =
          spent * static_cast<double>(total_ - done) / static_cast<double>(done - before_);
      line += ", " + shown_time(left) + " to go";
    }
    if (is_terminal) {
      std::cout << "\r\033[K" << line << (done == total_ ? "\n" : "") << std::flush;
    } else {
      std::cout << line << std::endl;
    }
  }

 private:
  std::size_t total_;
  std::size_t before_;
  std::size_t shown_ = ~std::size_t{0};
  Wall::time_point begun_ = Wall::now();
  Wall::time_point last_{};
};

std::size_t count_finished(const Sweep& sweep, const std::vector<Run>& runs) {
  return static_cast<std::size_t>(std::ranges::count_if(runs, [&](const Run& run) {
    return std::filesystem::exists(result_file(sweep.folder, run));
  }));
}

Sweep load(const ProgramOptions& options) {
  Sweep sweep;
  sweep.file = find_sweep_file(options.file);
  sweep.config = config::Document::load(sweep.file).read<SweepConfig>();
  sweep.folder = std::filesystem::absolute(options.folder);
  if (options.seeds) sweep.config.seeds = *options.seeds;
  if (options.first_seed) sweep.config.first_seed = *options.first_seed;
  sweep.config.settings.insert(sweep.config.settings.end(), options.settings.begin(),
                               options.settings.end());
  sweep.config.validate();
  return sweep;
}

/// The runs without success; their old results go, so that a file counts as one of this call.
std::vector<Run> runs_to_make(const Sweep& sweep, const std::vector<Run>& planned,
                              const std::vector<int>& only) {
  std::vector<Run> missing;
  for (const Run& run : planned) {
    if (!only.empty() && std::ranges::find(only, run.number) == only.end()) continue;
    if (is_finished(sweep.folder, sweep.config, run)) continue;
    std::filesystem::remove(result_file(sweep.folder, run));
    missing.push_back(run);
  }
  return missing;
}

}  // namespace

int run_sweep(const ProgramOptions& options) {
  const Sweep sweep = load(options);
  const std::vector<Run> planned = plan_runs(sweep.config);
  std::filesystem::create_directories(sweep.folder);
  const std::vector<Run> missing = runs_to_make(sweep, planned, options.only);

  const runtime::SystemClock clock;
  runtime::Executor executor(clock);
  const runtime::StopSignal signal(executor);
  Progress progress(planned.size(), planned.size() - missing.size());
  LocalEngine engine(options.jobs, options.domain);
  engine.make(sweep, missing, [&] {
    progress.show(count_finished(sweep, planned));
    executor.wait_and_run(kRound);
    return !runtime::StopSignal::requested();
  });
  progress.show(count_finished(sweep, planned));

  // A task among many: the report is made by the call that gathers.
  if (!options.only.empty()) {
    if (runtime::StopSignal::requested()) return kStopped;
    const bool all_good = std::ranges::all_of(
        missing, [&](const Run& run) { return is_finished(sweep.folder, sweep.config, run); });
    return all_good ? 0 : 1;
  }
  const std::vector<FinishedRun> finished = gather(sweep.folder, sweep.config, planned);
  write_pages(sweep.folder, render_sweep(sweep.config, planned, finished));
  const auto good =
      std::ranges::count_if(finished, [](const FinishedRun& run) { return run.result.success; });
  std::cout << fmt::format("{} of {} runs with a result\nreport: {}\n", good, planned.size(),
                           (sweep.folder / "report.html").string());
  for (const FinishedRun& run : finished) {
    if (run.result.success) continue;
    std::cerr << fmt::format("sweep: run {}: {}\n", run.run.number, run.result.problem);
  }
  if (runtime::StopSignal::requested()) {
    std::cout << "stopped; the same call goes on from here\n";
    return kStopped;
  }
  return static_cast<std::size_t>(good) == planned.size() ? 0 : 1;
}

}  // namespace coop::sweep
