#include <fmt/format.h>

#include "core/markup.hpp"
#include "experiments/casma/report.hpp"

namespace coop::casma {
namespace {

constexpr double kCell = 11.0;
constexpr double kMargin = 34.0;
constexpr double kLegend = 190.0;

}  // namespace

std::string draw_pen(const std::string& title, int width, int height, const std::vector<Pig>& pigs,
                     const std::vector<DrawnPath>& paths) {
  const double w = width * kCell;
  const double h = height * kCell;
  const auto px = [](double x) { return kMargin + x * kCell; };
  const auto py = [&](double y) { return kMargin + h - y * kCell; };
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" font-size=\"13\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
      "<text x=\"{2}\" y=\"22\" font-size=\"15\">{3}</text>\n"
      "<rect x=\"{2}\" y=\"{2}\" width=\"{4:.0f}\" height=\"{5:.0f}\" fill=\"#fbfbf6\" "
      "stroke=\"black\"/>\n",
      w + 2 * kMargin + kLegend, h + 2 * kMargin, kMargin, escape_markup(title), w, h);
  for (const Pig& pig : pigs) {
    const double half = 0.5 * pig.size;
    out += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" rx=\"5\" "
        "fill=\"#f0b0b8\" stroke=\"#b06070\"/>\n",
        px(pig.middle.x + 0.5 - half), py(pig.middle.y + 0.5 + half), pig.size * kCell,
        pig.size * kCell);
  }
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const DrawnPath& path = paths[i];
    // Beside one another where they share cells.
    const double shift =
        0.16 * (static_cast<double>(i) - 0.5 * static_cast<double>(paths.size() - 1));
    std::string points;
    for (const Cell cell : path.cells) {
      points += fmt::format("{:.1f},{:.1f} ", px(cell.x + 0.5 + shift), py(cell.y + 0.5 + shift));
    }
    out +=
        fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"{}/>\n",
                    points, path.colour, path.dashed ? " stroke-dasharray=\"5 3\"" : "");
    const double y = kMargin + 14 + 20 * static_cast<double>(i);
    const double x = w + kMargin + 12;
    out += fmt::format(
        "<line x1=\"{:.0f}\" y1=\"{:.0f}\" x2=\"{:.0f}\" y2=\"{:.0f}\" stroke=\"{}\" "
        "stroke-width=\"2\"{}/>\n<text x=\"{:.0f}\" y=\"{:.0f}\">{}</text>\n",
        x, y - 4, x + 24, y - 4, path.colour, path.dashed ? " stroke-dasharray=\"5 3\"" : "",
        x + 30, y, escape_markup(path.name));
  }
  if (!paths.empty() && !paths.front().cells.empty()) {
    const Cell start = paths.front().cells.front();
    const Cell goal = paths.front().cells.back();
    out += fmt::format(
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"6\" fill=\"#1f5fa8\"/>\n"
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"6\" fill=\"#2a8a4a\"/>\n",
        px(start.x + 0.5), py(start.y + 0.5), px(goal.x + 0.5), py(goal.y + 0.5));
  }
  return out + "</svg>\n";
}

}  // namespace coop::casma
