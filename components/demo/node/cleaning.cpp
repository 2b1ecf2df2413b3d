#include "demo/node/cleaning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iostream>

#include "demo/cleaning_report.hpp"
#include "demo/figures.hpp"
#include "demo/node/part.hpp"

namespace coop::demo {
namespace {

Part part_of(int pen, std::uint64_t seed, const StoryOptions& options) {
  Part part;
  part.title = fmt::format("pen {}", pen);
  part.launch_file = "config/launch/pig_pen.yaml";
  part.settings = {fmt::format("rate={}", options.rate), fmt::format("pen={}", pen)};
  part.settings.insert(part.settings.end(), options.settings.begin(), options.settings.end());
  part.folder = std::filesystem::absolute(options.folder) / fmt::format("pen_{}", pen);
  part.programs = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  part.domain = options.domain;
  part.seed = seed;
  part.timeout = 600.0;
  part.watch = {.map_is_world = true, .pictures = true};
  return part;
}

void print_result(const PenRun& run) {
  const Figures f = compute_figures(run.record);
  std::cout << fmt::format("pen {}: {} of {} heaps cleaned, {} pigs touched, {:.0f} s, {:.1f} m\n",
                           run.pen, run.record.targets_taken, run.record.targets_in_world,
                           run.record.animal_collisions, f.duration, f.distance_driven);
  for (const TargetRecord& heap : run.record.targets) {
    if (is_done(heap)) continue;
    std::cout << fmt::format("{}: {} after {} attempts: {}\n", heap.id, heap.state, heap.attempts,
                             heap.reason);
  }
}

}  // namespace

int run_cleaning(const StoryOptions& options, const std::vector<int>& pens) {
  const auto begin = std::chrono::steady_clock::now();
  std::vector<PenRun> runs;
  for (const int pen : pens) {
    const std::uint64_t seed = options.seed + runs.size();
    const Part part = part_of(pen, seed, options);
    PartResult result = run_part(part);
    if (const int code = complain(part, result)) return code;
    runs.push_back({pen, seed, std::move(result.record)});
    print_result(runs.back());
  }
  Summary summary;
  summary.seed = options.seed;
  summary.wall_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  summary.version = "Coop " COOP_VERSION;
  const std::filesystem::path folder = std::filesystem::absolute(options.folder);
  write_cleaning_report(folder, runs, summary);
  std::cout << "report: " << (folder / "report.html").string() << '\n';
  const bool good =
      std::ranges::all_of(runs, [](const PenRun& run) { return is_clean(run.record); });
  return good ? 0 : 1;
}

}  // namespace coop::demo
