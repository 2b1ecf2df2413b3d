#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace coop {

/// Folders in which this user's running systems leave their sockets and state files, the preferred
/// one first. COOP_RUNTIME_DIR in the environment names the only one.
[[nodiscard]] std::vector<std::filesystem::path> runtime_folders();

/// Makes a folder for this user alone; false where it cannot be had or is somebody else's.
[[nodiscard]] bool make_private_folder(const std::filesystem::path& folder);

/// How files of one system are called: DOMAIN or DOMAIN-ROBOT.
[[nodiscard]] std::string system_file_stem(const std::string& robot, int domain);

}  // namespace coop
