#include "system/hosts/host_network.hpp"

#include <fcntl.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>

namespace coop::test {
namespace {

const std::string kIp = "/usr/sbin/ip";
const std::string kIptables = "/usr/sbin/iptables";
/// The interface of the switch that leads to a host is called veth<number>.
const std::string kPort = "veth";

bool succeeds(const std::vector<std::string>& command, const std::filesystem::path& folder) {
  Program program(command.front(), {command.begin() + 1, command.end()}, folder / "ip.out");
  const auto status = program.wait();
  return status && status->clean();
}

}  // namespace

std::string HostNetwork::obstacle() {
  if (geteuid() != 0) return "network namespaces need root";
  for (const std::string& tool : {kIp, kIptables}) {
    if (access(tool.c_str(), X_OK) != 0) return "no " + tool;
  }
  const TemporaryFolder folder;
  const std::string name = "cp" + std::to_string(getpid()) + "try";
  if (!succeeds({kIp, "netns", "add", name}, folder.path())) return "no network namespaces here";
  const bool has_bridge = succeeds(
      {kIp, "netns", "exec", name, kIp, "link", "add", "br0", "type", "bridge"}, folder.path());
  const bool has_filter =
      succeeds({kIp, "netns", "exec", name, kIptables, "-A", "INPUT", "-m", "statistic", "--mode",
                "random", "--probability", "0.5", "-j", "DROP"},
               folder.path());
  succeeds({kIp, "netns", "del", name}, folder.path());
  if (!has_bridge) return "no network bridges here";
  return has_filter ? "" : "no packet filter here";
}

HostNetwork::HostNetwork(const std::vector<std::string>& hosts)
    : hosts_(hosts), prefix_("cp" + std::to_string(getpid())) {
  const std::string bridge = prefix_ + "switch";
  ip({"netns", "add", bridge});
  ip({"-n", bridge, "link", "add", "br0", "type", "bridge"});
  ip({"-n", bridge, "link", "set", "br0", "up"});
  for (std::size_t i = 0; i < hosts_.size(); ++i) {
    const std::string here = space(hosts_[i]);
    const std::string port = kPort + std::to_string(i);
    ip({"netns", "add", here});
    ip({"-n", bridge, "link", "add", port, "type", "veth", "peer", "name", "eth0", "netns", here});
    ip({"-n", bridge, "link", "set", port, "master", "br0", "up"});
    ip({"-n", here, "addr", "add", address(hosts_[i]) + "/24", "dev", "eth0"});
    ip({"-n", here, "link", "set", "eth0", "up"});
    ip({"-n", here, "link", "set", "lo", "up"});
    ip({"-n", here, "route", "add", "default", "dev", "eth0"});
  }
}

HostNetwork::~HostNetwork() {
  for (const std::string& host : hosts_) {
    succeeds({kIp, "netns", "del", space(host)}, folder_.path());
  }
  succeeds({kIp, "netns", "del", prefix_ + "switch"}, folder_.path());
}

std::string HostNetwork::space(const std::string& host) const {
  return prefix_ + host;
}

std::string HostNetwork::address(const std::string& host) const {
  const auto found = std::ranges::find(hosts_, host);
  if (found == hosts_.end()) throw std::invalid_argument("no host " + host);
  return "10.77.0." + std::to_string(found - hosts_.begin() + 1);
}

void HostNetwork::ip(const std::vector<std::string>& arguments) const {
  std::vector<std::string> command = arguments;
  command.insert(command.begin(), kIp);
  if (succeeds(command, folder_.path())) return;
  std::string text;
  for (const std::string& word : command) text += word + " ";
  throw std::runtime_error(text + "failed");
}

void HostNetwork::on_all(const std::vector<std::string>& command) const {
  for (const std::string& host : hosts_) {
    std::vector<std::string> arguments{"netns", "exec", space(host)};
    arguments.insert(arguments.end(), command.begin(), command.end());
    ip(arguments);
  }
}

void HostNetwork::cut(const std::string& host) {
  const auto number = std::ranges::find(hosts_, host) - hosts_.begin();
  ip({"-n", prefix_ + "switch", "link", "set", kPort + std::to_string(number), "down"});
}

void HostNetwork::join(const std::string& host) {
  const auto number = std::ranges::find(hosts_, host) - hosts_.begin();
  ip({"-n", prefix_ + "switch", "link", "set", kPort + std::to_string(number), "up"});
}

void HostNetwork::block_multicast() {
  on_all({kIptables, "-A", "OUTPUT", "-d", "224.0.0.0/4", "-j", "DROP"});
  on_all({kIptables, "-A", "INPUT", "-d", "224.0.0.0/4", "-j", "DROP"});
}

void HostNetwork::lose(double share) {
  on_all({kIptables, "-A", "INPUT", "-i", "eth0", "-m", "statistic", "--mode", "random",
          "--probability", std::to_string(share), "-j", "DROP"});
}

void HostNetwork::lose_nothing() {
  on_all({kIptables, "-F"});
}

std::unique_ptr<Program> HostNetwork::run(const std::string& host,
                                          const std::vector<std::string>& command,
                                          const std::filesystem::path& folder,
                                          const std::string& output) const {
  // Each of these becomes the next, so that the process is the program's own in the end.
  std::vector<std::string> arguments{"netns",
                                     "exec",
                                     space(host),
                                     "env",
                                     "-C",
                                     folder.string(),
                                     "COOP_RUNTIME_DIR=" + (folder / host).string()};
  arguments.insert(arguments.end(), command.begin(), command.end());
  return std::make_unique<Program>(kIp, arguments, folder / output);
}

OnHost::OnHost(const std::string& space)
    : home_(open("/proc/thread-self/ns/net", O_RDONLY | O_CLOEXEC)) {
  const launcher::FileDescriptor there(open(("/run/netns/" + space).c_str(), O_RDONLY | O_CLOEXEC));
  if (setns(there.get(), CLONE_NEWNET) != 0) throw std::runtime_error("cannot go to " + space);
}

OnHost::~OnHost() {
  setns(home_.get(), CLONE_NEWNET);
}

}  // namespace coop::test
