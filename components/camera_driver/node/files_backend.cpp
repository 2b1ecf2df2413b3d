#include "camera_driver/node/files_backend.hpp"

#include <algorithm>

#include "camera_driver/node/camera_driver_node.hpp"
#include "core/config/error.hpp"
#include "core/image/picture_file.hpp"

namespace coop::camera_driver {

FilesBackend::FilesBackend(runtime::Node& node, const FilesConfig& config)
    : node_(node), config_(config.photograph), files_(list(config.folder)), topics_(node) {
  node.every(seconds(config.period), [this] { show_next(); });
}

std::vector<std::filesystem::path> FilesBackend::list(const std::string& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code problem;
  for (const auto& entry : std::filesystem::directory_iterator(folder, problem)) {
    const auto extension = entry.path().extension();
    if (extension == ".png" || extension == ".jpg" || extension == ".jpeg") {
      files.push_back(entry.path());
    }
  }
  if (files.empty()) {
    throw config::Error("files.folder: expected a folder with PNG or JPEG pictures, got '" +
                        folder + "'");
  }
  std::ranges::sort(files);
  return files;
}

void FilesBackend::show_next() {
  if (next_ == files_.size()) {
    node_.finish("all pictures were shown");
    return;
  }
  const std::filesystem::path& file = files_[next_++];
  auto picture = read_picture(file);
  if (!picture) {
    node_.log().warning("{} is no picture: {}", file.string(), picture.error());
    return;
  }
  const Frame frame{node_.now(), std::move(*picture), {}};
  const Intrinsics camera = d435i_intrinsics(frame.colour.cols, frame.colour.rows);
  std::vector<Detection> eggs;
  for (const PhotographedEgg& egg : find_eggs(config_, frame.colour)) {
    eggs.push_back(to_detection(egg, camera));
  }
  node_.log().info("{}: {} eggs", file.filename().string(), eggs.size());
  topics_.publish(frame, camera);
  topics_.publish(frame.stamp, std::move(eggs));
}

}  // namespace coop::camera_driver
