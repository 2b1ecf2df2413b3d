#pragma once
#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "runtime/dds_settings.hpp"

namespace coop::runtime {

/// The files of one participant within the folder that `coop keys` made. What lies in `public/` is
/// the same for all; what lies in NAME/ only NAME may read.
struct KeyFiles {
  KeyFiles(const std::filesystem::path& folder, const std::string& name);
  std::filesystem::path identity_ca;     ///< public/identity_ca.pem
  std::filesystem::path permissions_ca;  ///< public/permissions_ca.pem
  std::filesystem::path governance;      ///< public/governance.p7s: what is protected, and how
  std::filesystem::path revoked;         ///< public/revoked.pem; need not be there
  std::filesystem::path certificate;     ///< NAME/certificate.pem
  std::filesystem::path key;             ///< NAME/key.pem
  std::filesystem::path permissions;     ///< NAME/permissions.p7s: its topics
};

/// Throws config::Error, one line, where a file is missing or unreadable, the certificate is not
/// valid at `now`, of another authority or revoked, or the key is not its own: the middleware would
/// only say that no participant could be made.
void check_keys(const std::filesystem::path& folder, const std::string& name,
                std::chrono::system_clock::time_point now);

/// As read_dds_settings(), the keys of `name`, where there must be some, found good.
[[nodiscard]] DdsSettings read_dds_settings_of(const std::string& name,
                                               const std::vector<std::string>& assignments);

}  // namespace coop::runtime
