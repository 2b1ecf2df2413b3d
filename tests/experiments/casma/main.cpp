#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <iostream>

#include "experiments/casma/report.hpp"

namespace {

using namespace coop::casma;

std::atomic<bool> stop{false};
static_assert(std::atomic<bool>::is_always_lock_free);
constexpr int kStopped = 130;

/// A line that is written over on a terminal, one every tenth of a stage elsewhere.
class Progress {
 public:
  void show(const std::string& stage, std::size_t done, std::size_t total) {
    const bool is_terminal = ::isatty(STDERR_FILENO) == 1;
    const auto now = std::chrono::steady_clock::now();
    const std::size_t tenth = 10 * done / total;
    if (is_terminal) {
      if (now - last_ < std::chrono::milliseconds(200) && done != total) return;
      std::cerr << fmt::format("\r\033[K{}: {} of {}{}", stage, done, total,
                               done == total ? "\n" : "")
                << std::flush;
    } else if (stage != stage_ || tenth != tenth_) {
      std::cerr << fmt::format("{}: {} of {}\n", stage, done, total);
    }
    last_ = now;
    stage_ = stage;
    tenth_ = tenth;
  }

 private:
  std::chrono::steady_clock::time_point last_;
  std::string stage_;
  std::size_t tenth_ = 0;
};

int run(const StageOptions& options, const std::string& paper, const std::string& folder) {
  // A folder that cannot be written to shows now, not after the runs.
  std::filesystem::create_directories(folder);
  Findings findings{load_paper(paper), options, {}, {}, {}, {}};
  findings.rosenbrock = run_rosenbrock(options);
  findings.plans = run_maps(findings.paper, options);
  findings.moving = run_moving(findings.paper, options);
  findings.pilot = run_pilot(findings.paper, options);
  if (stop) {
    std::cerr << "\nstopped; no report was written\n";
    return kStopped;
  }
  for (const Table& table : all_tables(findings)) std::cout << as_text(table) << '\n';
  write_report(folder, findings);
  std::cout << "report: " << folder << "/report.html\n";
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  StageOptions options;
  std::string folder;
  std::string paper = COOP_SOURCE_DIR "/tests/experiments/casma/paper.yaml";
  CLI::App app{
      "Repeats the experiments of the CASMA paper and prints each table beside the paper's.",
      "casma"};
  app.add_option("-o,--output", folder, "folder of the report")->required();
  app.add_option("--seeds", options.seeds, "of each planner on each map")
      ->check(CLI::Range(1, 100000));
  app.add_option("--seed", options.first_seed, "the first");
  app.add_option("--jobs", options.jobs, "threads")->check(CLI::Range(1, 64));
  app.add_option("--paper", paper, "the paper's figures")->check(CLI::ExistingFile);
  CLI11_PARSE(app, argc, argv);
  std::signal(SIGINT, [](int) { stop = true; });
  std::signal(SIGTERM, [](int) { stop = true; });
  Progress progress;
  options.stop = &stop;
  options.progress = [&](const std::string& stage, std::size_t done, std::size_t total) {
    progress.show(stage, done, total);
  };
  try {
    return run(options, paper, folder);
  } catch (const std::exception& problem) {
    std::cerr << "casma: " << problem.what() << '\n';
    return 1;
  }
}
