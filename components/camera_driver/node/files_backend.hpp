#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "camera_driver/node/camera_topics.hpp"
#include "camera_driver/photograph.hpp"
#include "runtime/node.hpp"

namespace coop::camera_driver {

struct FilesConfig;

/// Shows the pictures of a folder one after the other and tells the eggs in them; then the program
/// ends. A file that is no picture is left out with a warning.
class FilesBackend {
 public:
  FilesBackend(runtime::Node& node, const FilesConfig& config);

  /// PNG and JPEG files by name. Throws config::Error where there are none.
  static std::vector<std::filesystem::path> list(const std::string& folder);

 private:
  void show_next();

  runtime::Node& node_;
  PhotographConfig config_;
  std::vector<std::filesystem::path> files_;
  std::size_t next_ = 0;
  CameraTopics topics_;
};

}  // namespace coop::camera_driver
