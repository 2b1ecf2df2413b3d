#include "launcher/commands.hpp"

#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <iostream>

#include "launcher/control_client.hpp"
#include "launcher/log_tail.hpp"

namespace coop::launcher {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kPollPeriod{50};
/// A component has its own limits for starting and stopping (15 s, 3 s); the launcher enforces
/// them.
constexpr std::chrono::seconds kActionTimeout{60};

int complain(const std::string& text) {
  std::cerr << "launcher: " << text << '\n';
  return 1;
}

std::size_t terminal_width() {
  winsize size{};
  return ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 20 ? size.ws_col : 500U;
}

Result<Row> row_of(ControlClient& client, const std::string& name) {
  auto reply = client.ask({.verb = "ps", .name = {}});
  if (!reply) return fail(reply.error());
  for (Row& row : reply->system.rows) {
    if (row.name == name) return std::move(row);
  }
  return fail("no component '" + name + "'");
}

/// Asks until `is_reached`, with a pause between two questions.
Result<Row> wait_for(ControlClient& client, const std::string& name,
                     const std::function<bool(const Row&)>& is_reached) {
  const auto limit = std::chrono::steady_clock::now() + kActionTimeout;
  for (;;) {
    auto row = row_of(client, name);
    if (!row || is_reached(*row)) return row;
    if (std::chrono::steady_clock::now() > limit) return fail(name + " is still " + row->state);
    poll(nullptr, 0, static_cast<int>(kPollPeriod.count()));
  }
}

}  // namespace

int show_processes(const SystemChoice& choice, bool as_json) {
  auto client = ControlClient::connect(choice.domain, choice.robot);
  if (!client) return complain(client.error());
  const auto reply = client->ask({.verb = "ps", .name = {}});
  if (!reply) return complain(reply.error());
  if (as_json) {
    std::cout << encode(*reply) << '\n';
    return 0;
  }
  for (const std::string& line : format_table(reply->system, terminal_width())) {
    std::cout << line << '\n';
  }
  return 0;
}

int control_component(const SystemChoice& choice, const std::string& verb,
                      const std::string& name) {
  auto client = ControlClient::connect(choice.domain, choice.robot);
  if (!client) return complain(client.error());
  const auto begin = std::chrono::steady_clock::now();
  const pid_t old_pid = row_of(*client, name).value_or(Row{}).pid;
  if (const auto reply = client->ask({.verb = verb, .name = name}); !reply) {
    return complain(reply.error());
  }
  const auto row = wait_for(*client, name, [&](const Row& now) {
    if (now.state == "failed") return true;
    if (verb == "stop") return now.pid == 0;
    return now.pid != old_pid &&
           (now.state == "ready" || now.state == "degraded" || now.state == "finished");
  });
  if (!row) return complain(row.error());
  if (row->state == "failed") return complain(name + " failed: " + row->detail);
  const double took =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  std::printf("%s: %s after %.2f s%s%s\n", name.c_str(), row->state.c_str(), took,
              row->detail.empty() ? "" : ": ", row->detail.c_str());
  return 0;
}

int take_down(const SystemChoice& choice) {
  auto client = ControlClient::connect(choice.domain, choice.robot);
  if (!client) return complain(client.error());
  const auto begin = std::chrono::steady_clock::now();
  if (const auto reply = client->ask({.verb = "down", .name = {}}); !reply) {
    return complain(reply.error());
  }
  if (!client->wait_for_end(kActionTimeout)) return complain("the system is still stopping");
  const double took =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  std::printf("stopped after %.2f s\n", took);
  return 0;
}

int show_log(const SystemChoice& choice, const std::string& name, const std::string& run_dir,
             std::size_t lines, bool follow) {
  std::filesystem::path run = std::filesystem::path(run_dir) / "latest";
  if (auto client = ControlClient::connect(choice.domain, choice.robot)) {
    const auto reply = client->ask({.verb = "ps", .name = {}});
    if (!reply) return complain(reply.error());
    run = reply->system.run_folder;
  }
  const auto file = name == "launcher" ? run / "launcher.log" : run / "logs" / (name + ".log");
  std::error_code error;
  if (name.find('/') != std::string::npos || !std::filesystem::is_regular_file(file, error)) {
    std::string known = "launcher";
    for (const auto& entry : std::filesystem::directory_iterator(run / "logs", error)) {
      if (entry.path().extension() == ".log") known += ", " + entry.path().stem().string();
    }
    return complain("no log of '" + name + "' in " + run.string() + "; there are: " + known);
  }
  LogTail tail(file);
  std::cout << tail.last_lines(lines) << std::flush;
  while (follow && std::cout.good()) {
    std::cout << tail.wait_for_more() << std::flush;
  }
  return 0;
}

}  // namespace coop::launcher
