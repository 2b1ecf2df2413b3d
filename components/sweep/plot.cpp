#include "sweep/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "core/markup.hpp"

namespace coop::sweep {
namespace {

constexpr double kWidth = 720.0;
constexpr double kHeight = 440.0;
constexpr double kLeft = 80.0;
constexpr double kRight = 170.0;
constexpr double kTop = 44.0;
constexpr double kBottom = 60.0;
constexpr std::array<const char*, 8> kColours{"#1f5fa8", "#c8501e", "#2a8a4a", "#8a3a9a",
                                              "#b08a00", "#2a9aa8", "#7a4a2a", "#555555"};

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void take(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  /// Never empty; what is not negative stays so.
  void widen() {
    if (low > high) low = high = 0.0;
    if (high - low > 1e-12) return;
    const double margin = std::max(0.5 * std::abs(low), 0.5);
    low = low < 0.0 ? low - margin : std::max(0.0, low - margin);
    high += margin;
  }
};

/// The drawing's frame: from values to pixels, axes and labels.
class Frame {
 public:
  Frame(const Range& x, const Range& y, double width, double height)
      : x_(x), y_(y), width_(width), height_(height) {}

  [[nodiscard]] double px(double x) const {
    return kLeft + (x - x_.low) / (x_.high - x_.low) * (width_ - kLeft - kRight);
  }
  [[nodiscard]] double py(double y) const {
    return height_ - kBottom - (y - y_.low) / (y_.high - y_.low) * (height_ - kTop - kBottom);
  }
  [[nodiscard]] std::string begin(const std::string& title, const std::string& x_label,
                                  const std::string& y_label) const {
    std::string out = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
        "{1}\" font-family=\"sans-serif\" font-size=\"13\">\n"
        "<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n",
        width_, height_);
    out += text(width_ / 2, 24, title, "middle", 16);
    out += text((kLeft + width_ - kRight) / 2, height_ - 16, x_label, "middle");
    out += fmt::format("<g transform=\"translate(20,{:.1f}) rotate(-90)\">{}</g>\n",
                       (kTop + height_ - kBottom) / 2, text(0, 0, y_label, "middle"));
    return out;
  }
  [[nodiscard]] static std::string text(double x, double y, const std::string& words,
                                        const char* anchor, int size = 13) {
    return fmt::format(
        "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" font-size=\"{}\">{}</text>\n", x, y,
        anchor, size, escape_markup(words));
  }
  [[nodiscard]] static std::string line(double x1, double y1, double x2, double y2,
                                        const std::string& style) {
    return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", x1,
                       y1, x2, y2, style);
  }
  [[nodiscard]] std::string y_tick(double value) const {
    return line(kLeft, py(value), width_ - kRight, py(value), "stroke=\"#dddddd\"") +
           text(kLeft - 8, py(value) + 4, fmt::format("{:.6g}", value), "end");
  }
  [[nodiscard]] std::string x_tick(double value, const std::string& words) const {
    return line(px(value), height_ - kBottom, px(value), height_ - kBottom + 5,
                "stroke=\"black\"") +
           text(px(value), height_ - kBottom + 20, words, "middle");
  }
  [[nodiscard]] std::string border() const {
    return fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" "
        "stroke=\"black\"/>\n",
        kLeft, kTop, width_ - kLeft - kRight, height_ - kTop - kBottom);
  }
  [[nodiscard]] std::string legend(std::size_t place, const std::string& name,
                                   const std::string& colour) const {
    const double y = kTop + 14 + 20 * static_cast<double>(place);
    const double x = width_ - kRight + 14;
    return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"5\" fill=\"{}\"/>\n", x, y - 4,
                       colour) +
           text(x + 12, y, name, "start");
  }

 private:
  Range x_;
  Range y_;
  double width_;
  double height_;
};

std::optional<double> as_number(const std::string& text) {
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stopped != end) return std::nullopt;
  return value;
}

std::vector<double> places_of(const std::vector<std::string>& names) {
  std::vector<double> places;
  for (const std::string& name : names) {
    const auto number = as_number(name);
    if (!number) break;
    places.push_back(*number);
  }
  if (places.size() == names.size()) return places;
  places.clear();
  for (std::size_t i = 0; i < names.size(); ++i) places.push_back(static_cast<double>(i));
  return places;
}

std::string draw_series(const Frame& frame, const Series& series, const std::vector<double>& places,
                        double shift, const std::string& colour) {
  std::string path;
  std::string marks;
  bool pen_down = false;
  for (std::size_t i = 0; i < series.values.size(); ++i) {
    const Estimate& value = series.values[i];
    if (value.count == 0) {
      pen_down = false;
      continue;
    }
    const double x = frame.px(places[i]) + shift;
    const double y = frame.py(value.value);
    path += fmt::format("{}{:.1f} {:.1f} ", pen_down ? 'L' : 'M', x, y);
    pen_down = true;
    marks +=
        fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"{}\"/>\n", x, y, colour);
    if (std::isfinite(value.low) && std::isfinite(value.high)) {
      const std::string stroke = "stroke=\"" + colour + "\" stroke-width=\"1.5\"";
      const double low = frame.py(value.low);
      const double high = frame.py(value.high);
      marks += Frame::line(x, low, x, high, stroke) + Frame::line(x - 4, low, x + 4, low, stroke) +
               Frame::line(x - 4, high, x + 4, high, stroke);
    }
  }
  return fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>\n", path,
                     colour) +
         marks;
}

}  // namespace

