#include "core/places.hpp"

#include <cstdlib>

#include "core/config/error.hpp"

namespace coop {
namespace {

std::filesystem::path find_share(const std::filesystem::path& programs) {
  if (const char* share = std::getenv("COOP_HOME")) return share;
  std::error_code error;
  for (auto folder = programs; !folder.empty(); folder = folder.parent_path()) {
    if (std::filesystem::is_directory(folder / "config" / "launch", error)) return folder;
    const auto installed = folder / "share" / "coop";
    if (std::filesystem::is_directory(installed / "config" / "launch", error)) return installed;
    if (folder == folder.root_path()) break;
  }
  throw config::Error("no folder with config/launch above " + programs.string() +
                      "; set COOP_HOME to the folder that holds config/ and maps/");
}

}  // namespace

Places Places::of_this_program() {
  Places places;
  places.programs = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  places.share = find_share(places.programs);
  return places;
}

std::filesystem::path find_file(const std::filesystem::path& name,
                                const std::vector<std::filesystem::path>& folders) {
  std::error_code error;
  if (name.empty()) return {};
  if (name.is_absolute()) return std::filesystem::is_regular_file(name, error) ? name : "";
  for (const auto& folder : folders) {
    const auto candidate = folder / name;
    if (std::filesystem::is_regular_file(candidate, error)) return candidate.lexically_normal();
  }
  return {};
}

}  // namespace coop
