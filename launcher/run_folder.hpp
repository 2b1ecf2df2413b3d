#pragma once
#include <filesystem>

namespace coop::launcher {

/// The folder of one run: PARENT/<date>-<time>, with logs/ in it; PARENT/latest leads to the
/// newest.
class RunFolder {
 public:
  /// Creates it. Throws config::Error where that is not possible.
  explicit RunFolder(const std::filesystem::path& parent);
  /// Removes it again, unless keep() was called: a launch that did not start leaves nothing behind.
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  void keep();
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::filesystem::path logs() const { return path_ / "logs"; }

 private:
  std::filesystem::path path_;
  bool kept_ = false;
};

}  // namespace coop::launcher
