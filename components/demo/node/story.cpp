#include "demo/node/story.hpp"

#include <fmt/format.h>

#include <chrono>
#include <iostream>

#include "demo/figures.hpp"
#include "demo/node/part.hpp"
#include "demo/report.hpp"

namespace coop::demo {
namespace {

void print_result(const Record& record, const std::filesystem::path& folder) {
  const Figures f = compute_figures(record);
  std::cout << fmt::format(
      "{} of {} eggs collected, {} collisions, {:.0f} s, {:.1f} m driven, position error mean "
      "{:.3f} m, max {:.3f} m\n",
      record.targets_taken, record.targets_in_world, record.collisions, f.duration,
      f.distance_driven, f.position_error.mean, f.position_error.max);
  for (const TargetRecord& egg : record.targets) {
    if (!is_done(egg)) {
      std::cout << fmt::format("egg {}: {} after {} attempts: {}\n", egg.id, egg.state,
                               egg.attempts, egg.reason);
    }
  }
  std::cout << "report: " << (folder / "report.html").string() << '\n';
}

}  // namespace

int run_story(const StoryOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  const std::filesystem::path folder = std::filesystem::absolute(options.folder);
  Part survey;
  survey.title = "survey";
  survey.launch_file = "config/launch/survey.yaml";
  survey.settings = {fmt::format("rate={}", options.rate)};
  survey.settings.insert(survey.settings.end(), options.settings.begin(), options.settings.end());
  const std::vector<std::string> common = survey.settings;
  survey.settings.push_back("slam.save_path=" + (folder / "map").string());
  survey.folder = folder / "survey";
  survey.programs = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  survey.domain = options.domain;
  survey.seed = options.seed;
  const PartResult surveyed = run_part(survey);
  if (const int code = complain(survey, surveyed)) return code;

  Part collection = survey;
  collection.title = "collection";
  collection.launch_file = "config/launch/collect.yaml";
  collection.settings = common;
  collection.settings.push_back("amcl.map_file=" + (folder / "map.yaml").string());
  collection.folder = folder / "collection";
  const PartResult collected = run_part(collection);
  if (const int code = complain(collection, collected)) return code;

  Summary summary;
  summary.seed = options.seed;
  summary.wall_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  summary.version = "Coop " COOP_VERSION;
  write_report(folder, surveyed.record, collected.record, summary);
  print_result(collected.record, folder);
  return is_success(collected.record) && surveyed.record.collisions == 0 ? 0 : 1;
}

}  // namespace coop::demo
