#include "experiments/chaos/ground.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sched.h>
#include <sys/mount.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

#include "core/child_process.hpp"

namespace coop::chaos {
namespace {

namespace fs = std::filesystem;

/// Domains up to 101 have their multicast ports at 7400 + 250 d, and 7401 + 250 d.
bool is_shared(int port) {
  return port >= 7400 && (port - 7400) % 250 < 2;
}

bool run(const std::vector<std::string>& command) {
  try {
    return ChildProcess(command, "/dev/null").wait() == 0;
  } catch (const std::exception&) {
    return false;
  }
}

bool make_network() {
  if (unshare(CLONE_NEWNET) != 0) return false;
  return run({"/usr/sbin/ip", "link", "set", "lo", "up", "multicast", "on"}) &&
         run({"/usr/sbin/ip", "route", "add", "224.0.0.0/4", "dev", "lo"}) &&
         run({"/usr/sbin/iptables", "-S"});
}

bool make_disk(const fs::path& folder, int size) {
  if (unshare(CLONE_NEWNS) != 0) return false;
  if (mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0) return false;
  const std::string options = "mode=0700,size=" + std::to_string(size) + "m";
  return mount("tmpfs", folder.c_str(), "tmpfs", 0, options.c_str()) == 0;
}

}  // namespace

std::vector<int> udp_ports(pid_t pid) {
  std::set<std::string> sockets;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(fmt::format("/proc/{}/fd", pid), ignored)) {
    const std::string target = fs::read_symlink(entry.path(), ignored).string();
    if (target.starts_with("socket:[")) sockets.insert(target.substr(8, target.size() - 9));
  }
  std::vector<int> ports;
  std::ifstream table("/proc/self/net/udp");
  std::string line;
  std::getline(table, line);  // the heading
  while (std::getline(table, line)) {
    std::istringstream words(line);
    std::string slot, local, word, inode;
    words >> slot >> local;
    for (int i = 0; i < 7; ++i) words >> word;
    words >> inode;
    const std::size_t colon = local.find(':');
    if (colon == std::string::npos || !sockets.contains(inode)) continue;
    const int port = std::stoi(local.substr(colon + 1), nullptr, 16);
    if (!is_shared(port)) ports.push_back(port);
  }
  return ports;
}

Ground::Ground(const fs::path& folder, int disk_size) : folder_(folder) {
  abilities_.network = make_network();
  abilities_.disk = make_disk(folder, disk_size);
  setenv("TMPDIR", folder.c_str(), 1);
}

void Ground::lose_packets(pid_t pid, double share) const {
  std::string ports;
  for (const int port : udp_ports(pid)) ports += (ports.empty() ? "" : ",") + std::to_string(port);
  // One rule for all of them, so that they are lost at one moment.
  (void)run({"/usr/sbin/iptables", "-A", "INPUT", "-p", "udp", "-m", "multiport", "--ports", ports,
             "-m", "statistic", "--mode", "random", "--probability", fmt::format("{:.3f}", share),
             "-j", "DROP"});
}

void Ground::restore_network() const {
  (void)run({"/usr/sbin/iptables", "-F", "INPUT"});
}

void Ground::fill_disk() const {
  const int file = open((folder_ / "filler").c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  if (file < 0) return;
  const std::string block(1 << 16, 'x');
  for (std::size_t size = block.size(); size > 0;) {
    if (write(file, block.data(), size) != static_cast<ssize_t>(size)) size /= 2;
  }
  close(file);
}

void Ground::free_disk() const {
  std::error_code ignored;
  fs::remove(folder_ / "filler", ignored);
}

}  // namespace coop::chaos
