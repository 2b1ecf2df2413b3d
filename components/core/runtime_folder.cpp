#include "core/runtime_folder.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>

namespace coop {

std::vector<std::filesystem::path> runtime_folders() {
  if (const char* chosen = std::getenv("COOP_RUNTIME_DIR")) return {chosen};
  std::vector<std::filesystem::path> folders;
  const std::string user = std::to_string(getuid());
  if (const char* runtime = std::getenv("XDG_RUNTIME_DIR"); runtime != nullptr && *runtime == '/') {
    folders.emplace_back(std::filesystem::path(runtime) / "coop");
  }
  // Found as well from a terminal whose environment lacks the variable.
  folders.emplace_back(std::filesystem::path("/run/user") / user / "coop");
  // That of the service; its user owns it, and root looks into it.
  std::error_code ignored;
  if (const std::filesystem::path service = "/run/coop";
      std::filesystem::is_directory(service, ignored)) {
    folders.push_back(service);
  }
  folders.emplace_back(std::filesystem::temp_directory_path() / ("coop-" + user));
  return folders;
}

bool make_private_folder(const std::filesystem::path& folder) {
  if (mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) return false;
  struct stat status {};
  if (lstat(folder.c_str(), &status) != 0 || !S_ISDIR(status.st_mode)) return false;
  return status.st_uid == geteuid() && (status.st_mode & 077U) == 0;
}

std::string system_file_stem(const std::string& robot, int domain) {
  return std::to_string(domain) + (robot.empty() ? "" : "-" + robot);
}

}  // namespace coop
