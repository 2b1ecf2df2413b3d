#include "sweep/slurm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <sstream>

#include "core/hash.hpp"

namespace coop::sweep {
namespace {

/// States of tasks that have ended (squeue's manual, JOB STATE CODES).
constexpr std::array<std::string_view, 10> kEnded{
    "BOOT_FAIL", "CANCELLED",     "COMPLETED", "DEADLINE", "FAILED",
    "NODE_FAIL", "OUT_OF_MEMORY", "PREEMPTED", "REVOKED",  "TIMEOUT"};

/// s from the end of a run's own time limit to Slurm's, so that the run ends in order.
constexpr double kMargin = 120.0;

bool is_active(std::string_view state) {
  return std::ranges::find(kEnded, state) == kEnded.end();
}

std::optional<int> whole_number(std::string_view text) {
  int value = 0;
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stopped != end) return std::nullopt;
  return value;
}

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  std::istringstream in{std::string(text)};
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// In a file name pattern of sbatch, '%' begins a replacement.
std::string without_patterns(const std::string& path) {
  std::string text;
  for (const char c : path) {
    text += c;
    if (c == '%') text += c;
  }
  return text;
}

}  // namespace

int ArrayState::active() const {
  return static_cast<int>(
      std::ranges::count_if(tasks, [](const auto& task) { return is_active(task.second); }));
}

int ArrayState::running() const {
  return static_cast<int>(
      std::ranges::count_if(tasks, [](const auto& task) { return task.second == "RUNNING"; }));
}

std::string job_name(const std::filesystem::path& folder) {
  return fmt::format("coop-sweep-{:016x}", fnv1a(folder.lexically_normal().string()));
}

std::string shell_word(std::string_view text) {
  std::string word = "'";
  for (const char c : text) {
    if (c == '\'') {
      word += "'\\''";
    } else {
      word += c;
    }
  }
  return word + "'";
}

std::string batch_script(const ArrayJob& job) {
  std::string script =
      "#!/bin/bash\n"
      "# Task I of the array makes run ${runs[I]} of a sweep.\n"
      "runs=(";
  for (std::size_t i = 0; i < job.runs.size(); ++i) {
    script += (i == 0 ? "" : " ") + std::to_string(job.runs[i]);
  }
  script += ")\nexec";
  for (const std::string& word : job.command) script += " \\\n  " + shell_word(word);
  return script + " \\\n  \"${runs[$SLURM_ARRAY_TASK_ID]}\"\n";
}

std::vector<std::string> sbatch_arguments(const ArrayJob& job, const SweepConfig& config,
                                          const std::filesystem::path& script) {
  const double minutes = std::ceil((config.timeout + kMargin) / 60.0);
  const std::string time_limit =
      config.slurm.time_limit.empty() ? fmt::format("{:.0f}", minutes) : config.slurm.time_limit;
  std::vector<std::string> arguments = config.slurm.options;
  arguments.push_back("--time=" + time_limit);
  if (!config.slurm.partition.empty()) arguments.push_back("--partition=" + config.slurm.partition);
  std::string array = fmt::format("--array=0-{}", job.runs.size() - 1);
  if (job.side_by_side) array += fmt::format("%{}", *job.side_by_side);
  arguments.push_back(array);
  arguments.push_back("--parsable");
  arguments.push_back("--job-name=" + job.name);
  arguments.push_back("--chdir=" + job.working_folder.string());
  arguments.push_back("--output=" + without_patterns(job.folder.string()) + "/task-%A_%a.log");
  arguments.push_back(script.string());
  return arguments;
}

std::optional<std::string> job_number(std::string_view printed) {
  for (const std::string& line : lines_of(printed)) {
    const std::string first = line.substr(0, line.find(';'));  // then the cluster's name
    if (whole_number(first)) return first;
  }
  return std::nullopt;
}

std::vector<std::string> squeue_arguments(const std::string& job) {
  return {"--noheader", "--array", "--states=all", "--jobs=" + job, "--format=%K %T %r"};
}

ArrayState array_state(std::string_view printed) {
  ArrayState state;
  for (const std::string& line : lines_of(printed)) {
    std::istringstream words(line);
    std::string index;
    std::string name;
    std::string reason;
    words >> index >> name >> std::ws;
    std::getline(words, reason);
    const auto place = whole_number(index);
    if (!place || name.empty()) continue;
    state.tasks[*place] = name;
    if (name == "PENDING" && state.reason.empty() && reason != "None") state.reason = reason;
  }
  return state;
}

}  // namespace coop::sweep
