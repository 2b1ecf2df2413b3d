#include "demo/cleaning_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "core/atomic_file.hpp"
#include "core/image/picture_file.hpp"
#include "core/markup.hpp"
#include "demo/canvas.hpp"
#include "demo/figures.hpp"
#include "demo/report_parts.hpp"

namespace coop::demo {
namespace {

// Blue, green, red.
const cv::Scalar kManure(30, 52, 96);
const cv::Scalar kPig(166, 160, 236);
const cv::Scalar kPigWay(205, 200, 245);
const cv::Scalar kLeft(60, 60, 230);

constexpr double kPenPixelsPerMetre = 180.0;
constexpr double kHousePixelsPerMetre = 60.0;
/// A pen of 5 m x 3 m with its walls, m in map.
const Eigen::AlignedBox2d kPen(Eigen::Vector2d(-0.1, -0.1), Eigen::Vector2d(5.1, 3.1));
/// Sightings of a heap as far from its place as this are of another one, m.
constexpr double kSameHeap = 0.15;

void draw_pigs(Canvas& canvas, const Record& record) {
  for (const auto& track : record.animal_tracks) canvas.line(track, kPigWay, 2);
  for (std::size_t i = 0; i < record.animal_tracks.size(); ++i) {
    if (record.animal_tracks[i].empty()) continue;
    const cv::Point at = canvas.pixel(record.animal_tracks[i].back());
    cv::circle(canvas.image(), at, canvas.pixels(record.animal_radii[i]), kPig, cv::FILLED,
               cv::LINE_AA);
  }
}

/// The place of the heap in the order of the mission, and what the mission says became of it.
std::string story_of(const world::Heap& heap, const Record& record) {
  for (std::size_t i = 0; i < record.order.size(); ++i) {
    const auto task = std::ranges::find(record.targets, record.order[i], &TargetRecord::id);
    if (task != record.targets.end() && (task->place_in_map - heap.position).norm() < kSameHeap) {
      return std::to_string(i + 1);
    }
  }
  return heap.state == world::HeapState::kCleaned ? "in passing" : "not seen";
}

void draw_heaps(Canvas& canvas, const Record& record, bool with_names) {
  for (const world::Heap& heap : record.heaps) {
    const bool cleaned = heap.state == world::HeapState::kCleaned;
    const cv::Point at = canvas.pixel(heap.position);
    const int radius = canvas.pixels(heap.radius);
    cv::circle(canvas.image(), at, radius, cleaned ? kWhite : kManure, cv::FILLED, cv::LINE_AA);
    cv::circle(canvas.image(), at, radius, cleaned ? kManure : kLeft, 2, cv::LINE_AA);
    if (with_names) {
      canvas.label(at + cv::Point(radius + 3, -radius), story_of(heap, record), kBlack);
    }
  }
}

std::string pen_row(const PenRun& run) {
  const Figures f = compute_figures(run.record);
  return fmt::format(
      "<tr><td>{}</td><td>{}</td><td class=\"{}\">{} of {}</td><td>{}</td><td>{}</td>"
      "<td>{:.0f} s</td><td>{:.1f} m</td><td>{:.3f} m</td></tr>\n",
      run.pen, run.seed, is_clean(run.record) ? "good" : "bad", run.record.targets_taken,
      run.record.targets_in_world, run.record.animal_collisions,
      run.record.collisions - run.record.animal_collisions, f.duration, f.distance_driven,
      f.position_error.mean);
}

std::string pens_table(const std::vector<PenRun>& runs) {
  std::string out =
      "<table>\n<tr><th>pen</th><th>seed</th><th>heaps cleaned</th><th>pigs touched</th>"
      "<th>walls touched</th><th>time</th><th>driven</th><th>error of position, mean</th></tr>\n";
  for (const PenRun& run : runs) out += pen_row(run);
  return out + "</table>\n";
}

std::string pen_section(const PenRun& run) {
  std::string out = fmt::format("<h2>Pen {}</h2>\n", run.pen) +
                    image_tag(encode_png(draw_pen(run.record)), "the pen, heaps, pigs and the way");
  if (!run.record.first_view.empty()) {
    out += "<p>What the camera above saw at the start, and at the end:</p>\n" +
           image_tag(encode_png(run.record.first_view), "picture at the start") +
           image_tag(encode_png(run.record.last_view), "picture at the end");
  }
  return out + figures_table(run.record) + target_table(run.record, "heap");
}

bool all_clean(const std::vector<PenRun>& runs) {
  return std::ranges::all_of(runs, [](const PenRun& run) { return is_clean(run.record); });
}

}  // namespace

cv::Mat draw_pen(const Record& record) {
  Canvas canvas(record.map, map_colour, kPenPixelsPerMetre, kPen);
  draw_pigs(canvas, record);
  draw_heaps(canvas, record, false);
  canvas.tracks(record.track);
  draw_heaps(canvas, record, true);
  Legend legend(canvas.image(), 0);
  legend.entry(kTruthColour, "driven");
  legend.entry(kEstimateColour, "estimated");
  legend.entry(kWhite, "cleaned, number = order");
  legend.entry(kManure, "left");
  legend.entry(kPig, "pig at the end, and its way");
  return legend.image();
}

cv::Mat draw_house(const std::vector<PenRun>& runs) {
  Canvas canvas(runs.front().record.map, map_colour, kHousePixelsPerMetre);
  for (const PenRun& run : runs) {
    canvas.use_origin_of(run.record.map);
    draw_pigs(canvas, run.record);
    draw_heaps(canvas, run.record, false);
    canvas.tracks(run.record.track);
  }
  return canvas.image();
}

std::string render_cleaning_html(const std::vector<PenRun>& runs, const Summary& summary) {
  int cleaned = 0;
  int heaps = 0;
  std::uint32_t touched = 0;
  for (const PenRun& run : runs) {
    cleaned += run.record.targets_taken;
    heaps += run.record.targets_in_world;
    touched += run.record.animal_collisions;
  }
  std::string body =
      "<h1>Cleaning in the pig house</h1>\n" +
      fmt::format("<p class=\"{}\">{} of {} heaps cleaned, {} pigs touched.</p>\n",
                  all_clean(runs) ? "good" : "bad", cleaned, heaps, touched) +
      fmt::format("<p>Seed {}, {:.0f} s of wall time, {}.</p>\n", summary.seed,
                  summary.wall_seconds, escape_markup(summary.version)) +
      image_tag(encode_png(draw_house(runs)), "the pig house: eight pens of 5 m x 3 m") +
      pens_table(runs);
  for (const PenRun& run : runs) body += pen_section(run);
  return html_page("Coop demo: pig pen", body);
}

std::string render_cleaning_json(const std::vector<PenRun>& runs, const Summary& summary) {
  nlohmann::ordered_json pens = nlohmann::ordered_json::array();
  for (const PenRun& run : runs) {
    nlohmann::ordered_json pen = to_json(run.record);
    pen["pen"] = run.pen;
    pen["seed"] = run.seed;
    pen["animal_collisions"] = run.record.animal_collisions;
    pens.push_back(std::move(pen));
  }
  const nlohmann::ordered_json document{{"seed", summary.seed},
                                        {"wall_seconds", summary.wall_seconds},
                                        {"version", summary.version},
                                        {"success", all_clean(runs)},
                                        {"pens", pens}};
  return document.dump(2) + "\n";
}

void write_cleaning_report(const std::filesystem::path& folder, const std::vector<PenRun>& runs,
                           const Summary& summary) {
  write_file_atomically(folder / "run.png", encode_png(draw_pen(runs.front().record)));
  write_file_atomically(folder / "house.png", encode_png(draw_house(runs)));
  write_file_atomically(folder / "figures.json", render_cleaning_json(runs, summary));
  write_file_atomically(folder / "report.html", render_cleaning_html(runs, summary));
}

}  // namespace coop::demo
