#include "capture/mcap_tool/attachments.hpp"

#include <algorithm>
#include <stdexcept>

#include "core/atomic_file.hpp"

namespace coop::mcap {
namespace {

constexpr std::size_t kLongestName = 200;

std::filesystem::path free_name(const std::filesystem::path& folder, const std::string& name) {
  std::filesystem::path path = folder / name;
  for (int number = 2; std::filesystem::exists(std::filesystem::symlink_status(path)); ++number) {
    path = folder / (std::to_string(number) + "_" + name);
  }
  return path;
}

}  // namespace

std::string safe_file_name(const std::string& name) {
  std::string safe = name.substr(0, kLongestName);
  for (char& c : safe) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '/' || c == '\\' || code < 0x20 || code == 0x7F) c = '_';
  }
  if (safe.empty()) return "unnamed";
  if (safe.front() == '.') safe.front() = '_';
  return safe;
}

std::vector<std::filesystem::path> extract_attachments(const Reader& reader,
                                                       const std::vector<std::string>& names,
                                                       const std::filesystem::path& folder) {
  const std::vector<AttachmentIndex>& all = reader.summary().attachments;
  for (const std::string& name : names) {
    if (std::ranges::count(all, name, &AttachmentIndex::name) == 0) {
      throw std::invalid_argument(reader.source().name() + ": no attachment '" + name + "'");
    }
  }
  std::filesystem::create_directories(folder);
  std::vector<std::filesystem::path> files;
  for (const AttachmentIndex& index : all) {
    if (!names.empty() && std::ranges::count(names, index.name) == 0) continue;
    const OwnedAttachment owned = reader.attachment(index);
    const Bytes data = owned.attachment.data;
    files.push_back(free_name(folder, safe_file_name(index.name)));
    write_file_atomically(files.back(), {reinterpret_cast<const char*>(data.data()), data.size()});
  }
  return files;
}

}  // namespace coop::mcap
