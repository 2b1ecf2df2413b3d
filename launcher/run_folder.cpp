#include "launcher/run_folder.hpp"

#include <unistd.h>

#include <ctime>
#include <string>
#include <system_error>

#include "core/config/error.hpp"

namespace coop::launcher {
namespace {

std::string date_and_time() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  char text[32];
  std::strftime(text, sizeof text, "%Y%m%d-%H%M%S", &local);
  return text;
}

}  // namespace

RunFolder::RunFolder(const std::filesystem::path& parent) {
  try {
    const std::filesystem::path folder = std::filesystem::absolute(parent);
    std::filesystem::create_directories(folder);
    const std::string stem = date_and_time();
    std::string name = stem;
    // Several launchers may start in the same second.
    for (int number = 2; !std::filesystem::create_directory(folder / name); ++number) {
      name = stem + "-" + std::to_string(number);
    }
    path_ = folder / name;
    std::filesystem::create_directory(logs());
  } catch (const std::filesystem::filesystem_error& problem) {
    throw config::Error("run_dir: cannot create a folder in " + parent.string() + ": " +
                        problem.code().message());
  }
}

void RunFolder::keep() {
  kept_ = true;
  // Replaced in one step, so that nobody finds it missing; without it only convenience is lost.
  std::error_code ignored;
  const auto link = path_.parent_path() / ("latest." + std::to_string(getpid()));
  std::filesystem::create_directory_symlink(path_.filename(), link, ignored);
  std::filesystem::rename(link, path_.parent_path() / "latest", ignored);
}

RunFolder::~RunFolder() {
  std::error_code ignored;
  if (!kept_) std::filesystem::remove_all(path_, ignored);
}

}  // namespace coop::launcher
