#include "capture/traffic/kept_files.hpp"

#include <algorithm>
#include <vector>

namespace coop::capture {

namespace fs = std::filesystem;

namespace {

struct KeptFile {
  fs::file_time_type written;
  fs::path path;
  std::uint64_t bytes = 0;
};

/// The oldest first.
std::vector<KeptFile> files_of(const fs::path& folder, const std::string& prefix,
                               const std::string& kind) {
  std::vector<KeptFile> found;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(prefix) || !name.ends_with(".mcap")) continue;
    if (name.find(kind, prefix.size()) == std::string::npos) continue;
    KeptFile file{entry.last_write_time(error), entry.path()};
    if (error) continue;
    file.bytes = entry.file_size(error);
    if (!error) found.push_back(std::move(file));
  }
  std::ranges::sort(found, {}, &KeptFile::written);
  return found;
}

}  // namespace

bool keep_newest(const fs::path& folder, const std::string& prefix, const std::string& kind,
                 const KeptLimits& limits) {
  const std::vector<KeptFile> found = files_of(folder, prefix, kind);
  std::uint64_t bytes = 0;
  for (const KeptFile& file : found) bytes += file.bytes;
  std::error_code error;
  const fs::space_info disk = fs::space(folder, error);
  std::uint64_t free = error ? limits.free_bytes : disk.available;
  if (free + bytes < limits.free_bytes) return false;
  std::size_t count = found.size();
  for (const KeptFile& file : found) {
    if (count <= limits.count && bytes <= limits.bytes && free >= limits.free_bytes) break;
    if (!fs::remove(file.path, error)) continue;
    --count;
    bytes -= file.bytes;
    free += file.bytes;
  }
  return free >= limits.free_bytes;
}

}  // namespace coop::capture
