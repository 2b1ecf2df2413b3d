#pragma once
#include <memory>
#include <string>
#include <vector>

#include "system/support/running_system.hpp"

namespace coop::test {

/// A program of the machine, run to its end.
struct Answer {
  int code = -1;  ///< -1: not ended within the limit
  std::string output;
};
[[nodiscard]] Answer run_tool(const std::string& program, const std::vector<std::string>& arguments,
                              milliseconds limit = std::chrono::minutes(2));
/// The same, throwing std::runtime_error with the output's end where it fails.
std::string need_tool(const std::string& program, const std::vector<std::string>& arguments,
                      milliseconds limit = std::chrono::minutes(2));
/// Full path, or empty.
[[nodiscard]] std::string find_tool(const std::string& name);

/// The engine that runs on this machine; where none does, Debian's own dockerd with data and socket
/// apart, gone with the object. DOCKER_HOST of this process names it.
class ContainerEngine {
 public:
  /// Why there can be none here; empty where there can.
  [[nodiscard]] static std::string obstacle();

  /// Throws std::runtime_error with the end of its log.
  ContainerEngine();
  ~ContainerEngine();
  ContainerEngine(const ContainerEngine&) = delete;
  ContainerEngine& operator=(const ContainerEngine&) = delete;

  [[nodiscard]] bool is_own() const { return daemon_ != nullptr; }
  /// `debian:bookworm-slim`, where it is missing: made by mmdebstrap with `packages`, and kept in
  /// `cache` for the next time.
  void need_base_image(const std::filesystem::path& cache, const std::string& packages) const;

 private:
  void start();
  [[nodiscard]] std::filesystem::path folder() const { return folder_.path(); }

  TemporaryFolder folder_;
  bool had_bridge_ = true;
  std::unique_ptr<Program> daemon_;
};

/// The base image of the Dockerfile.
inline constexpr const char* kBaseImage = "debian:bookworm-slim";

}  // namespace coop::test
