#include "demo/report.hpp"

#include <fmt/format.h>

#include "core/atomic_file.hpp"
#include "core/image/picture_file.hpp"
#include "core/markup.hpp"
#include "demo/figures.hpp"
#include "demo/picture.hpp"
#include "demo/report_parts.hpp"

namespace coop::demo {

std::string render_html(const Record& survey, const Record& collection, const Summary& summary,
                        const std::string& run_png, const std::string& map_png) {
  const Figures f = compute_figures(collection);
  const bool good = is_success(collection);
  const std::string body =
      "<h1>Egg collection in the duck house</h1>\n" +
      fmt::format("<p class=\"{}\">{} of {} eggs collected, {} collisions.</p>\n",
                  good ? "good" : "bad", collection.targets_taken, collection.targets_in_world,
                  collection.collisions + survey.collisions) +
      fmt::format("<p>Seed {}, {:.0f} s of wall time, {}.</p>\n", summary.seed,
                  summary.wall_seconds, escape_markup(summary.version)) +
      "<h2>The collection</h2>\n" +
      image_tag(run_png, "costmap, path driven, eggs and their order") + figures_table(collection) +
      target_table(collection, "egg") +
      fmt::format("<p>Cost of the chosen order: {:.2f} m. Picked {}, failed {}.</p>\n",
                  collection.tour_cost, f.targets_done, f.targets_failed) +
      "<h2>The survey</h2>\n<p>The map the robot made of the house before, and its way through "
      "it.</p>\n" +
      image_tag(map_png, "map made by slam") + figures_table(survey);
  return html_page("Coop demo", body);
}

std::string render_json(const Record& survey, const Record& collection, const Summary& summary) {
  const nlohmann::ordered_json document{
      {"seed", summary.seed},       {"wall_seconds", summary.wall_seconds},
      {"version", summary.version}, {"success", is_success(collection)},
      {"survey", to_json(survey)},  {"collection", to_json(collection)}};
  return document.dump(2) + "\n";
}

void write_report(const std::filesystem::path& folder, const Record& survey,
                  const Record& collection, const Summary& summary) {
  const std::string run_png = encode_png(draw_run(collection));
  const std::string map_png = encode_png(draw_map(survey.map, survey.track));
  write_file_atomically(folder / "run.png", run_png);
  write_file_atomically(folder / "map.png", map_png);
  write_file_atomically(folder / "figures.json", render_json(survey, collection, summary));
  write_file_atomically(folder / "report.html",
                        render_html(survey, collection, summary, run_png, map_png));
}

}  // namespace coop::demo
