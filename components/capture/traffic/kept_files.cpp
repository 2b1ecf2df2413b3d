#include "capture/traffic/kept_files.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace coop::capture {

namespace fs = std::filesystem;

void keep_newest(const fs::path& folder, const std::string& prefix, const std::string& kind,
                 std::size_t count) {
  std::vector<std::pair<fs::file_time_type, fs::path>> found;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(prefix) || !name.ends_with(".mcap")) continue;
    if (name.find(kind, prefix.size()) == std::string::npos) continue;
    const auto written = entry.last_write_time(error);
    if (!error) found.emplace_back(written, entry.path());
  }
  std::ranges::sort(found);
  for (std::size_t i = 0; i + count < found.size(); ++i) fs::remove(found[i].second, error);
}

}  // namespace coop::capture
