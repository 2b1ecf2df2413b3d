#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "demo/record.hpp"
#include "demo/report.hpp"

namespace coop::demo {

/// One pen of the pig house and what happened in it.
struct PenRun {
  int pen = 1;
  std::uint64_t seed = 0;
  Record record;
};

/// A pen from above: where the robot drove, heaps (cleaned: hollow, with their place in the order;
/// left: filled), where each pig walked and where it stood at last.
[[nodiscard]] cv::Mat draw_pen(const Record& record);

/// The whole house with the ways through all pens that were cleaned.
[[nodiscard]] cv::Mat draw_house(const std::vector<PenRun>& runs);

/// One self-contained HTML page (images within).
[[nodiscard]] std::string render_cleaning_html(const std::vector<PenRun>& runs,
                                               const Summary& summary);
[[nodiscard]] std::string render_cleaning_json(const std::vector<PenRun>& runs,
                                               const Summary& summary);

/// Writes run.png (the first pen), house.png, report.html and figures.json into the folder, each
/// atomically.
void write_cleaning_report(const std::filesystem::path& folder, const std::vector<PenRun>& runs,
                           const Summary& summary);

}  // namespace coop::demo
