#include "runtime/dds_settings.hpp"

#include <array>
#include <cstdlib>
#include <sstream>

#include "core/config/config.hpp"

namespace coop::runtime {
namespace {

constexpr const char* kVariable = "COOP_DDS";

/// A text in YAML, whatever is in it.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

std::string in_yaml(const std::vector<std::string>& texts) {
  std::string out = "[";
  for (const std::string& text : texts) out += (out.size() > 1 ? "," : "") + quoted(text);
  return out + "]";
}

/// The document's messages speak of `--set`; ours came another way.
std::string with_origin(std::string message, const std::string& origin) {
  constexpr std::string_view kSet = "--set";
  if (message.starts_with(kSet)) message.replace(0, kSet.size(), origin);
  return message;
}

bool is_endpoint(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || colon == 0) return false;
  const std::string port = text.substr(colon + 1);
  if (port.empty() || port.size() > 5 ||
      port.find_first_not_of("0123456789") != std::string::npos) {
    return false;
  }
  const int number = std::stoi(port);
  return number > 0 && number <= 65535;
}

}  // namespace

void DdsSettings::describe(config::Fields& fields) {
  static constexpr std::array<std::string_view, 3> kDiscovery{"simple", "peers", "server"};
  static constexpr std::array<std::string_view, 2> kTransport{"udp", "shm"};
  fields.choice("discovery", discovery, kDiscovery,
                {.help = "simple: multicast; peers: the hosts named; server: a discovery server"});
  fields.texts("peers", peers, {.help = "other hosts, addresses or names (discovery: peers)"});
  fields.integer("peer_participants", peer_participants,
                 {.help = "programs a host that peers are looked for", .min = 1, .max = 119});
  fields.text("server", server, {.help = "ADDRESS:PORT of it (discovery: server)"});
  fields.integer("lease", lease,
                 {.unit = "s",
                  .help = "until one who is not heard is given up; 0: 5, with a server 18",
                  .min = 0,
                  .max = 3600});
  fields.choice("transport", transport, kTransport,
                {.help = "shm: shared memory as well, within one host, one user"});
  fields.texts("interfaces", interfaces,
               {.help = "names or addresses of the network interfaces to keep to; none: all"});
  fields.flag("security", security, {.help = "on: only programs with keys take part"});
  std::string folder = keys.string();
  fields.text("keys", folder, {.help = "folder that `coop keys` made (security: on)"});
  keys = folder;
}

void DdsSettings::validate() const {
  const auto refuse = [](const std::string& what) { throw config::Error("dds." + what); };
  if (discovery == "peers" && peers.empty())
    refuse("peers: expected the addresses of the other hosts with discovery: peers");
  if (discovery != "peers" && !peers.empty())
    refuse("peers: they are heeded with discovery: peers only, not with " + discovery);
  if (discovery == "server" && !is_endpoint(server))
    refuse("server: expected ADDRESS:PORT with discovery: server, got '" + server + "'");
  if (discovery != "server" && !server.empty())
    refuse("server: it is heeded with discovery: server only, not with " + discovery);
  if (security && keys.empty()) refuse("keys: expected a folder with security: on");
}

std::vector<std::string> DdsSettings::assignments() const {
  const DdsSettings usual;
  std::vector<std::string> out;
  const auto add = [&out](bool deviates, const std::string& key, const std::string& value) {
    if (deviates) out.push_back(key + "=" + value);
  };
  add(discovery != usual.discovery, "discovery", discovery);
  add(peers != usual.peers, "peers", in_yaml(peers));
  add(peer_participants != usual.peer_participants, "peer_participants",
      std::to_string(peer_participants));
  add(server != usual.server, "server", quoted(server));
  add(lease != usual.lease, "lease", std::to_string(lease));
  add(transport != usual.transport, "transport", transport);
  add(interfaces != usual.interfaces, "interfaces", in_yaml(interfaces));
  add(security != usual.security, "security", security ? "on" : "off");
  add(keys != usual.keys, "keys", quoted(keys.string()));
  return out;
}

void apply_dds_settings(DdsSettings& settings, const std::vector<std::string>& assignments,
                        const std::string& origin) {
  config::Document document;
  try {
    for (const std::string& assignment : assignments) document.set(assignment);
    document.read(settings);
  } catch (const config::Error& problem) {
    throw config::Error(with_origin(problem.what(), origin));
  }
}

DdsSettings read_dds_settings(const std::vector<std::string>& assignments) {
  DdsSettings settings;
  std::vector<std::string> all;
  if (const char* environment = std::getenv(kVariable)) {
    std::istringstream words(environment);
    for (std::string word; words >> word;) all.push_back(word);
  }
  // Read together, so that a half of one place and a half of the other make a whole.
  const bool from_both = !all.empty() && !assignments.empty();
  const std::string origin =
      from_both ? std::string("--dds and ") + kVariable : (all.empty() ? "--dds" : kVariable);
  all.insert(all.end(), assignments.begin(), assignments.end());
  apply_dds_settings(settings, all, origin);
  return settings;
}

}  // namespace coop::runtime
