#include "sweep/node/claim.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

namespace coop::sweep {
namespace {

constexpr int kLastDomain = 232;

/// Bound to a name of the abstract name space: as wide as the network that DDS sees, free of
/// permissions and leftovers. Nothing where the name is taken.
std::optional<Claim> claim_name(const std::string& name) {
  const int file = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (file < 0) throw std::system_error(errno, std::generic_category(), "socket");
  Claim claim(file);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  name.copy(address.sun_path + 1, sizeof address.sun_path - 1);
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  if (::bind(file, reinterpret_cast<const sockaddr*>(&address), size) == 0) return claim;
  if (errno != EADDRINUSE) throw std::system_error(errno, std::generic_category(), name);
  return std::nullopt;
}

/// What the kernel lists of this machine's sockets, where launchers show too.
std::string socket_list() {
  const std::ifstream file("/proc/net/unix");
  std::ostringstream text;
  text << file.rdbuf();
  return std::move(text).str();
}

}  // namespace

Claim::~Claim() {
  if (file_ >= 0) ::close(file_);
}

Claim::Claim(Claim&& other) noexcept : file_(std::exchange(other.file_, -1)) {}

Claim& Claim::operator=(Claim&& other) noexcept {
  std::swap(file_, other.file_);
  return *this;
}

DomainClaim claim_domain(int first) {
  const std::string sockets = socket_list();
  for (int domain = first; domain <= kLastDomain; ++domain) {
    if (sockets.find(fmt::format("@coop/launcher/{}/", domain)) != std::string::npos) continue;
    auto claim = claim_name(fmt::format("coop/sweep/{}", domain));
    if (claim) return {domain, std::move(*claim)};
  }
  throw std::runtime_error(fmt::format("no DDS domain from {} on is free", first));
}

std::optional<Claim> claim_folder(const std::filesystem::path& folder) {
  const std::filesystem::path lock = folder / "lock";
  const int file = ::open(lock.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (file < 0) throw std::system_error(errno, std::generic_category(), lock.string());
  Claim claim(file);
  if (::flock(file, LOCK_EX | LOCK_NB) == 0) return claim;
  if (errno != EWOULDBLOCK) throw std::system_error(errno, std::generic_category(), lock.string());
  return std::nullopt;
}

}  // namespace coop::sweep
