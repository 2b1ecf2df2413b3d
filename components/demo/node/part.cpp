#include "demo/node/part.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <iostream>

#include "core/child_process.hpp"
#include "runtime/dds_transport.hpp"
#include "runtime/stop_signal.hpp"

namespace coop::demo {
namespace {

using Wall = std::chrono::steady_clock;
constexpr auto kRound = std::chrono::milliseconds(50);
constexpr int kStopped = 130;
constexpr auto kRefresh = std::chrono::milliseconds(500);

/// The line of progress.
class ProgressLine {
 public:
  explicit ProgressLine(std::string title) : title_(std::move(title)) {}
  ~ProgressLine() {
    if (is_terminal_ && !last_.empty()) std::cout << '\n' << std::flush;
  }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(const std::string& text) {
    const auto now = Wall::now();
    const double elapsed = std::chrono::duration<double>(now - begin_).count();
    if (is_terminal_) {
      if (now - shown_ < kRefresh) return;
      shown_ = now;
      std::cout << fmt::format("\r\033[K{:>10} {:5.0f} s  {}", title_, elapsed, text.substr(0, 100))
                << std::flush;
    } else if (text != last_) {
      std::cout << fmt::format("{:>10} {:5.0f} s  {}", title_, elapsed, text) << std::endl;
    }
    last_ = text;
  }

 private:
  std::string title_;
  bool is_terminal_ = ::isatty(STDOUT_FILENO) == 1;
  Wall::time_point begin_ = Wall::now();
  Wall::time_point shown_{};
  std::string last_;
};

std::vector<std::string> launcher_command(const Part& part) {
  std::vector<std::string> command{
      (part.programs / "launcher").string(), "up", part.launch_file, "--until", "mission-done",
      "--timeout", fmt::format("{:.0f}", part.timeout), "--run-dir", part.folder.string(),
      "--domain", std::to_string(part.domain), "--seed", std::to_string(part.seed),
      // All of it, not the last minutes only.
      "--set", "record.last=0"};
  for (const std::string& setting : part.settings) {
    command.emplace_back("--set");
    command.push_back(setting);
  }
  return command;
}

}  // namespace

PartResult run_part(const Part& part) {
  std::filesystem::create_directories(part.folder);
  PartResult result;
  result.output = part.folder / "launcher.log";

  runtime::DdsTransport transport({.domain = part.domain,
                                   .participant_name = "demo",
                                   .partition = {},
                                   .settings = runtime::read_dds_settings({})});
  const runtime::SystemClock clock;
  runtime::Executor executor(clock);
  const runtime::StopSignal stop(executor);
  runtime::Options options;
  options.name = "demo";
  runtime::Node node(options, transport, clock, executor);
  Observer observer(node, part.watch);

  ChildProcess launcher(launcher_command(part), result.output);
  ProgressLine line(part.title);
  while (!launcher.poll()) {
    executor.wait_and_run(kRound);
    transport.mend();
    line.show(observer.progress());
    if (runtime::StopSignal::requested() && !result.stopped) {
      result.stopped = true;
      launcher.ask_to_stop();
    }
  }
  executor.run_once();
  result.exit_code = launcher.wait();
  result.record = observer.record();
  return result;
}

int complain(const Part& part, const PartResult& result) {
  if (result.stopped) {
    std::cout << part.title << ": stopped\n";
    return kStopped;
  }
  if (result.exit_code == 0) return 0;
  std::cerr << fmt::format("demo: {} did not end (launcher's exit code {}); see {}\n", part.title,
                           result.exit_code, result.output.string());
  return 2;
}

}  // namespace coop::demo
