#pragma once
#include <filesystem>
#include <optional>

namespace coop::sweep {

/// Something that one process at a time may have; given back with the object, or when the process
/// ends, however it ends.
class Claim {
 public:
  /// Takes over an open file that stands for it.
  explicit Claim(int file) : file_(file) {}
  ~Claim();
  Claim(Claim&& other) noexcept;
  Claim& operator=(Claim&& other) noexcept;
  Claim(const Claim&) = delete;
  Claim& operator=(const Claim&) = delete;

 private:
  int file_ = -1;
};

struct DomainClaim {
  int domain = 0;
  Claim claim;
};

/// The first DDS domain from `first` on in which no other sweep of this machine makes runs, of any
/// user, and no launcher has a system. Throws std::runtime_error where all are taken.
[[nodiscard]] DomainClaim claim_domain(int first);

/// Nothing where another process has it. The folder must exist.
[[nodiscard]] std::optional<Claim> claim_folder(const std::filesystem::path& folder);

}  // namespace coop::sweep
