#include "sweep/node/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <iostream>
#include <string>

namespace coop::sweep {
namespace {

constexpr std::chrono::seconds kPause{1};

std::string shown_time(double seconds) {
  const auto whole = static_cast<long>(seconds);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

}  // namespace

bool Progress::is_due() const {
  return Wall::now() - last_ >= kPause;
}

void Progress::show(std::size_t done, const std::string& engine) {
  const std::string status = done < total_ ? engine : "";
  const bool is_terminal = ::isatty(STDOUT_FILENO) == 1;
  last_ = Wall::now();
  if (!is_terminal && done == shown_ && status == shown_status_) return;
  shown_ = done;
  shown_status_ = status;
  const double spent = std::chrono::duration<double>(last_ - begun_).count();
  std::string line = fmt::format("{} of {} runs, {}", done, total_, shown_time(spent));
  if (done > before_ && done < total_) {
    const double left =
        spent * static_cast<double>(total_ - done) / static_cast<double>(done - before_);
    line += ", " + shown_time(left) + " to go";
  }
  if (!status.empty()) line += "; " + status;
  if (is_terminal) {
    std::cout << "\r\033[K" << line << (done == total_ ? "\n" : "") << std::flush;
  } else {
    std::cout << line << std::endl;
  }
}

}  // namespace coop::sweep
