#include "sweep/node/job_watch.hpp"

#include <fmt/format.h>

#include <utility>

namespace coop::sweep {

JobWatch::JobWatch(std::filesystem::path squeue, std::string job, std::filesystem::path output,
                   std::chrono::milliseconds pause)
    : squeue_(std::move(squeue)), job_(std::move(job)), output_(std::move(output)), pause_(pause) {}

void JobWatch::look() {
  const auto now = std::chrono::steady_clock::now();
  if (question_) {
    const auto answer = question_->poll();
    if (!answer) return;
    question_.reset();
    next_ = now + pause_;
    take(*answer);
  } else if (now >= next_) {
    std::vector<std::string> words = squeue_arguments(job_);
    words.insert(words.begin(), squeue_.string());
    question_.emplace(words, output_);
  }
}

void JobWatch::take(const Answer& answer) {
  // A job that ended some minutes ago is forgotten.
  const bool forgotten = answer.text.find("Invalid job id") != std::string::npos;
  trouble_ = answer.code != 0 && !forgotten ? answer.line() : "";
  if (!trouble_.empty()) return;
  ArrayState now = forgotten ? ArrayState{} : array_state(answer.text);
  has_answered_ = true;
  answers_without_active_ = now.active() == 0 ? answers_without_active_ + 1 : 0;
  state_.reason = now.reason;
  // How a task ended stays known after Slurm has forgotten it.
  for (auto& [index, name] : state_.tasks) {
    if (!now.tasks.contains(index)) name = "ended";
  }
  for (auto& [index, name] : now.tasks) state_.tasks[index] = std::move(name);
}

std::string JobWatch::text() const {
  if (!trouble_.empty()) return fmt::format("Slurm job {}: {}", job_, trouble_);
  if (!has_answered_) return fmt::format("Slurm job {}", job_);
  const int running = state_.running();
  const int waiting = state_.active() - running;
  std::string text = fmt::format("Slurm job {}: {} running", job_, running);
  if (waiting > 0) text += fmt::format(", {} waiting", waiting);
  if (waiting > 0 && !state_.reason.empty()) text += " (" + state_.reason + ")";
  return text;
}

}  // namespace coop::sweep
