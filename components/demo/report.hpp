#pragma once
#include <filesystem>
#include <string>

#include "demo/record.hpp"

namespace coop::demo {

struct Summary {
  std::uint64_t seed = 0;
  double wall_seconds = 0.0;
  std::string version;
};

/// One self-contained HTML page (images within) of both parts of the demo.
[[nodiscard]] std::string render_html(const Record& survey, const Record& collection,
                                      const Summary& summary, const std::string& run_png,
                                      const std::string& map_png);

/// Writes run.png, map.png, report.html and figures.json into the folder, each atomically; the map
/// itself is already there.
void write_report(const std::filesystem::path& folder, const Record& survey,
                  const Record& collection, const Summary& summary);

/// The figures in machine-readable form.
[[nodiscard]] std::string render_json(const Record& survey, const Record& collection,
                                      const Summary& summary);

}  // namespace coop::demo
