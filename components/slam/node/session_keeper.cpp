#include "slam/node/session_keeper.hpp"

#include <chrono>

#include "core/atomic_file.hpp"

namespace coop::slam {

std::optional<Result<Session>> SessionKeeper::load() const {
  std::error_code error;
  if (path_.empty() || !std::filesystem::exists(path_, error)) return std::nullopt;
  try {
    return parse_session(read_file(path_));
  } catch (const std::exception& problem) {
    return fail(std::string(problem.what()));
  }
}

bool SessionKeeper::begin_save(Session session) {
  if (writing_.valid()) return false;
  writing_ =
      std::async(std::launch::async,
                 [path = path_, session = std::move(session)]() -> std::optional<std::string> {
                   try {
                     write_file_atomically(path, to_bytes(session));
                     return std::nullopt;
                   } catch (const std::exception& problem) {
                     return problem.what();
                   }
                 });
  return true;
}

std::optional<std::string> SessionKeeper::take_problem(bool wait) {
  if (!writing_.valid()) return std::nullopt;
  if (!wait && writing_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
    return std::nullopt;
  return writing_.get();
}

}  // namespace coop::slam
