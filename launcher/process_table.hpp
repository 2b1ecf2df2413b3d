#pragma once
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "launcher/event_loop.hpp"
#include "launcher/log_file.hpp"
#include "launcher/process_usage.hpp"
#include "launcher/supervisor.hpp"

namespace coop::launcher {

/// The processes of the system: starts them, writes down what they print, and reaps them.
class ProcessTable : public ProcessHost {
 public:
  /// For a line a component with `log.console` has printed.
  using Echo = std::function<void(const std::string& component, std::string_view output)>;

  /// `log_folder` must be there.
  ProcessTable(EventLoop& loop, std::filesystem::path log_folder, Echo echo);
  ~ProcessTable() override;

  Result<pid_t> start(const PlannedComponent& component) override;
  void signal(pid_t pid, int number) override;
  [[nodiscard]] std::string last_words(const std::string& component) const override;
  [[nodiscard]] std::optional<double> starved(pid_t pid) const override {
    return starved_seconds(pid);
  }

  /// All that have ended since the last call; their output has been written down.
  struct Exit {
    pid_t pid;
    ExitStatus status;
  };
  [[nodiscard]] std::vector<Exit> reap();

 private:
  struct Entry {
    pid_t pid = 0;
    bool echo = false;
    FileDescriptor output;
    std::unique_ptr<LogFile> log;
  };

  /// One gulp of the output; answers whether there may be more.
  bool read_output(const std::string& name, Entry& entry);
  void close_output(Entry& entry);

  EventLoop& loop_;
  std::filesystem::path log_folder_;
  Echo echo_;
  std::map<std::string, Entry> entries_;
};

}  // namespace coop::launcher
