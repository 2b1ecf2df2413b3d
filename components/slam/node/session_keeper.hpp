#pragma once
#include <filesystem>
#include <future>
#include <optional>
#include <string>

#include "core/result.hpp"
#include "slam/session_file.hpp"

namespace coop::slam {

/// The session's file. It is written by a thread of its own, so that a large map and a slow disk do
/// not hold up the mapper: taking a copy of the map costs a counted reference a tile.
class SessionKeeper {
 public:
  /// An empty path keeps nothing.
  explicit SessionKeeper(std::filesystem::path path) : path_(std::move(path)) {}

  /// Nothing where there is no file, the reason where it is of no use.
  [[nodiscard]] std::optional<Result<Session>> load() const;
  /// Begins to write. False where the last one is still being written.
  bool begin_save(Session session);
  /// What went wrong with the last session that was begun, once; waits for it if told to.
  [[nodiscard]] std::optional<std::string> take_problem(bool wait = false);
  [[nodiscard]] bool is_active() const { return !path_.empty(); }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  std::future<std::optional<std::string>> writing_;  ///< its problem
};

}  // namespace coop::slam
