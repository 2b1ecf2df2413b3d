#include "demo/report_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "core/markup.hpp"
#include "demo/figures.hpp"

namespace coop::demo {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

std::string base64(const std::string& bytes) {
  static constexpr std::string_view kAlphabet =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t j = 0; j < 3; ++j) {
      group = (group << 8U) | (j < count ? static_cast<unsigned char>(bytes[i + j]) : 0U);
    }
    for (std::size_t j = 0; j < 4; ++j) {
      out += j <= count ? kAlphabet[(group >> (18U - 6U * j)) & 63U] : '=';
    }
  }
  return out;
}

std::string row(const std::string& name, const std::string& value) {
  return "<tr><th>" + name + "</th><td>" + value + "</td></tr>\n";
}

}  // namespace

std::string image_tag(const std::string& png, std::string_view alt) {
  return "<img alt=\"" + std::string(alt) + "\" src=\"data:image/png;base64," + base64(png) +
         "\">\n";
}

std::string figures_table(const Record& record) {
  const Figures f = compute_figures(record);
  return "<table>\n" +
         row("mission", escape_markup(record.mission_state + " " + record.mission_detail)) +
         row("time", fmt::format("{:.1f} s", f.duration)) +
         row("distance driven", fmt::format("{:.1f} m", f.distance_driven)) +
         row("mean speed", fmt::format("{:.2f} m/s", f.mean_speed)) +
         row("error of position, mean / 95 % / max",
             fmt::format("{:.3f} / {:.3f} / {:.3f} m", f.position_error.mean, f.position_error.p95,
                         f.position_error.max)) +
         row("error of heading, mean / 95 % / max",
             fmt::format("{:.2f} / {:.2f} / {:.2f} deg", kDegrees * f.heading_error.mean,
                         kDegrees * f.heading_error.p95, kDegrees * f.heading_error.max)) +
         row("collisions", std::to_string(record.collisions)) + "</table>\n";
}

std::string target_table(const Record& record, std::string_view name) {
  std::string out = fmt::format(
      "<table>\n<tr><th>order</th><th>{}</th><th>x, y in map</th><th>result</th>"
      "<th>attempts</th><th>reason</th></tr>\n",
      name);
  for (const TargetRecord& target : record.targets) {
    const auto place = std::ranges::find(record.order, target.id);
    out += fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{:.2f}, {:.2f} m</td><td class=\"{}\">{}</td>"
        "<td>{}</td><td>{}</td></tr>\n",
        place == record.order.end() ? std::string("-")
                                    : std::to_string(place - record.order.begin() + 1),
        escape_markup(target.id), target.place_in_map.x(), target.place_in_map.y(),
        is_done(target) ? "good" : "bad", escape_markup(target.state), target.attempts,
        escape_markup(target.reason));
  }
  return out + "</table>\n";
}

nlohmann::ordered_json to_json(const Record& record) {
  const Figures f = compute_figures(record);
  nlohmann::ordered_json targets = nlohmann::ordered_json::array();
  for (const TargetRecord& target : record.targets) {
    targets.push_back({{"id", target.id},
                       {"x", target.place_in_map.x()},
                       {"y", target.place_in_map.y()},
                       {"state", target.state},
                       {"attempts", target.attempts},
                       {"reason", target.reason}});
  }
  const auto errors = [](const ErrorFigures& e) {
    return nlohmann::ordered_json{{"mean", e.mean}, {"p95", e.p95}, {"max", e.max}};
  };
  return {{"mission", record.mission_state},
          {"detail", record.mission_detail},
          {"duration_s", f.duration},
          {"distance_m", f.distance_driven},
          {"position_error_m", errors(f.position_error)},
          {"heading_error_rad", errors(f.heading_error)},
          {"collisions", record.collisions},
          {"targets_in_world", record.targets_in_world},
          {"targets_taken", record.targets_taken},
          {"order", record.order},
          {"tour_cost_m", record.tour_cost},
          {"targets", targets}};
}

}  // namespace coop::demo
