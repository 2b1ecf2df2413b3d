#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "system/support/running_system.hpp"

namespace coop::test {

/// Hosts on one switch, stood for by network namespaces of this machine: a namespace each with an
/// interface eth0, and one more that holds the switch, so that the machine's own network is not
/// touched. Needs root.
class HostNetwork {
 public:
  /// Why none can be made here; empty: it can.
  [[nodiscard]] static std::string obstacle();

  explicit HostNetwork(const std::vector<std::string>& hosts);
  ~HostNetwork();
  HostNetwork(const HostNetwork&) = delete;
  HostNetwork& operator=(const HostNetwork&) = delete;

  [[nodiscard]] std::string address(const std::string& host) const;
  /// Plug pulled, and put in again.
  void cut(const std::string& host);
  void join(const std::string& host);
  /// On every host: nothing goes to many, as on many a wireless network.
  void block_multicast();
  /// On every host: this share of what comes in is lost.
  void lose(double share);
  /// Neither is so any more.
  void lose_nothing();

  /// Runs a program on the host; `folder`: its working folder and the place of its output.
  [[nodiscard]] std::unique_ptr<Program> run(const std::string& host,
                                             const std::vector<std::string>& command,
                                             const std::filesystem::path& folder,
                                             const std::string& output) const;
  [[nodiscard]] std::string space(const std::string& host) const;

 private:
  void ip(const std::vector<std::string>& arguments) const;
  void on_all(const std::vector<std::string>& command) const;

  std::vector<std::string> hosts_;
  std::string prefix_;
  TemporaryFolder folder_;
};

/// What this thread opens while it lives, it opens on that host; so do threads it starts.
class OnHost {
 public:
  explicit OnHost(const std::string& space);
  ~OnHost();
  OnHost(const OnHost&) = delete;
  OnHost& operator=(const OnHost&) = delete;

 private:
  launcher::FileDescriptor home_;
};

}  // namespace coop::test