std::vector<double> ticks_for(double low, double high, int most) {
  const double rough = (high - low) / most;
  const double decade = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10.0 * decade;
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * decade >= rough * (1.0 - 1e-9)) {
      step = factor * decade;
      break;
    }
  }
  std::vector<double> ticks;
  const auto first = static_cast<long>(std::floor(low / step + 1e-9));
  const auto last = static_cast<long>(std::ceil(high / step - 1e-9));
  for (long i = first; i <= last; ++i) ticks.push_back(static_cast<double>(i) * step);
  return ticks;
}

std::string draw(const LinePlot& plot) {
  const std::vector<double> places = places_of(plot.places);
  Range x;
  Range y;
  for (const double place : places) x.take(place);
  for (const Series& series : plot.series) {
    for (const Estimate& value : series.values) {
      if (value.count == 0) continue;
      y.take(value.value);
      y.take(value.low);
      y.take(value.high);
    }
  }
  x.widen();
  y.widen();
  const double margin = 0.05 * (x.high - x.low);
  x = {x.low - margin, x.high + margin};
  const std::vector<double> ticks = ticks_for(y.low, y.high, 6);
  y = {ticks.front(), ticks.back()};
  const Frame frame(x, y, kWidth, kHeight);
  std::string out = frame.begin(plot.title, plot.x_label, plot.y_label);
  for (const double tick : ticks) out += frame.y_tick(tick);
  for (std::size_t i = 0; i < places.size(); ++i) out += frame.x_tick(places[i], plot.places[i]);
  out += frame.border();
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    // Side by side, so that intervals of equal height can be told apart.
    const double shift =
        5.0 * (static_cast<double>(i) - 0.5 * static_cast<double>(plot.series.size() - 1));
    const std::string colour = kColours.at(i % kColours.size());
    out += draw_series(frame, plot.series[i], places, shift, colour);
    if (plot.series.size() > 1) out += frame.legend(i, plot.series[i].name, colour);
  }
  return out + "</svg>\n";
}

std::string draw(const ScatterPlot& plot) {
  Range all;
  for (const double edge : {plot.half_box.x(), plot.half_box.y()}) {
    all.take(-1.1 * edge);
    all.take(1.1 * edge);
  }
  for (const auto& group : plot.groups) {
    for (const auto& point : group.points) {
      for (const double value : {point.x(), point.y()}) {
        all.take(value);
        all.take(-value);
      }
    }
  }
  all.widen();
  const std::vector<double> ticks = ticks_for(all.low, all.high, 8);
  all = {ticks.front(), ticks.back()};
  const double side = 460.0;
  const Frame frame(all, all, side + kLeft + kRight, side + kTop + kBottom);
  std::string out = frame.begin(plot.title, plot.x_label, plot.y_label);
  for (const double tick : ticks) {
    out += frame.y_tick(tick) + frame.x_tick(tick, fmt::format("{:.6g}", tick));
  }
  out += frame.border();
  out += fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"#2a8a4a\" "
      "fill-opacity=\"0.08\" stroke=\"#2a8a4a\" stroke-dasharray=\"6 4\"/>\n",
      frame.px(-plot.half_box.x()), frame.py(plot.half_box.y()),
      frame.px(plot.half_box.x()) - frame.px(-plot.half_box.x()),
      frame.py(-plot.half_box.y()) - frame.py(plot.half_box.y()));
  for (std::size_t i = 0; i < plot.groups.size(); ++i) {
    const auto& group = plot.groups[i];
    for (const auto& point : group.points) {
      out += fmt::format(
          "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"{}\" fill-opacity=\"0.7\"/>\n",
          frame.px(point.x()), frame.py(point.y()), group.colour);
    }
    out += frame.legend(i, group.name, group.colour);
  }
  return out + "</svg>\n";
}

std::string draw(const BarPlot& plot) {
  Range x;
  x.take(0.0);
  for (const auto& bar : plot.bars) x.take(bar.value);
  x.high = std::max(x.high, 1.0);
  const std::vector<double> ticks = ticks_for(x.low, x.high, 6);
  x = {ticks.front(), ticks.back()};
  constexpr double kBar = 30.0;
  const double height = kTop + kBottom + kBar * static_cast<double>(plot.bars.size());
  const double names = 90.0;
  const Frame frame(x, {0.0, static_cast<double>(plot.bars.size())}, kWidth, height);
  std::string out = frame.begin(plot.title, plot.x_label, "");
  out += fmt::format("<g transform=\"translate({},0)\">\n", names);
  for (const double tick : ticks) out += frame.x_tick(tick, fmt::format("{:.6g}", tick));
  for (std::size_t i = 0; i < plot.bars.size(); ++i) {
    const double y = kTop + kBar * static_cast<double>(i);
    out += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"#1f5fa8\"/>\n",
        kLeft, y + 5, frame.px(plot.bars[i].value) - kLeft, kBar - 10);
    out += Frame::text(kLeft - 8, y + 20, plot.bars[i].name, "end");
    out += Frame::text(frame.px(plot.bars[i].value) + 6, y + 20,
                       fmt::format("{:.6g}", plot.bars[i].value), "start");
  }
  return out + frame.border() + "</g>\n</svg>\n";
}

}  // namespace coop::sweep
