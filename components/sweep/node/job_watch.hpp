#pragma once
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "sweep/node/command.hpp"
#include "sweep/slurm.hpp"

namespace coop::sweep {

/// Asks squeue now and then what became of the tasks of one array job. A controller that does not
/// answer is waited for.
class JobWatch {
 public:
  /// `output`: a file for squeue's answers. `pause`: between two questions.
  JobWatch(std::filesystem::path squeue, std::string job, std::filesystem::path output,
           std::chrono::milliseconds pause);

  /// Never waits; call it often.
  void look();
  /// No task waits or runs any more: said twice in a row, so that results that were written last
  /// have had time to be seen through a network file system.
  [[nodiscard]] bool is_over() const { return answers_without_active_ >= 2; }
  [[nodiscard]] const ArrayState& state() const { return state_; }
  [[nodiscard]] std::string text() const;

 private:
  void take(const Answer& answer);

  std::filesystem::path squeue_;
  std::string job_;
  std::filesystem::path output_;
  std::chrono::milliseconds pause_;
  std::chrono::steady_clock::time_point next_{};
  std::optional<Command> question_;
  ArrayState state_;
  bool has_answered_ = false;
  int answers_without_active_ = 0;
  std::string trouble_;
};

}  // namespace coop::sweep
