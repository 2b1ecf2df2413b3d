#include "system/network/open_sockets.hpp"

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

namespace coop::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kListening = "0A";       // of TCP, in /proc/net/tcp
constexpr unsigned long kAccepting = 0x10000;  // flag of Unix sockets that listen

std::set<std::string> inodes_of(const fs::path& process) {
  std::set<std::string> inodes;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(process / "fd", error)) {
    const std::string target = fs::read_symlink(entry.path(), error).string();
    if (target.starts_with("socket:[")) inodes.insert(target.substr(8, target.size() - 9));
  }
  return inodes;
}

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

/// Columns: number, local address, remote address, state, ... inode at place 9.
void add_internet(const fs::path& process, const std::string& kind,
                  const std::set<std::string>& inodes, std::vector<OpenSocket>& out) {
  std::ifstream table(process / "net" / kind);
  std::string line;
  std::getline(table, line);
  while (std::getline(table, line)) {
    const auto words = words_of(line);
    if (words.size() < 10 || !inodes.contains(words[9])) continue;
    if (kind.starts_with("tcp") && words[3] != kListening) continue;
    const auto port = std::stoul(words[1].substr(words[1].rfind(':') + 1), nullptr, 16);
    if (port != 0) out.push_back({kind, "", static_cast<std::uint16_t>(port)});
  }
}

/// Columns: address, references, protocol, flags, type, state, inode, path.
void add_unix(const fs::path& process, const std::set<std::string>& inodes,
              std::vector<OpenSocket>& out) {
  std::ifstream table(process / "net" / "unix");
  std::string line;
  std::getline(table, line);
  while (std::getline(table, line)) {
    const auto words = words_of(line);
    if (words.size() < 7 || !inodes.contains(words[6])) continue;
    if ((std::stoul(words[3], nullptr, 16) & kAccepting) == 0) continue;
    out.push_back({"unix", words.size() > 7 ? words[7] : "", 0});
  }
}

}  // namespace

std::vector<OpenSocket> open_sockets(pid_t pid) {
  const fs::path process = "/proc/" + std::to_string(pid);
  const auto inodes = inodes_of(process);
  std::vector<OpenSocket> out;
  for (const char* kind : {"udp", "udp6", "tcp", "tcp6", "raw", "raw6"}) {
    add_internet(process, kind, inodes, out);
  }
  add_unix(process, inodes, out);
  return out;
}

}  // namespace coop::test
